#include "gateway/health.hpp"

#include <chrono>

namespace rois {

namespace {

constexpr std::chrono::milliseconds longest_tick{500};  // since the last tick of a healthy engine

}  // namespace

std::string why_not_alive(Telemetry const& telemetry) {
    if (telemetry.age_of_last_tick(std::chrono::steady_clock::now()) <= longest_tick) return {};
    return "the engine has not ticked for more than 0.5 s: a component blocks, or the process is overloaded\n";
}

std::string why_not_ready(Gateway const& gateway, Telemetry const& telemetry, Principal const* asker) {
    if (auto trouble = why_not_alive(telemetry); !trouble.empty()) return trouble;
    std::string trouble;
    if (gateway.everything_is_stopped()) trouble = "stopped: nothing starts until POST /rois/clear\n";
    auto const all = gateway.not_ready();
    auto const seen = seen_by(asker, all);
    for (auto const& ref : seen) trouble += ref + " has not confirmed that it stands still\n";
    if (trouble.empty() && !all.empty()) trouble = "not ready\n";
    return trouble;
}

}  // namespace rois
