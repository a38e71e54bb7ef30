#include <unistd.h>

#include <cstdio>
#include <limits>

#include "load/application.hpp"
#include "load/modes.hpp"
#include "load/readiness.hpp"

namespace rois::bench {

void hold(Options const& options) {
    auto applications = make_applications(options);
    Readiness readiness{options.spin};
    constexpr auto standard_input = std::numeric_limits<std::size_t>::max();
    readiness.watch(STDIN_FILENO, standard_input);
    for (std::size_t i = 0; i < applications.size(); ++i) {
        if (options.stream) applications[i].open_stream();
        readiness.watch(applications[i].socket().descriptor(), i);
    }
    std::printf("{\"held\":%zu}\n", applications.size());
    std::fflush(stdout);
    constexpr Nanoseconds for_ever = 3'600'000'000'000;
    while (true) {
        for (auto const& ready : readiness.wait(now() + for_ever)) {
            if (ready.data.u64 == standard_input) return;
            applications[ready.data.u64].socket().drain();
        }
    }
}

}  // namespace rois::bench
