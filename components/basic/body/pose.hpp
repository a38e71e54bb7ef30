// Units, poses and time of the basic components. Units are SI: metres, radians (counter-clockwise) and seconds. Only
// wire_units.hpp converts to the millimetres and degrees of messages. x points to the right of the floor plan, y up, and heading
// 0 along x.
#pragma once

#include <Eigen/Geometry>
#include <chrono>
#include <numbers>

namespace rois::basic {

using Metres = double;
using Radians = double;
using Seconds = double;
using MetresPerSecond = double;
using RadiansPerSecond = double;

// The time of the robot's world. In a simulation it may be faster or slower than real time, or stand still.
using WorldTime = std::chrono::milliseconds;

constexpr Seconds in_seconds(WorldTime t) { return static_cast<double>(t.count()) / 1000.0; }
constexpr WorldTime world_time(Seconds s) { return WorldTime{static_cast<WorldTime::rep>(s * 1000.0 + (s < 0 ? -0.5 : 0.5))}; }
constexpr Radians from_degrees(double degrees) { return degrees * std::numbers::pi / 180.0; }
constexpr double to_degrees(Radians angle) { return angle * 180.0 / std::numbers::pi; }

using Point = Eigen::Vector2d;

// Covariance of a pose in the order x, y, heading; in m^2, m rad and rad^2.
using Covariance = Eigen::Matrix3d;

struct Pose {
    Point position = Point::Zero();
    Radians heading = 0;
};

struct Twist {
    MetresPerSecond linear = 0;  // along the heading
    RadiansPerSecond angular = 0;
};

Radians wrapped(Radians angle);  // returns the same angle in (-pi, pi]
Metres distance(Point const& a, Point const& b);
Radians direction(Point const& from, Point const& to);  // 0 if the points are equal
Radians bearing(Pose const& from, Point const& to);     // relative to the heading of `from`, in (-pi, pi]
Point unit(Radians heading);

// Returns the transform from the frame of a body (x ahead, y to its left) to the frame of its pose.
Eigen::Isometry2d frame(Pose const& body);

}  // namespace rois::basic
