// The current measurements of a robot's sensors, nearest first, in the hall's frame. Pure functions of the hall's state: the
// noise depends only on the hall's seed, the step, the robot, the sensor and the person.
#pragma once

#include <vector>

#include "basic/body/perception.hpp"
#include "simulation/world/hall.hpp"

namespace rois::simulation {

// The people and faces in range, in the field of view and in sight. The faces are turned to the robot.
std::vector<basic::Sighting> people_seen(Hall const&, RobotId);
std::vector<basic::Sighting> faces_seen(Hall const&, RobotId);

// The people who are near enough and turned to the robot.
std::vector<basic::RecognizedPerson> people_recognized(Hall const&, RobotId);

// The people and other robots who speak now within hearing range: "sound-3" for "person-3", "sound-robot2" for the robot of that
// name.
std::vector<basic::Sighting> sounds_heard(Hall const&, RobotId);

// Whether the robot hears speech at `place`. A wall in between halves the range.
bool hears(Hall const&, RobotId, Point const& place);

// Whether the robot sees a gesture at `place`: in range, in the field of view and in sight.
bool sees_gesture(Hall const&, RobotId, Point const& place);

}  // namespace rois::simulation
