#include "types/texts.hpp"

#include <algorithm>
#include <cmath>

namespace rois {

namespace {

constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// XML Schema allows a plus sign, from_chars does not.
std::string_view without_plus(std::string_view text) {
    if (text.size() > 1 && text.front() == '+' && text[1] != '-') text.remove_prefix(1);
    return text;
}

// The largest length at or below `longest` that does not cut a UTF-8 character.
std::size_t whole_characters(std::string_view text, std::size_t longest) {
    if (text.size() <= longest) return text.size();
    auto const continues = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U; };
    while (longest > 0 && continues(longest)) --longest;
    return longest;
}

}  // namespace

bool equal_ignoring_case(std::string_view a, std::string_view b) { return std::ranges::equal(a, b, {}, lower, lower); }

std::string lower_case(std::string_view text) {
    std::string lowered{text};
    std::ranges::transform(lowered, lowered.begin(), lower);
    return lowered;
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blanks = " \t\r\n";
    auto const first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::optional<double> to_double(std::string_view text) {
    text = trimmed(text);
    if (text == "INF" || text == "+INF") return HUGE_VAL;
    if (text == "-INF") return -HUGE_VAL;
    if (text == "NaN") return std::nan("");
    text = without_plus(text);
    if (text.empty() || text.find_first_not_of("+-.0123456789eE") != std::string_view::npos) return {};
    double number = 0;
    auto const [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc{} || end != text.data() + text.size()) return {};
    return number;
}

std::optional<std::int32_t> to_int(std::string_view text) {
    text = without_plus(trimmed(text));
    std::int32_t number = 0;
    auto const [end, problem] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (problem != std::errc{} || end != text.data() + text.size()) return {};
    return number;
}

std::string quoted(std::string_view text, std::size_t longest) {
    auto const length = whole_characters(text, longest);
    std::string shown{text.substr(0, length)};
    std::ranges::replace_if(
        shown, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }, ' ');
    if (length < text.size()) shown += "...";
    return "'" + shown + "'";
}

}  // namespace rois
