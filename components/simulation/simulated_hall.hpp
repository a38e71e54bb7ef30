// The hall itself as a component: people in it are steered, and a world that stands still is moved on.
#pragma once

#include <memory>
#include <string_view>

#include "engine/component.hpp"
#include "simulation/simulation.hpp"

namespace rois::simulation {

inline constexpr std::string_view simulated_hall_ref = "simulated_hall";

// Belongs to no robot, and to the main engine. The profile is that of data/simulated_hall.xml.
std::unique_ptr<Component> simulated_hall(std::shared_ptr<Simulation>, ComponentProfile profile);

}  // namespace rois::simulation
