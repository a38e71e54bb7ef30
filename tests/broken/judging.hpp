// Runs rois-conformance against a gateway.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <set>
#include <string>
#include <vector>

#include "kit/gateway_process.hpp"

namespace rois::broken {

struct Judged {
    int exit_code = -1;
    std::string text{};
};

// Prints the report without the checks that held.
std::ostream& operator<<(std::ostream&, Judged const&);

// Runs rois-conformance with these arguments.
Judged judge(std::string const& arguments);

// Return the names of the checks that found a broken rule, and of the checks that passed.
std::set<std::string> broken_in(std::string const& report);
std::set<std::string> held_in(std::string const& report);

// Our gateway with an empty hall. The simulation runs 20 times as fast as real time, unless the settings change that.
struct EmptyHall : kit::GatewayProcess {
    explicit EmptyHall(std::vector<std::string> const& settings = {});
};

std::string url(std::uint16_t port);

}  // namespace rois::broken
