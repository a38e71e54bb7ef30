// Positions as RoIS writes them (decision 27): millimetres, and degrees counter-clockwise.
#pragma once

#include <optional>
#include <string>

namespace rois::conformance {

struct Point {
    double x = 0, y = 0;
    std::optional<double> heading{};  // degrees
};

// Reads "x, y" or "x, y, th". Returns nothing for any other text, such as the name of a place.
std::optional<Point> point_in(std::string text);
std::string text_of(Point const&);

double distance(Point const&, Point const&);
// Returns the turn from one heading to another, -180 to 180 degrees, positive to the left.
double turn(double from, double to);
// Returns the point at this distance (mm) and direction (degrees) from `from`, with the heading of `from`.
Point ahead(Point const& from, double distance, double direction);
double direction(Point const& from, Point const& to);

}  // namespace rois::conformance
