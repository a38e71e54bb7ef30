// What the program is given to read: files, and standard input.
#pragma once

#include <fstream>
#include <string>

namespace rois::command {

// Each throws Trouble when the file cannot be read.
std::ifstream open_file(std::string const& file);

// The text of a file; `-` is standard input.
std::string text_of_file(std::string const& file);

}  // namespace rois::command
