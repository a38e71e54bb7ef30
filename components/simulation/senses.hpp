// What the sensors of a robot make of the hall now. Pure functions of the hall's state: the noise is drawn from the hall's seed,
// the step, the robot, the sensor and the person, so that it is the same however often and by whom it is asked. All positions are
// in the hall's frame. Ordered by nearness.
#pragma once

#include <string>
#include <vector>

#include "simulation/hall.hpp"

namespace rois::simulation {

// A person within range, field of view and sight.
struct SeenPerson {
    PersonId person;
    std::string ref;  // the temporary name, "person-3"
    Pose pose;        // measured
    Metres height;
    Covariance covariance;
};
std::vector<SeenPerson> people_seen(Hall const&, RobotId);

// A face within range, field of view and sight that is turned to the robot.
struct SeenFace {
    PersonId person;
    std::string ref;  // "face-3" for "person-3"
    Pose pose;        // measured; heading: where it looks
    Metres height;    // of the face above the floor
    Covariance covariance;
};
std::vector<SeenFace> faces_seen(Hall const&, RobotId);

// A person near enough and turned to the robot to be recognized, or to be told unknown.
struct RecognizedPerson {
    PersonId person;
    std::string ref;  // the permanent id of a known person, else the temporary name
    bool known;
    std::string track;  // the temporary name in both cases
};
std::vector<RecognizedPerson> people_recognized(Hall const&, RobotId);

// Somebody who speaks now and is heard: a person, or another robot. The robot's own voice is left out.
struct HeardSound {
    Entity who;
    std::string ref;  // "sound-3" for "person-3", "sound-robot2" for the robot of that name
    Pose pose;        // measured; the heading is the direction from the robot to it
    Metres height;    // of the mouth above the floor
    Covariance covariance;
};
std::vector<HeardSound> sounds_heard(Hall const&, RobotId);

// Whether speech at `place` reaches the robot's ears: range, halved by a wall in between.
bool hears(Hall const&, RobotId, Point const& place);

// Whether the robot sees somebody at `place` gesture: range, field of view, sight.
bool sees_gesture(Hall const&, RobotId, Point const& place);

}  // namespace rois::simulation
