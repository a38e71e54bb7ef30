// What a way costs: in metres, or in seconds by the rules by which a robot drives along corner points.
#pragma once

#include <cstdint>
#include <vector>

#include "simulation/pose.hpp"

namespace rois::simulation {

// `time`: fewest seconds, turns and braking counted; `distance`: shortest. RoIS's routing_policy (table 46).
enum class RoutingPolicy : std::uint8_t { time, distance };

// How fast somebody moves, at most.
struct Agility {
    MetresPerSecond speed = 1;
    double acceleration = 1;  // m/s^2, also when braking
    RadiansPerSecond turn_rate = 1;
    double turn_acceleration = 1;  // rad/s^2
};

// For a corner that is sharper, a robot stops and turns on the spot; the others are taken on the way.
inline constexpr Radians sharpest_bend = 0.6;

// It begins to turn when it is as slow as that, and drives on when it is turned away by no more than that.
inline constexpr MetresPerSecond slow_enough = 0.05;
inline constexpr Radians turned_enough = 0.04;

// A corner counts as reached when it is as near as that.
inline constexpr Metres near_corner = 0.06;

// How fast a robot would be in a corner; 0 beyond the sharpest bend. And how fast it is when it has reached the corner.
MetresPerSecond corner_speed(Radians turn, Agility const&);
MetresPerSecond passing_speed(Radians turn, Agility const&);

// The turn on the spot with which a way begins, and what a corner costs beyond braking and getting up to speed again.
Seconds turn_duration(Radians turn, Agility const&);
Seconds corner_duration(Radians turn, Agility const&);

// A straight leg with these speeds at its ends.
Seconds leg_duration(Metres length, MetresPerSecond at_begin, MetresPerSecond at_end, Agility const&);

// A whole way along corner points, from standing at `from` to standing at the last one, and its length.
Seconds duration(Pose const& from, std::vector<Point> const& way, Agility const&);
Metres length(Point const& from, std::vector<Point> const& way);

}  // namespace rois::simulation
