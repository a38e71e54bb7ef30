// Names of components (decision 25).
#pragma once

#include <string>
#include <string_view>

#include "types/profiles.hpp"

namespace rois::basic {

// Returns the ref of a component: "navigation" for the first robot (`engine` is empty), "robot2.navigation" for further robots,
// whose sub engine has the robot's name.
std::string component_ref(std::string_view component, std::string_view engine);

// Whether the text is an XML name without dots and colons.
bool is_name(std::string_view);

// Returns the name of a component with this profile: the profile's gml:name if is_name() accepts it, else the last part of its
// URN in snake case ("PersonMonitor": "person_monitor").
std::string component_name(ComponentProfile const&);

}  // namespace rois::basic
