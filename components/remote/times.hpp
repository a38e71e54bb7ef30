// The times of links to other engines (docs/engines.md).
#pragma once

#include <algorithm>
#include <chrono>
#include <string>

namespace rois::remote {

inline constexpr std::chrono::seconds ping_interval{1};     // two seconds of silence end a link
inline constexpr std::chrono::seconds time_for_attempt{5};  // until there is a session, or the other engine has joined

// "5 s"
inline std::string shown(std::chrono::seconds time) { return std::to_string(time.count()) + " s"; }

// While a session may be resumed. Later, `pause_after`.
inline constexpr std::chrono::milliseconds pause_within_window{200};

// The pause before the next attempt: 0.1 s, then twice as long each time, 30 s at most.
inline std::chrono::milliseconds pause_after(unsigned failures) {
    return std::min(std::chrono::milliseconds{30'000}, std::chrono::milliseconds{100} * (1 << std::min(failures, 10U)));
}

}  // namespace rois::remote
