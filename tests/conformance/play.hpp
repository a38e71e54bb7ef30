// Plays the checks against a gateway.
#pragma once

#include <string>
#include <vector>

#include "client/address.hpp"
#include "client/application.hpp"
#include "conformance/report.hpp"

namespace rois::conformance {

struct Order {
    std::string url;
    client::Address address;
    std::vector<client::Way> ways{client::Way::http, client::Way::websocket};
    std::string only{};               // checks whose name has this within; empty: all
    double room = 300;                // mm that a robot may move from where it stands
    std::chrono::seconds limit{600};  // for all; when it is over, the report says so and is not good
};

// Whether there is a check with such a name over one of these ways.
bool is_any_asked_for(Order const&);

// Throws client::LineEnded when the gateway is not there or does not open a session.
Report play(Order const&);

}  // namespace rois::conformance
