// The best way of straight legs over points that are given.
#pragma once

#include <functional>
#include <vector>

#include "simulation/routing.hpp"

namespace rois::simulation {

// From where, with which heading, to where, and over which points a way may go.
struct Crossing {
    Pose from;
    Point to;
    std::vector<Point> over;
};

// Whether one can go straight between two points: 0 is `from`, then come those of `over`, and the last is `to`.
using CanGo = std::function<bool(std::size_t, std::size_t)>;

// The corners of the best way (`from` not included, `to` included) that costs less than `bound`: seconds or metres, as the policy
// counts. Empty when there is none.
std::vector<Point> best_legs(Crossing const&, CanGo const&, RoutingPolicy, Agility const&, double bound);

}  // namespace rois::simulation
