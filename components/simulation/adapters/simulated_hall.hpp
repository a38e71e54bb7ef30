// The hall itself as a component: it steers visitors, and lets time pass in a simulation with speed 0.
#pragma once

#include <memory>
#include <string_view>

#include "engine/local_component.hpp"
#include "simulation/world/simulation.hpp"

namespace rois::simulation {

inline constexpr std::string_view simulated_hall_ref = "simulated_hall";

// Belongs to the main engine, not to a robot. The profile is data/simulated_hall.xml.
std::unique_ptr<LocalComponent> simulated_hall(std::shared_ptr<Simulation>, ComponentProfile profile);

}  // namespace rois::simulation
