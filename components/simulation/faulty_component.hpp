// Components that fail for a while, as a scenario says: so that an application can be tried against a robot that is not well.
#pragma once

#include <memory>

#include "engine/component.hpp"
#include "simulation/simulation.hpp"

namespace rois::simulation {

// The component itself when no fault of the simulation is about it; else the component as the faults let it be.
std::unique_ptr<Component> with_faults(std::unique_ptr<Component>, std::shared_ptr<Simulation> const&);

}  // namespace rois::simulation
