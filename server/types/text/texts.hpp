// Functions on texts: case, white space, numbers, characters and quoting.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace rois {

// Ignore the case of ASCII letters only, as decisions 25 and 26 require for names, URNs and type codes.
bool equal_ignoring_case_of_same_size(std::string_view, std::string_view);
inline bool equal_ignoring_case(std::string_view a, std::string_view b) {
    return a.size() == b.size() && equal_ignoring_case_of_same_size(a, b);
}
std::string lower_case(std::string_view);

// Removes and returns the first character of a UTF-8 text, or one byte if it is not valid UTF-8. Returns nothing if the text is
// empty.
std::optional<char32_t> take_character(std::string_view&);

// Folds the case of letters in Latin (also full-width), Greek, Cyrillic and Armenian, for comparing texts that people wrote.
char32_t folded_case(char32_t);
std::string folded_case(std::string_view);

// Returns the text without XML white space at both ends.
std::string_view trimmed(std::string_view);

// Parse the whole text as a number; return nothing if it is not one. Allow white space at the ends, as XML Schema does.
std::optional<double> to_double(std::string_view);
std::optional<std::int32_t> to_int(std::string_view);

// Parses a list of numbers separated by white space. An item that is not a number becomes NaN.
std::vector<double> to_doubles(std::string_view list);

// Quotes a text that came from a client or a file, for an error message or a log line. Cuts it to `longest` bytes, replaces
// control characters, line separators and marks of writing direction by spaces, and invalid UTF-8 by '?'.
std::string quoted(std::string_view, std::size_t longest = 80);

}  // namespace rois
