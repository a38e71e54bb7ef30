// The length of identifiers in requests: the one place where it is checked, but for conditions (engine/filter_values.cpp) and
// values (types/data_type.cpp).
#pragma once

#include <optional>
#include <string>

#include "types/messages.hpp"

namespace rois {

// Why an identifier of this operation is too long (types/identifier_length.hpp), or nothing. The id of a session is not looked
// at: one that is too long is unknown.
std::optional<std::string> why_too_long(Operation const&);

}  // namespace rois
