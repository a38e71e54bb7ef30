// The floor plan for others: as a map for applications that draw it, and as places for the engine's conditions.
#pragma once

#include "engine/frames/places.hpp"
#include "simulation/plan/floor_plan.hpp"
#include "types/floor_map.hpp"

namespace rois::simulation {

// Returns everything visible of the plan. Robot positions are missing: the robots' components report them.
FloorMap floor_map(FloorPlan const&);

// Returns the hall and its places by name, in the hall's frame, and the frames of the robots.
Places named_places(FloorPlan const&);

}  // namespace rois::simulation
