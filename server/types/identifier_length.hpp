// The maximum length of identifiers in requests: ids, refs, types, codes and names.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "types/messages.hpp"

namespace rois {

inline constexpr std::size_t longest_identifier = 256;  // characters

// Returns why this text is too long for an identifier, or nothing. `what` names the identifier in the reason: "command_id".
std::optional<std::string> why_too_long(std::string_view what, std::string_view text);

// Returns which identifier of the operation is too long, or nothing. Does not check session ids: a longer one is unknown. Does
// not check identifiers in conditions (engine/conditions/filter_values.cpp) and in values (data_type.cpp).
std::optional<std::string> why_too_long(Operation const&);

}  // namespace rois
