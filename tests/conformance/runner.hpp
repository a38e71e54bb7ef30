// Runs the checks against a gateway.
#pragma once

#include <string>
#include <vector>

#include "conformance/report.hpp"
#include "kit/address.hpp"
#include "kit/application.hpp"

namespace rois::conformance {

struct RunOptions {
    std::string url;
    kit::Address address;
    std::vector<kit::Transport> transports{kit::Transport::http, kit::Transport::websocket};
    std::string only{};               // runs only checks whose name contains this text; empty: all
    std::string disturbance{};        // a shell command that makes the component $COMPONENT fail; empty: none
    double room = 300;                // the greatest distance of a robot from its starting point, in mm
    std::chrono::seconds limit{600};  // the longest time for all checks; later checks are skipped, and the report has a failure
};

// Returns whether at least one check has such a name and runs over one of these transports.
bool has_matching_check(RunOptions const&);

// Throws kit::LineEnded if the gateway does not answer or does not open a session.
Report run_checks(RunOptions const&);

}  // namespace rois::conformance
