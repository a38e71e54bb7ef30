// Reading source files line by line.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace rois::house {

// Calls `see(line, number)` for each line, counted from 1.
void for_each_line(std::string_view text, std::function<void(std::string const&, std::size_t)> const& see);

std::string at(std::string_view file, std::size_t line);  // "file:line: "

bool is_cpp(std::string_view file);  // .cpp or .hpp

// Replaces comments and the contents of literals by spaces; line numbers stay the same.
std::string code_alone(std::string_view text);

}  // namespace rois::house
