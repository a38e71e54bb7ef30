// The observable state of a robot in the hall.
#pragma once

#include <optional>
#include <string>

#include "simulation/robot/drive.hpp"
#include "simulation/world/person.hpp"

namespace rois::simulation {

// A reaction in progress.
struct Showing {
    std::string reaction;  // its code
    WorldTime ends{};
};

// The observable state of a robot. Hall::drive() returns its drive.
struct Robot {
    RobotId id{};
    std::string name;
    Pose pose;
    Twist twist;
    std::optional<Speech> speaking;  // absent while held
    std::optional<Showing> showing;
    std::optional<double> battery;  // its charge in percent; absent: it never gets empty
};

}  // namespace rois::simulation
