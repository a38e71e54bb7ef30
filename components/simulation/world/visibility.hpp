// Who sees and hears whom, without noise.
#pragma once

#include <cmath>

#include "simulation/plan/floor_plan.hpp"
#include "simulation/world/person.hpp"

namespace rois::simulation {

// Whether somebody with this pose sees `place`.
inline bool reaches(FloorPlan const& plan, Pose const& self, Point const& place, Metres range, Radians field_of_view) {
    return distance(self.position, place) <= range && std::abs(bearing(self, place)) <= field_of_view / 2 &&
           plan.in_sight(self.position, place);
}

// Whether the person's face looks at the robot within this angle to either side.
inline bool is_turned_to(Person const& person, Pose const& robot, Radians within) {
    return std::abs(bearing(person.pose, robot.position)) <= within;
}

inline bool sees(FloorPlan const& plan, Sensors::People const& sensor, Pose const& robot, Person const& person) {
    return reaches(plan, robot, person.pose.position, sensor.range, sensor.field_of_view);
}

inline bool sees_face(FloorPlan const& plan, Sensors::Faces const& sensor, Pose const& robot, Person const& person) {
    return reaches(plan, robot, person.pose.position, sensor.range, sensor.field_of_view) &&
           is_turned_to(person, robot, sensor.turned_within);
}

inline bool recognizes(FloorPlan const& plan, Sensors::Identification const& sensor, Pose const& robot, Person const& person) {
    return reaches(plan, robot, person.pose.position, sensor.range, sensor.field_of_view) &&
           is_turned_to(person, robot, sensor.turned_within);
}

// Whether somebody at `here` hears a sound at `place`. A wall in between halves the range.
inline bool hears(FloorPlan const& plan, Point const& here, Point const& place, Metres range) {
    return distance(here, place) <= (plan.in_sight(here, place) ? range : range / 2);
}

}  // namespace rois::simulation
