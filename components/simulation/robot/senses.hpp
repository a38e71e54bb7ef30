// The current measurements of a robot's sensors, nearest first, in the hall's frame. Pure functions of the hall's state: the
// noise depends only on the hall's seed, the step, the robot, the sensor and the person.
#pragma once

#include <string>
#include <vector>

#include "simulation/world/hall.hpp"

namespace rois::simulation {

// The measurement of a person or a face in range, in the field of view and in sight.
struct Seen {
    PersonId person;
    std::string ref;  // the temporary name: "person-3", "face-3"
    Pose pose;        // of a face: its heading
    Metres height;    // of the person, or of the face above the floor
    Covariance covariance;
};
std::vector<Seen> people_seen(Hall const&, RobotId);
std::vector<Seen> faces_seen(Hall const&, RobotId);  // faces that are turned to the robot

// A person who is near enough and turned to the robot, so that the robot can identify them.
struct RecognizedPerson {
    PersonId person;
    std::string ref;  // the permanent id of a known person, else the temporary name
    bool known;
    std::string track;  // the temporary name in both cases
};
std::vector<RecognizedPerson> people_recognized(Hall const&, RobotId);

// A person or another robot who speaks now within hearing range.
struct HeardSound {
    Entity who;
    std::string ref;  // "sound-3" for "person-3", "sound-robot2" for the robot of that name
    Pose pose;        // measured; the heading is the direction from the robot to the source
    Metres height;    // of the mouth above the floor
    Covariance covariance;
};
std::vector<HeardSound> sounds_heard(Hall const&, RobotId);

// Whether the robot hears speech at `place`. A wall in between halves the range.
bool hears(Hall const&, RobotId, Point const& place);

// Whether the robot sees a gesture at `place`: in range, in the field of view and in sight.
bool sees_gesture(Hall const&, RobotId, Point const& place);

}  // namespace rois::simulation
