// Plane geometry of walls, boxes and discs. Lengths in metres.
#pragma once

#include "simulation/pose.hpp"

namespace rois::simulation {

// A wall without thickness.
struct Segment {
    Point from;
    Point to;
};

// Axis-parallel; `low` has the smaller coordinates.
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
bool cross(Segment const&, Segment const&);  // also when they only touch

// How far a disc of `radius` at `from` can go along `heading` until it touches the other; `far` when it never does within `far`.
Metres free_way(Disc const& from, Radians heading, Disc const& other, Metres far);

}  // namespace rois::simulation
