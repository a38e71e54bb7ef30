// Relations between geometries (ISO 19143, spatial operators; OGC Simple Features). Edges belong to a geometry, also for `within`
// and `contains`. If one of two geometries is two-dimensional, both are compared in the plane.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "types/condition.hpp"
#include "types/values.hpp"

namespace rois {

// Returns whether the coordinates can be compared: their frames are the same, or one of the frames is not given.
bool share_a_frame(Geometry const&, Geometry const&);

bool holds(SpatialRelation, Geometry const&, Geometry const&);
double distance(Geometry const&, Geometry const&);  // in mm, from edge to edge; 0 if they intersect

Geometry point(Located const&);

// Parses "x, y" or "x, y, th" in mm and degrees (decision 27). Returns nullopt for other texts.
std::optional<Geometry> point(std::string_view text, std::string crs);

// Returns the same text for equal geometries.
std::string canonical(Geometry const&);
std::string canonical(double);

}  // namespace rois
