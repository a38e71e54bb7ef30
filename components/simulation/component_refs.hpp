// How the simulation's components are named (decision 25).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "simulation/floor_plan.hpp"
#include "types/profiles.hpp"

namespace rois::simulation {

// Those of the first robot have the names of table 31, "navigation"; those of a further robot carry its name, which is that of
// its sub engine: "robot2.navigation". `engine` is empty for the first.
std::string component_ref(std::string_view component, std::string_view engine);

// Whether it is a name of XML without dots and colons.
bool is_name(std::string_view);

// Of every component of every robot, also of those that are there with media only, and of those that have one of these
// names.
std::vector<std::string> component_refs(FloorPlan const&, std::vector<std::string> const& names = {});

// Whether a basic component is named so, also one that is there with media only.
bool is_basic(std::string_view name);

// How a component with this profile is named: as the profile (gml:name) when that is a name without dots, else after its URN, in
// small letters with underscores ("PersonMonitor": "person_monitor").
std::string component_name(ComponentProfile const&);

}  // namespace rois::simulation
