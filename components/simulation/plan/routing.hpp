// The cost of paths: metres, or the seconds that a robot needs to drive along the corners.
#pragma once

#include <vector>

#include "basic/body/motion.hpp"
#include "simulation/world/units.hpp"

namespace rois::simulation {

using basic::RoutingPolicy;

// The limits of motion of a robot or person.
struct Agility {
    MetresPerSecond speed = 1;
    double acceleration = 1;  // m/s^2, also when braking
    RadiansPerSecond turn_rate = 1;
    double turn_acceleration = 1;  // rad/s^2
};

// At a sharper corner the robot stops and turns on the spot. It drives through other corners.
inline constexpr Radians sharpest_bend = 0.6;

// For turns on the spot: the speed at which the turn begins, and the remaining angle at which the robot drives on.
inline constexpr MetresPerSecond slow_enough = 0.05;
inline constexpr Radians turned_enough = 0.04;

// Within this distance a corner counts as reached.
inline constexpr Metres near_corner = 0.06;

// The speed in a corner, 0 beyond sharpest_bend; and the speed when the corner counts as reached.
MetresPerSecond corner_speed(Radians turn, Agility const&);
MetresPerSecond passing_speed(Radians turn, Agility const&);

// The duration of the turn on the spot at the start, and the extra time of a corner in addition to braking and accelerating.
Seconds turn_duration(Radians turn, Agility const&);
Seconds corner_duration(Radians turn, Agility const&);

// The duration of a straight leg with these speeds at its ends.
Seconds leg_duration(Metres length, MetresPerSecond at_begin, MetresPerSecond at_end, Agility const&);

// The duration and length of a whole path. The robot stands at `from` and at the last corner.
Seconds duration(Pose const& from, std::vector<Point> const& way, Agility const&);
Metres length(Point const& from, std::vector<Point> const& way);

}  // namespace rois::simulation
