// UTF-8 and percent-encoding.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace rois {

// Decodes the first character of a UTF-8 text. Returns its length in bytes, or 0 if it is missing or invalid (RFC 3629:
// surrogates and overlong forms are invalid).
std::size_t decode_utf8(std::string_view, char32_t& character);
bool is_utf8(std::string_view);

// Decodes percent-encoding (RFC 3986, 2.1). Returns nothing if a percent sign is not followed by two hexadecimal digits.
std::optional<std::string> percent_decoded(std::string_view);

}  // namespace rois
