// UTF-8 and percent-encoding.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace rois {

struct Utf8Character {
    char32_t code = 0;
    std::size_t length = 0;  // bytes; 0: not valid UTF-8
};

// Returns the first character of the text. Its length is 0 if the text is empty or begins with bytes that are not valid UTF-8;
// surrogates and overlong forms are not valid.
Utf8Character first_character(std::string_view text);
bool is_utf8(std::string_view);

// Returns whether the byte is not the first one of a UTF-8 character.
constexpr bool continues_character(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U; }

// Decodes percent-encoding (RFC 3986, 2.1). Returns nothing if a percent sign is not followed by two hexadecimal digits.
std::optional<std::string> percent_decoded(std::string_view);

}  // namespace rois
