// Positions as RoIS writes them (decision 27): millimetres, and degrees counter-clockwise.
#pragma once

#include <optional>
#include <string>

namespace rois::conformance {

struct Point {
    double x = 0, y = 0;
    std::optional<double> heading{};  // degrees
};

// "x, y" or "x, y, th"; nothing for any other text, such as the name of a place.
std::optional<Point> point_in(std::string text);
std::string text_of(Point const&);

double distance(Point const&, Point const&);
// From one heading to another, -180 to 180, positive to the left.
double turn(double from, double to);
// So far from `from`, in this direction. Keeps the heading of `from`.
Point ahead(Point const& from, double distance, double direction);
double direction(Point const& from, Point const& to);

}  // namespace rois::conformance
