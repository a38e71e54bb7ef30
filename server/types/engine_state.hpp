// The state of a sub engine, for `GET /rois/engines` and the metrics (docs/engines.md).
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rois {

struct EngineState {
    enum class Is : std::uint8_t {
        absent,   // not here yet, or its components have left
        present,  // its components can be used
        lost,     // its link is missing, but may return within the window
        given_up  // its components are in ERROR until it returns
    };

    std::string name;
    Is is = Is::absent;
    std::string link;                                    // its URL, or how it joins
    std::optional<std::chrono::nanoseconds> round_trip;  // of the last request; nothing: there is no link
    std::size_t components = 0;
    std::uint64_t losses = 0;  // how often its link was lost
    std::string last_error;    // also when it is present again; empty: there was none
};

std::string_view to_text(EngineState::Is);

}  // namespace rois
