#include "xml/codec/characters.hpp"

#include <array>
#include <cstdint>
#include <cstring>

#include "types/text/text_encoding.hpp"

namespace rois::xml {

namespace {

constexpr std::string_view not_utf8 = "the document is not UTF-8";
constexpr std::string_view not_a_character = "a character that XML does not allow";

constexpr std::size_t block = 32;

// Returns whether all bytes of a block are printable ASCII or DEL. Without branches, so that the compiler can use SIMD.
bool all_printed(char const* bytes) {
    constexpr std::uint64_t spaces = 0x2020202020202020, high_bits = 0x8080808080808080;
    std::array<std::uint64_t, block / sizeof spaces> words{}, other{};
    std::memcpy(words.data(), bytes, block);
    for (std::size_t i = 0; i < words.size(); ++i)
        other[i] = words[i] | (words[i] - spaces);  // a byte below the space borrows the high bit
    return ((other[0] | other[1] | other[2] | other[3]) & high_bits) == 0;
}

// Returns whether all bytes of a block are ASCII characters that XML allows. Branch-free, so that the compiler can use SIMD.
bool all_plain(char const* bytes) {
    if (all_printed(bytes)) return true;
    unsigned char bad = 0;
    for (std::size_t i = 0; i < block; ++i) {
        auto const byte = static_cast<unsigned char>(bytes[i]);
        bool const white = byte == '\t' || byte == '\n' || byte == '\r';
        bad |= static_cast<unsigned char>((byte < 0x20 && !white) || byte >= 0x80);
    }
    return bad == 0;
}

}  // namespace

bool is_character(char32_t code) {
    if (code < 0x20) return code == '\t' || code == '\n' || code == '\r';
    bool const surrogate = code >= 0xD800 && code <= 0xDFFF;
    return !surrogate && code != 0xFFFE && code != 0xFFFF && code <= 0x10FFFF;
}

std::optional<BadCharacter> first_bad_character(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        // The last block may overlap bytes that were already checked.
        bool const last = i + block > text.size() && text.size() >= block;
        if (last && all_plain(text.data() + text.size() - block)) return std::nullopt;
        if (i + block <= text.size() && all_plain(text.data() + i)) {
            i += block;
            continue;
        }
        for (auto const end = i + block; i < end && i < text.size();) {
            auto const [code, length] = first_character(text.substr(i, 4));
            if (length == 0) return BadCharacter{i, 1, not_utf8};
            if (!is_character(code)) return BadCharacter{i, length, not_a_character};
            i += length;
        }
    }
    return std::nullopt;
}

}  // namespace rois::xml
