// The floor plan as others draw it.
#pragma once

#include "simulation/floor_plan.hpp"
#include "types/floor_map.hpp"

namespace rois::simulation {

// All of the plan that can be seen; where the robots are is told by their components.
FloorMap floor_map(FloorPlan const&);

}  // namespace rois::simulation
