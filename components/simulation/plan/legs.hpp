// Finds the best path of straight legs over given points.
#pragma once

#include <functional>
#include <vector>

#include "simulation/plan/routing.hpp"

namespace rois::simulation {

// The start, the target and the points that a path may use.
struct Crossing {
    Pose from;
    Point to;
    std::vector<Point> over;
};

// Whether the straight line between two points is free. Index 0 is `from`, then follow the points of `over`, the last is `to`.
using CanGo = std::function<bool(std::size_t, std::size_t)>;

// Returns the corners of the best path (without `from`, with `to`) that costs less than `bound`, in seconds or metres as the
// policy counts. Empty if there is none.
std::vector<Point> best_legs(Crossing const&, CanGo const&, RoutingPolicy, Agility const&, double bound);

}  // namespace rois::simulation
