// Small questions about texts that the specification asks everywhere.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rois {

// ASCII only: names, URNs and type codes are compared without regard to case (decision 25, 26).
bool equal_ignoring_case(std::string_view, std::string_view);
std::string lower_case(std::string_view);

// Takes the first character from a text in UTF-8; a byte that belongs to none is one by itself. Nothing when the text is empty.
std::optional<char32_t> take_character(std::string_view&);

// Letters without the difference of case, for texts that people write: Latin (also full-width), Greek, Cyrillic and Armenian.
char32_t folded_case(char32_t);
std::string folded_case(std::string_view);

// Without the white space of XML at both ends.
std::string_view trimmed(std::string_view);

// The whole text as a number, or nothing. White space at the ends is allowed, as in XML Schema.
std::optional<double> to_double(std::string_view);
std::optional<std::int32_t> to_int(std::string_view);

// A text from outside, fit for a reason or a line of the log: cut to a bearable length, with spaces for control characters, for
// separators of lines and for marks of writing direction, and valid UTF-8.
std::string quoted(std::string_view, std::size_t longest = 80);

}  // namespace rois
