// Decodes UTF-8 (RFC 3629).
#pragma once

#include <cstddef>
#include <string_view>

namespace rois {

struct Utf8Character {
    char32_t code = 0;
    std::size_t length = 0;  // bytes; 0: not valid UTF-8
};

// Returns the first character of the text. Its length is 0 if the text is empty or begins with bytes that are not valid UTF-8;
// surrogates and overlong forms are not valid.
inline Utf8Character first_character(std::string_view text) {
    if (text.empty()) return {};
    auto const byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    auto const first = byte(0);
    if (first < 0x80) return {first, 1};
    std::size_t const length = first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
    if (length == 0 || length > text.size()) return {};
    char32_t code = first & (0x7FU >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if ((byte(i) & 0xC0U) != 0x80) return {};
        code = code << 6U | (byte(i) & 0x3FU);
    }
    bool const overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
    bool const surrogate = code >= 0xD800 && code <= 0xDFFF;
    if (overlong || surrogate || code > 0x10FFFF) return {};
    return {code, length};
}

}  // namespace rois
