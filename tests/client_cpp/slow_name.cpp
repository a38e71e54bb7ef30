#include "client_cpp/slow_name.hpp"

#include <dlfcn.h>
#include <netdb.h>

#include <string_view>

namespace rois::test {

namespace {

std::shared_ptr<SlowName::State> latest;

}  // namespace

SlowName::SlowName() : state_{std::make_shared<State>()} { latest = state_; }

}  // namespace rois::test

// Replaces the function of the system.
extern "C" int getaddrinfo(char const* name, char const* service, addrinfo const* hints, addrinfo** found) {
    if (name != nullptr && std::string_view{name}.ends_with(".slow")) {
        auto const state = rois::test::latest;
        state->asked.count_down();
        state->answered.wait();
        return EAI_NONAME;
    }
    static auto* const real = reinterpret_cast<decltype(&getaddrinfo)>(dlsym(RTLD_NEXT, "getaddrinfo"));
    return real(name, service, hints, found);
}
