// Arguments from the command line, NAME=VALUE, with the types of the component's profile.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "types/profiles.hpp"

namespace rois::command {

// Returns the arguments of a command of this type. Known names are the command's arguments and the component's parameters. A
// repeated name adds a value to a list; NAME= is the empty list or text. Throws Trouble for a text without NAME=, an unknown name
// or a value of the wrong type.
ParameterList read_arguments(ComponentProfile const&, std::string_view command_type, std::vector<std::string> const& given);

}  // namespace rois::command
