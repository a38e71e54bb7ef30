// An application that moves a robot a short way, observes it, and returns it to its starting point.
#pragma once

#include <string>
#include <vector>

#include "conformance/observation.hpp"

namespace rois::conformance {

class Driver {
public:
    // Binds `mover`, a component that moves its robot. Throws NotObservable if the position of the robot is not reported, or if
    // its error is too large for a motion of Context::room().
    Driver(Context&, Component const& mover);
    ~Driver();
    Driver(Driver const&) = delete;
    Driver& operator=(Driver const&) = delete;

    // Executes `start`, and observes the robot until the command completes or `is_enough` holds. Throws Skipped if another
    // application uses a component or resource that the command needs.
    Trip run(std::vector<Argument> arguments, std::function<bool(RobotPosition const&)> const& is_enough = never);
    // Executes `start`, and returns as soon as the robot has moved. `last_command` is the id of the running command.
    Trip start_moving(std::vector<Argument> arguments);

    // Returns four points at the distance Context::room(), the one with the smallest turn first. Both coordinates of each differ
    // from those of `home`: a robot that confuses axes or signs does not reach them.
    std::vector<Point> destinations() const;

    // Requires that the robot is at this place and stays there. Allows for measurement errors and late reports.
    void require_at(Point const& place) const;
    // Requires that the robot stands still for a second. `when` completes the message: "after stop".
    void require_rest(std::string const& when) const;

    Context& context;
    Component const& mover;
    Client client;
    PositionObserver observer;
    RobotPosition home;
    std::string last_command;  // the command id of the last `start`

private:
    static bool never(RobotPosition const&) { return false; }
};

std::string text_of(RobotPosition const&);

}  // namespace rois::conformance
