// How lines, circles and polygons lie to each other, and to points and boxes, in the plane (OGC Simple Features). Lines and
// polygons are computed with Boost.Geometry, circles exactly: nothing is approximated by a polygon.
#pragma once

#include <optional>
#include <string>

#include "types/condition.hpp"

namespace rois {

// What is nearer to a circle's edge than this lies on the edge.
inline constexpr double circle_tolerance = 1e-6;  // mm

// As `holds` and `distance` (space.hpp). One of the two is a line, circle or polygon, and those are valid.
bool holds_in_plane(SpatialRelation, Geometry const&, Geometry const&);
double distance_in_plane(Geometry const&, Geometry const&);

// Why a line, circle or polygon is invalid, as "polygon whose edges cross or touch one another"; nothing when it is valid.
std::optional<std::string> why_invalid(Geometry const&);

}  // namespace rois
