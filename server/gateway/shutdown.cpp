#include "gateway/shutdown.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>
#include <thread>
#include <tuple>

namespace rois {

bool await_halts(Gateway const& gateway, Steady until, std::chrono::milliseconds between_looks) {
    while (!gateway.not_halted().empty() && std::chrono::steady_clock::now() < until) std::this_thread::sleep_for(between_looks);
    auto const not_halted = gateway.not_halted();
    for (auto const& ref : not_halted)
        spdlog::critical("{} did not confirm that it stands still: make sure that the robot does", ref);
    return not_halted.empty();
}

void halt_and_exit(Gateway& gateway, Telemetry const& telemetry, std::string_view why) {
    constexpr int internal_software_error = 70;  // EX_SOFTWARE
    gateway.halt_at_last();
    auto const dropped = telemetry.dropped_log_lines();
    constexpr std::string_view what = ": all components were halted, and the gateway ends";
    spdlog::critical("{}{}", why, what);
    spdlog::default_logger_raw()->flush();
    bool const logged = telemetry.dropped_log_lines() == dropped;  // false if there was no memory for the line
    if (!logged)
        for (auto const part : {why, what}) std::ignore = ::write(STDERR_FILENO, part.data(), part.size());
    std::_Exit(internal_software_error);
}

}  // namespace rois
