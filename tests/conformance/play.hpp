// Plays the checks against a gateway.
#pragma once

#include <string>
#include <vector>

#include "conformance/report.hpp"
#include "kit/address.hpp"
#include "kit/application.hpp"

namespace rois::conformance {

struct Order {
    std::string url;
    kit::Address address;
    std::vector<kit::Way> ways{kit::Way::http, kit::Way::websocket};
    std::string only{};               // checks whose name has this within; empty: all
    double room = 300;                // mm that a robot may move from where it stands
    std::chrono::seconds limit{600};  // for all; when it is over, the report says so and is not good
};

// Whether there is a check with such a name over one of these ways.
bool is_any_asked_for(Order const&);

// Throws kit::LineEnded when the gateway is not there or does not open a session.
Report play(Order const&);

}  // namespace rois::conformance
