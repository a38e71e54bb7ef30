// What RoIS itself says about the world: where a robot is while it moves, and how long commands take.
#pragma once

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "conformance/point.hpp"
#include "conformance/stage.hpp"

namespace rois::conformance {

using std::chrono::milliseconds;

// One row of robot_position (table 34).
struct Sighting {
    std::string robot;  // its code
    Point at;
    double sigma = 5;          // mm; the reported standard deviation, or an assumed one
    double heading_sigma = 1;  // degrees
    std::string timestamp;
};

// The part of a measured difference between two positions, or headings, that measurement errors can explain.
double noise(double sigma);
double noise(Sighting const&);          // mm
double heading_noise(Sighting const&);  // degrees
// How far a robot may end from where it should, after `distance` millimetres.
double tolerance(Sighting const&, double distance);
double heading_tolerance(Sighting const&);

// The standard deviations of position (mm) and heading (degrees) in a `covariance`, written row by row; nothing when it is not
// square.
std::optional<std::pair<double, double>> deviations_in(std::string const& covariance);

// Sees the robot of one component.
class Eye {
public:
    // NotObservable when no single component of the same engine reports robot_position.
    Eye(Guest&, Component const& of);

    Sighting look() const;
    // Repeats the observation until this holds, for at most half a second, because reports may lag. Returns the last observation.
    Sighting look_until(std::function<bool(Sighting const&)> const& holds) const;

private:
    Guest& guest_;
    std::string of_;
    Component const* teller_ = nullptr;
};

struct Trip {
    std::string status;  // with which the command completed
    Sighting end;        // right after that
    std::vector<Sighting> way;
    milliseconds took{};
};

// Looks at the robot until the command completes. Waits for as long as the robot moves, and then for the patience. Ends early,
// with the status "", as soon as `enough` holds.
Trip watch(
    Stage&, Guest&, Eye const&, std::string const& command_id,
    std::function<bool(Sighting const&)> const& enough = [](Sighting const&) { return false; });

// Expects that the command completes with OK after its running time. Throws NotPlayed if the component has failed.
void require_end(Guest&, std::string const& command_id, Component const&);
// Expects that the command completes with OK. Returns the time from the request to its end. Throws NotPlayed if the component has
// failed.
milliseconds duration_of(Guest&, Command const&, Component const&);
// How long a command takes that completes at once: the way to the component and back.
milliseconds shortest_duration(Guest&, Component const&);

void wait(milliseconds);

}  // namespace rois::conformance
