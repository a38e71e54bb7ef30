// Components with the faults of a scenario, to test applications against a defective robot.
#pragma once

#include <memory>

#include "engine/component.hpp"
#include "simulation/world/simulation.hpp"

namespace rois::simulation {

// Wraps the component if the scenario has faults for it; else returns it unchanged.
std::unique_ptr<Component> with_faults(std::unique_ptr<Component>, std::shared_ptr<Simulation> const&);

}  // namespace rois::simulation
