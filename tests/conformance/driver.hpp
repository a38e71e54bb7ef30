// An application that drives a robot a little, watches it, and brings it back.
#pragma once

#include <string>
#include <vector>

#include "conformance/observation.hpp"

namespace rois::conformance {

class Driver {
public:
    // Binds `wheels`, a component that moves its robot. NotObservable when its robot cannot be seen, or too coarsely for a motion
    // of Stage::room().
    Driver(Stage&, Component const& wheels);
    ~Driver();
    Driver(Driver const&) = delete;
    Driver& operator=(Driver const&) = delete;

    // Orders the command, and watches the robot until it ends, or until `enough` holds. NotPlayed when another application has
    // what the component needs.
    Trip go(std::vector<Argument> arguments, std::function<bool(Sighting const&)> const& enough = nobody_has_enough);
    // The same, until the robot has left the place where it stands. `ordered` is the command then.
    Trip set_off(std::vector<Argument> arguments);

    // Four points, Stage::room() away, the one that needs the least turning first. Both of their coordinates differ from those of
    // `home`, so that a robot that confuses axes or signs ends somewhere else.
    std::vector<Point> destinations() const;

    // The robot is there, allowing for measurement errors and late reports, and stays there.
    void require_at(Point const& place) const;
    // The robot stands still for a moment.
    void require_rest(std::string const& when) const;

    Stage& stage;
    Component const& wheels;
    Guest guest;
    Eye eye;
    Sighting home;
    std::string ordered;  // the last command

private:
    static bool nobody_has_enough(Sighting const&) { return false; }
};

std::string shown(Sighting const&);

}  // namespace rois::conformance
