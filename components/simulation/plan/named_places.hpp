// The places and frames of the floor plan, for conditions.
#pragma once

#include "engine/frames/places.hpp"
#include "simulation/plan/floor_plan.hpp"

namespace rois::simulation {

// Contains the hall and its places by name, in the hall's frame, and the frames of the robots.
Places named_places(FloorPlan const&);

}  // namespace rois::simulation
