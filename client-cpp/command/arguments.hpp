// Arguments as people type them, `name=value`, with the types that the component's profile gives them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "types/profiles.hpp"

namespace rois::command {

// The arguments of a command of this type, which are those that its profile declares for it and the component's parameters. A
// name that comes again adds a value to a list; `name=` is the empty list, or the empty text. Throws Trouble: for what is no
// name=value, an unknown name, a value that is not of its type.
ParameterList read_arguments(ComponentProfile const&, std::string_view command_type, std::vector<std::string> const& given);

}  // namespace rois::command
