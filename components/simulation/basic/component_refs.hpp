// Names of the simulation's components (decision 25).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "simulation/plan/floor_plan.hpp"
#include "types/profiles.hpp"

namespace rois::simulation {

// Returns the ref of a component: "navigation" for the first robot (`engine` is empty), "robot2.navigation" for further robots,
// whose sub engine has the robot's name.
std::string component_ref(std::string_view component, std::string_view engine);

// Whether the text is an XML name without dots and colons.
bool is_name(std::string_view);

// Returns the refs of all basic components of all robots, the streaming components included, and of the user-defined components
// with these names.
std::vector<std::string> component_refs(FloorPlan const&, std::vector<std::string> const& names = {});

// Whether this is the name of a basic component, the streaming ones included.
bool is_basic(std::string_view name);

// Returns the name of a component with this profile: the profile's gml:name if is_name() accepts it, else the last part of its
// URN in snake case ("PersonMonitor": "person_monitor").
std::string component_name(ComponentProfile const&);

}  // namespace rois::simulation
