// Units, places and frames of the simulated world. Inside it everything is SI: metres, radians counter-clockwise, seconds; the
// wire's millimetres and degrees are made in wire_units.hpp and nowhere else. The frame of the hall: x to the right of the floor
// plan, y up, heading 0 along x.
#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <numbers>

namespace rois::simulation {

using Metres = double;
using Radians = double;
using Seconds = double;
using MetresPerSecond = double;
using RadiansPerSecond = double;

// Time since the world began, in its own seconds: never the real clock's.
using WorldTime = std::chrono::milliseconds;

constexpr Seconds in_seconds(WorldTime t) { return static_cast<double>(t.count()) / 1000.0; }
constexpr WorldTime world_time(Seconds s) { return WorldTime{static_cast<WorldTime::rep>(s * 1000.0 + (s < 0 ? -0.5 : 0.5))}; }
constexpr Radians from_degrees(double degrees) { return degrees * std::numbers::pi / 180.0; }
constexpr double to_degrees(Radians angle) { return angle * 180.0 / std::numbers::pi; }

using Point = Eigen::Vector2d;

// Of a measured pose, ordered x, y, heading: m^2, m rad, rad^2.
using Covariance = Eigen::Matrix3d;

struct Pose {
    Point position = Point::Zero();
    Radians heading = 0;
};

struct Twist {
    MetresPerSecond linear = 0;  // along the heading
    RadiansPerSecond angular = 0;
};

Radians wrapped(Radians angle);  // into (-pi, pi]
Metres distance(Point const& a, Point const& b);
Radians direction(Point const& from, Point const& to);  // in the hall's frame; 0 when they are the same
Radians bearing(Pose const& from, Point const& to);     // relative to the heading of `from`, in (-pi, pi]
Point unit(Radians heading);

// From the frame of a body at that pose (x ahead, y to its left) to the hall's; `.inverse()` goes back.
Eigen::Isometry2d frame(Pose const& body);

}  // namespace rois::simulation
