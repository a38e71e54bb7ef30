// Checks the length of identifiers in requests. Identifiers in conditions are checked in engine/conditions/filter_values.cpp,
// those in values in types/data_type.cpp.
#pragma once

#include <optional>
#include <string>

#include "types/messages.hpp"

namespace rois {

// Returns which identifier of the operation is too long (types/identifier_length.hpp), or nullopt. Does not check session ids:
// one that is too long is unknown.
std::optional<std::string> why_too_long(Operation const&);

}  // namespace rois
