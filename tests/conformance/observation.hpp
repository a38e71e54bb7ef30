// Observes the effects of commands through RoIS: the position of a robot while it moves, and the duration of commands.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "conformance/context.hpp"
#include "conformance/point.hpp"

namespace rois::conformance {

using std::chrono::milliseconds;

// An answer of robot_position (table 34).
struct RobotPosition {
    std::string robot;  // the code of its robot_ref; may be empty
    Point at;
    double sigma = 5;          // mm; the reported standard deviation, or an assumed one
    double heading_sigma = 1;  // degrees
    std::string timestamp;
};

// Return the greatest difference between two measurements of the same position (mm) or heading (degrees).
double noise(double sigma);
double noise(RobotPosition const&);
double heading_noise(RobotPosition const&);
// Return the allowed error of position (mm) and heading (degrees) after a motion of `distance` millimetres.
double tolerance(RobotPosition const&, double distance);
double heading_tolerance(RobotPosition const&);

// Returns the standard deviations of position (mm) and heading (degrees) in a `covariance`, written row by row. Returns nothing
// if the matrix is not square.
std::optional<std::pair<double, double>> deviations_in(std::string const& covariance);

// Observes the robot of one component.
class PositionObserver {
public:
    // Throws NotObservable unless exactly one component of the same engine reports robot_position.
    PositionObserver(Client&, Component const& of);

    RobotPosition observe() const;
    // Repeats the observation until the condition holds, for at most half a second: reports may lag. Returns the last
    // observation.
    RobotPosition observe_until(std::function<bool(RobotPosition const&)> const& holds) const;

private:
    Client& client_;
    std::string of_;
    Component const* reporter_ = nullptr;
};

struct Trip {
    std::string status;  // of the completed command; empty if the observation ended early
    RobotPosition end;   // the last observation
    std::vector<RobotPosition> path;
    milliseconds duration{};
};

// Observes the robot until the command completes. Throws Broken if the robot stands still for longer than the patience before
// that. Returns early, with the status "", as soon as `is_enough` holds.
Trip observe_command(
    Context&, Client&, PositionObserver const&, std::string const& command_id,
    std::function<bool(RobotPosition const&)> const& is_enough = [](RobotPosition const&) { return false; });

// Waits while the command runs, then requires the status OK. Throws Skipped if the component has failed.
void await_success(Client&, std::string const& command_id, Component const&);
// Requires that the command completes with OK. Returns the time from the request to its end. Throws Skipped if the component has
// failed.
milliseconds duration_of(Client&, Command const&, Component const&);
// Returns the shortest of three durations: a delay between the client and the robot only makes one longer.
milliseconds shortest_duration(Client&, Command const&, Component const&);

void wait(milliseconds);

}  // namespace rois::conformance
