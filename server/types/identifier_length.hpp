// How long identifiers may be: ids, refs, types, codes and names that a request says.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace rois {

inline constexpr std::size_t longest_identifier = 256;  // characters

// Why this text is too long for an identifier, or nothing. `what` it identifies, for the reason: "command_id".
std::optional<std::string> why_too_long(std::string_view what, std::string_view text);

}  // namespace rois
