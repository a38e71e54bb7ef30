#include "types/text/text_encoding.hpp"

#include <charconv>
#include <cstdint>
#include <cstring>

namespace rois {

Utf8Character first_character(std::string_view text) {
    if (text.empty()) return {};
    auto const byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    auto const first = byte(0);
    if (first < 0x80) return {first, 1};
    std::size_t const length = first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
    if (length == 0 || length > text.size()) return {};
    char32_t code = first & (0x7FU >> length);
    for (std::size_t i = 1; i < length; ++i) {
        if (!continues_character(text[i])) return {};
        code = code << 6U | (byte(i) & 0x3FU);
    }
    bool const overlong = (length == 3 && code < 0x800) || (length == 4 && code < 0x10000);
    bool const surrogate = code >= 0xD800 && code <= 0xDFFF;
    if (overlong || surrogate || code > 0x10FFFF) return {};
    return {code, length};
}

bool is_utf8(std::string_view text) {
    constexpr std::uint64_t high_bits = 0x8080808080808080;  // set in bytes that are not ASCII
    for (std::size_t i = 0; i < text.size();) {
        std::uint64_t word = 0;
        if (i + sizeof word <= text.size()) {
            std::memcpy(&word, text.data() + i, sizeof word);
            if ((word & high_bits) == 0) {
                i += sizeof word;
                continue;
            }
        }
        auto const length = first_character(text.substr(i, 4)).length;
        if (length == 0) return false;
        i += length;
    }
    return true;
}

std::optional<std::string> percent_decoded(std::string_view text) {
    std::string plain;
    while (!text.empty()) {
        auto byte = static_cast<unsigned char>(text.front());
        std::size_t size = 1;
        if (byte == '%') {
            size = 3;
            auto const digits = text.substr(1, 2);
            auto const end = std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16).ptr;
            if (digits.size() < 2 || end != digits.data() + 2) return {};
        }
        plain.push_back(static_cast<char>(byte));
        text.remove_prefix(size);
    }
    return plain;
}

}  // namespace rois
