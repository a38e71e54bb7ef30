// rois-conformance as a program, and the gateway that it judges.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "server/gateway_process.hpp"

namespace rois::broken {

struct Judged {
    int exit_code = -1;
    std::string text{};
};

// Runs rois-conformance with these arguments.
Judged judge(std::string const& arguments);

// The names of the checks that found a broken rule, or that held.
std::set<std::string> broken_in(std::string const& report);
std::set<std::string> held_in(std::string const& report);

// Our gateway with nobody in its hall, twenty times as fast as the clock unless the settings say otherwise.
struct EmptyHall : test::GatewayProcess {
    explicit EmptyHall(std::vector<std::string> const& settings = {});
};

std::string url(std::uint16_t port);

}  // namespace rois::broken
