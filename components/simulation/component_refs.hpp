// How the simulation's components are named (decision 25).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "simulation/floor_plan.hpp"

namespace rois::simulation {

// Those of the first robot have the names of table 31, "navigation"; those of a further robot carry its name, which is that of
// its sub engine: "robot2.navigation". `engine` is empty for the first.
std::string component_ref(std::string_view component, std::string_view engine);

// Of every component of every robot.
std::vector<std::string> component_refs(FloorPlan const&);

}  // namespace rois::simulation
