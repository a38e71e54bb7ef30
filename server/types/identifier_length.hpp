// The maximum length of identifiers in requests: ids, refs, types, codes and names.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace rois {

inline constexpr std::size_t longest_identifier = 256;  // characters

// Returns why this text is too long for an identifier, or nothing. `what` names the identifier in the reason: "command_id".
std::optional<std::string> why_too_long(std::string_view what, std::string_view text);

}  // namespace rois
