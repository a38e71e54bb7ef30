// The floor plan as a document for applications that draw it.
#pragma once

#include "simulation/plan/floor_plan.hpp"
#include "types/floor_map.hpp"

namespace rois::simulation {

// Contains everything visible of the plan except robot positions, which the robots' components report.
FloorMap floor_map(FloorPlan const&);

}  // namespace rois::simulation
