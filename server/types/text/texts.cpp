#include "types/text/texts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "types/text/text_encoding.hpp"
#include "types/text/to_number.hpp"

namespace rois {

namespace {

constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

// XML Schema allows a plus sign, from_chars does not.
std::string_view without_plus(std::string_view text) {
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    return text;
}

constexpr bool between(char32_t c, char32_t first, char32_t last) { return c >= first && c <= last; }

// Control characters, separators of lines and paragraphs, and marks of writing direction.
constexpr bool disturbs_a_line(char32_t c) {
    return c < 0x20 || between(c, 0x7F, 0x9F) || between(c, 0x200E, 0x200F) || between(c, 0x2028, 0x202E) ||
           between(c, 0x2066, 0x2069);
}

// In these blocks capital and small letters alternate; the capitals have even or odd codes.
constexpr bool alternates_from_even(char32_t c) {
    return between(c, 0x100, 0x137) || between(c, 0x14A, 0x177) || between(c, 0x460, 0x481) || between(c, 0x48A, 0x4BF) ||
           between(c, 0x4D0, 0x52F) || between(c, 0x1E00, 0x1E95) || between(c, 0x1EA0, 0x1EFF);
}
constexpr bool alternates_from_odd(char32_t c) { return between(c, 0x139, 0x148) || between(c, 0x179, 0x17E); }

void append(std::string& text, char32_t c) {
    if (c < 0x80) {
        text += static_cast<char>(c);
        return;
    }
    int const more = c < 0x800 ? 1 : c < 0x10000 ? 2 : 3;
    constexpr std::array<unsigned, 4> marks{0, 0xC0, 0xE0, 0xF0};
    text += static_cast<char>(marks.at(static_cast<std::size_t>(more)) | c >> (6 * more));
    for (int i = more - 1; i >= 0; --i) text += static_cast<char>(0x80U | (c >> (6 * i) & 0x3FU));
}

// Returns the largest length up to `longest` that does not cut a UTF-8 character.
std::size_t whole_characters(std::string_view text, std::size_t longest) {
    if (text.size() <= longest) return text.size();
    while (longest > 0 && continues_character(text[longest])) --longest;
    return longest;
}

}  // namespace

// Compares the bytes first, because most equal texts are identical.
bool equal_ignoring_case_of_same_size(std::string_view a, std::string_view b) {
    return a == b || std::ranges::equal(a, b, {}, lower, lower);
}

std::string lower_case(std::string_view text) {
    std::string lowered{text};
    std::ranges::transform(lowered, lowered.begin(), lower);
    return lowered;
}

std::optional<char32_t> take_character(std::string_view& text) {
    if (text.empty()) return {};
    auto const character = first_character(text);
    char32_t const code = character.length == 0 ? static_cast<unsigned char>(text.front()) : character.code;
    text.remove_prefix(std::max<std::size_t>(character.length, 1));
    return code;
}

char32_t folded_case(char32_t c) {
    if (between(c, 'A', 'Z')) return c + 0x20;
    if (c < 0x80) return c;
    if ((between(c, 0xC0, 0xDE) && c != 0xD7) || between(c, 0x391, 0x3AB) || between(c, 0x410, 0x42F) ||
        between(c, 0xFF21, 0xFF3A))
        return c == 0x3A2 ? c : c + 0x20;
    if (c == 0x3C2) return 0x3C3;  // the final sigma
    if (c == 0x386) return 0x3AC;  // Greek letters with an accent
    if (between(c, 0x388, 0x38A)) return c + 0x25;
    if (c == 0x38C || c == 0x38E || c == 0x38F) return c + (c == 0x38C ? 0x40 : 0x3F);
    if (c == 0x1E9E) return 0xDF;  // the sharp s
    if (between(c, 0x400, 0x40F)) return c + 0x50;
    if (between(c, 0x531, 0x556)) return c + 0x30;
    if (alternates_from_even(c) && c != 0x130 && c != 0x131) return c | 1U;
    if (alternates_from_odd(c)) return c % 2 == 1 ? c + 1 : c;
    return c == 0x178 ? 0xFF : c;
}

std::string folded_case(std::string_view text) {
    std::string folded;
    folded.reserve(text.size());
    while (!text.empty()) {
        auto const byte = text.front();
        auto const before = text.size();
        auto const character = *take_character(text);
        bool const stray = before - text.size() == 1 && character >= 0x80;
        if (stray) {
            folded += byte;
        } else {
            append(folded, folded_case(character));
        }
    }
    return folded;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::optional<double> to_double(std::string_view text) {
    text = trimmed(text);
    if (text == "INF" || text == "+INF") return HUGE_VAL;
    if (text == "-INF") return -HUGE_VAL;
    if (text == "NaN") return std::nan("");
    text = without_plus(text);
    if (text.empty() || text.find_first_not_of("+-.0123456789eE") != std::string_view::npos) return {};
    return to_number<double>(text);
}

std::optional<std::int32_t> to_int(std::string_view text) { return to_number<std::int32_t>(without_plus(trimmed(text))); }

std::vector<double> to_doubles(std::string_view list) {
    std::vector<double> numbers;
    for (list = trimmed(list); !list.empty();) {
        auto const item = list.substr(0, list.find_first_of(" \t\r\n"));
        numbers.push_back(to_double(item).value_or(std::nan("")));
        list = trimmed(list.substr(item.size()));
    }
    return numbers;
}

std::string quoted(std::string_view text, std::size_t longest) {
    auto rest = text.substr(0, whole_characters(text, longest));
    bool const cut = rest.size() < text.size();
    std::string shown = "'";
    while (!rest.empty()) {
        auto const start = rest;
        auto const character = *take_character(rest);
        auto const bytes = start.substr(0, start.size() - rest.size());
        bool const stray = bytes.size() == 1 && character >= 0x80;
        shown += stray ? "?" : disturbs_a_line(character) ? " " : bytes;
    }
    return shown + (cut ? "...'" : "'");
}

}  // namespace rois
