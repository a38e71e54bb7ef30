#include "simulation/plan/geometry.hpp"

#include <algorithm>
#include <cmath>

namespace rois::simulation {
namespace {

double cross_product(Point const& a, Point const& b) { return a.x() * b.y() - a.y() * b.x(); }

// Returns the side of the line on which the point lies, as a sign; 0 on the line.
double side(Segment const& s, Point const& p) { return cross_product(s.to - s.from, p - s.from); }

bool within_extent(Segment const& s, Point const& p) {
    return (p.array() >= s.from.cwiseMin(s.to).array()).all() && (p.array() <= s.from.cwiseMax(s.to).array()).all();
}

}  // namespace

bool Box::contains(Point const& p) const { return (p.array() >= low.array()).all() && (p.array() <= high.array()).all(); }

Metres distance(Segment const& s, Point const& p) {
    Point along = s.to - s.from;
    double squared = along.squaredNorm();
    if (squared == 0) return distance(s.from, p);
    double part = std::clamp((p - s.from).dot(along) / squared, 0.0, 1.0);
    return distance(Point{s.from + part * along}, p);
}

Metres distance(Box const& box, Point const& p) { return distance(Point{p.cwiseMax(box.low).cwiseMin(box.high)}, p); }

bool cross(Segment const& a, Segment const& b) {
    double b_from = side(a, b.from), b_to = side(a, b.to), a_from = side(b, a.from), a_to = side(b, a.to);
    if (((b_from > 0) != (b_to > 0)) && ((a_from > 0) != (a_to > 0)) && b_from != 0 && b_to != 0 && a_from != 0 && a_to != 0)
        return true;
    return (b_from == 0 && within_extent(a, b.from)) || (b_to == 0 && within_extent(a, b.to)) ||
           (a_from == 0 && within_extent(b, a.from)) || (a_to == 0 && within_extent(b, a.to));
}

Metres free_way(Disc const& from, Radians heading, Disc const& other, Metres far) {
    Point const to_other = other.centre - from.centre;
    Metres const touch = from.radius + other.radius;
    double const ahead = to_other.dot(unit(heading));
    if (ahead <= 0) return far;  // moves away, even if the discs touch
    double const aside = to_other.squaredNorm() - ahead * ahead;
    if (aside >= touch * touch) return far;
    return std::clamp(ahead - std::sqrt(touch * touch - aside), 0.0, far);
}

}  // namespace rois::simulation
