// The one place where metres and radians become the millimetres and degrees of messages (decision 27), and back.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/frames.hpp"
#include "simulation/geometry.hpp"
#include "simulation/pose.hpp"
#include "types/condition.hpp"
#include "types/values.hpp"

namespace rois::simulation {

// To a thousandth, finer than anything here is measured; an angle in (-180, 180].
double millimetres(Metres);
double degrees(Radians);

// "x, y, th" in mm, mm, degrees, rounded to whole ones: "12500, 3000, -90".
std::string to_wire(Pose const&);

// A position to go to, with or without a heading to have there.
struct Target {
    Point position = Point::Zero();
    std::optional<Radians> heading;
};

// Reads "x, y, th" or "x, y"; nothing when it is neither, or not finite.
std::optional<Target> target_from_wire(std::string_view);

// The structured form of one position: `height` becomes z, the covariance (when there is one) x, y, th in mm and degrees.
Located located(std::string of, std::string ref, std::string crs, Pose const&, Metres height, std::optional<Covariance> const&);

// A frame that is placed in `base` like this.
Frame placed(std::string crs, std::string base, Pose const&, Covariance const&);

// A box of the floor as conditions have it.
Geometry area(std::string crs, Box const&);

}  // namespace rois::simulation
