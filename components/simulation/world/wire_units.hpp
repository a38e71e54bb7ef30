// Converts between metres and radians and the millimetres and degrees of messages (decision 27).
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/frames/frames.hpp"
#include "simulation/plan/geometry.hpp"
#include "simulation/world/pose.hpp"
#include "types/condition.hpp"
#include "types/values.hpp"

namespace rois::simulation {

// Rounded to a thousandth; angles in (-180, 180].
double millimetres(Metres);
double degrees(Radians);

// Returns "x, y, th" in whole mm, mm, degrees: "12500, 3000, -90".
std::string to_wire(Pose const&);

// A position to go to, optionally with a heading.
struct Target {
    Point position = Point::Zero();
    std::optional<Radians> heading;
};

// Reads "x, y, th" or "x, y". Returns nothing if the text is neither, or a number is not finite.
std::optional<Target> target_from_wire(std::string_view);

// The structured form of one position: `height` becomes z, the covariance is converted to mm and degrees.
Located located(std::string of, std::string ref, std::string crs, Pose const&, Metres height, std::optional<Covariance> const&);

// Makes the frame `crs` that has this pose in `base`.
Frame placed(std::string crs, std::string base, Pose const&, Covariance const&);

// Makes the geometry of a box of the floor, for conditions.
Geometry area(std::string crs, Box const&);

}  // namespace rois::simulation
