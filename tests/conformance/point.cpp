#include "conformance/point.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace rois::conformance {

namespace {

constexpr double degree = std::numbers::pi / 180;

}  // namespace

std::optional<Point> point_in(std::string text) {
    std::ranges::replace(text, ',', ' ');
    std::istringstream numbers{text};
    Point point{};
    if (!(numbers >> point.x >> point.y)) return {};
    if (double heading = 0; numbers >> heading) point.heading = heading;
    return point;
}

std::string text_of(Point const& point) {
    auto const text = std::to_string(point.x) + ", " + std::to_string(point.y);
    return point.heading ? text + ", " + std::to_string(*point.heading) : text;
}

double distance(Point const& one, Point const& other) { return std::hypot(other.x - one.x, other.y - one.y); }

double turn(double from, double to) { return std::remainder(to - from, 360); }

Point ahead(Point const& from, double distance, double direction) {
    return {from.x + distance * std::cos(direction * degree), from.y + distance * std::sin(direction * degree), from.heading};
}

double direction(Point const& from, Point const& to) { return std::atan2(to.y - from.y, to.x - from.x) / degree; }

}  // namespace rois::conformance
