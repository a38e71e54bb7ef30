// Plane geometry of walls, boxes and discs. Lengths in metres.
#pragma once

#include "simulation/world/units.hpp"

namespace rois::simulation {

// A wall without thickness.
struct Segment {
    Point from;
    Point to;
};

// An axis-parallel box. `low` has the smaller coordinates.
struct Box {
    Point low;
    Point high;

    bool contains(Point const& p) const;
};

// The floor that a person or robot takes up.
struct Disc {
    Point centre;
    Metres radius;
};

Metres distance(Segment const&, Point const&);
Metres distance(Box const&, Point const&);   // 0 inside
bool cross(Segment const&, Segment const&);  // true also if they only touch

// Returns how far the disc `from` can move along `heading` until it touches `other`, at most `far`.
Metres free_way(Disc const& from, Radians heading, Disc const& other, Metres far);

}  // namespace rois::simulation
