// rois-fuzz TARGET [OPTION of libFuzzer]... [FOLDER of inputs]: ./dev fuzz runs it.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string_view>

#include "fuzzing/targets.hpp"

namespace {

rois::fuzzing::Target const* chosen = nullptr;

}  // namespace

// With -fork, libFuzzer starts this program again, with the arguments that are left: the environment names the target.
extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
    constexpr auto variable = "ROIS_FUZZ_TARGET";
    auto const* const outer = std::getenv(variable);
    std::string_view const name = outer != nullptr ? outer : *count > 1 ? (*arguments)[1] : "";
    auto const all = rois::fuzzing::targets();
    auto const found = std::ranges::find(all, name, &rois::fuzzing::Target::name);
    if (found == all.end()) {
        std::fputs("usage: rois-fuzz TARGET [OPTION of libFuzzer]... [FOLDER]; the targets are:\n", stderr);
        for (auto const& each : all) std::fprintf(stderr, "  %.*s\n", static_cast<int>(each.name.size()), each.name.data());
        std::exit(2);
    }
    chosen = &*found;
    if (outer != nullptr) return 0;
    ::setenv(variable, (*arguments)[1], 1);
    std::copy(*arguments + 2, *arguments + *count, *arguments + 1);
    --*count;
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* data, std::size_t size) {
    try {
        chosen->run({reinterpret_cast<char const*>(data), size});
    } catch (std::exception const& broken) {
        std::fprintf(stderr, "%s\n", broken.what());
        std::abort();
    }
    return 0;
}
