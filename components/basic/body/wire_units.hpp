// Converts between metres and radians and the millimetres and degrees of messages (decision 27).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "basic/body/pose.hpp"
#include "types/values.hpp"

namespace rois::basic {

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

// Returns the rows of a covariance in mm and degrees, rounded to a thousandth.
std::vector<double> rows_of(Covariance const&);

}  // namespace rois::basic
