// Runs rois-conformance against a gateway.
#pragma once

#include <cstdint>
#include <iosfwd>
#include <set>
#include <string>
#include <vector>

#include "kit/gateway_process.hpp"
#include "kit/profile_folder.hpp"

namespace rois::broken {

struct Judged {
    int exit_code = -1;
    std::string text{};
};

// Prints the checks that found a broken rule, and why. If there are none, prints the whole report.
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

// Two robots in gateways of their own, and the main engine above them. Its components choose between those of the robots.
class Team {
public:
    Team();
    ~Team();
    Team(Team const&) = delete;
    Team& operator=(Team const&) = delete;

    std::uint16_t port() const { return main_.port(); }
    // The shell command for --disturb: the robot of $COMPONENT stands still for six seconds, as if it had crashed.
    std::string disturbance() const;

private:
    std::string engines() const;

    kit::ProfileFolder folder_;
    EmptyHall robot1_, robot2_;
    kit::GatewayProcess main_;
};

std::string url(std::uint16_t port);

}  // namespace rois::broken
