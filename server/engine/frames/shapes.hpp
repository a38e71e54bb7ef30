// Relations between lines, circles, polygons, points and boxes in the plane (OGC Simple Features). Lines and polygons use
// Boost.Geometry. Circles are computed exactly, not as polygons.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "types/condition.hpp"

namespace rois {

// A point counts as lying on a circle's edge if it is nearer to the edge than this.
inline constexpr double circle_tolerance = 1e-6;  // mm

// Like `holds` and `distance` in space.hpp. At least one geometry must be a line, circle or polygon, and all must be valid.
bool holds_in_plane(SpatialRelation, Geometry const&, Geometry const&);
double distance_in_plane(Geometry const&, Geometry const&);

// Returns why a line, circle or polygon is invalid, such as "polygon whose edges cross or touch one another"; nullopt if it is
// valid.
std::optional<std::string> why_invalid(Geometry const&);

// The number of pairs of an edge of one and an edge of the other whose bounding boxes meet: `holds` and `why_invalid` take up to
// some microseconds for each of them.
std::size_t meeting_edges(Geometry const&, Geometry const&);

}  // namespace rois
