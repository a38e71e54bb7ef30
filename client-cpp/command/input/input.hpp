// Reads files and standard input.
#pragma once

#include <fstream>
#include <string>

namespace rois::command {

// Both throw Trouble if the file cannot be read.
std::ifstream open_file(std::string const& file);

// Returns the text of a file; `-` is standard input.
std::string text_of_file(std::string const& file);

}  // namespace rois::command
