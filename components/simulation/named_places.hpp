// The floor plan as conditions speak of it.
#pragma once

#include "engine/places.hpp"
#include "simulation/floor_plan.hpp"

namespace rois::simulation {

// The hall under its own name, and its places, in the hall's frame; and the frames of robots that have one of their own.
Places named_places(FloorPlan const&);

}  // namespace rois::simulation
