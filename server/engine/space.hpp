// How geometries lie to each other (ISO 19143, spatial operators; OGC Simple Features). Edges belong to a geometry, for `within`
// and `contains` as well. Where one of two is in the plane only, both are taken so.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "types/condition.hpp"
#include "types/values.hpp"

namespace rois {

// Whether coordinates of the two may be compared: frames are the same, or one says none.
bool share_a_frame(Geometry const&, Geometry const&);

bool holds(SpatialRelation, Geometry const&, Geometry const&);
double distance(Geometry const&, Geometry const&);  // mm, from edge to edge; 0 when they intersect

Geometry point(Located const&);

// "x, y" or "x, y, th" in mm and degrees (decision 27); nothing when it is neither.
std::optional<Geometry> point(std::string_view text, std::string crs);

// The same text for the same geometry.
std::string canonical(Geometry const&);
std::string canonical(double);

}  // namespace rois
