// The configuration file: JSON with // comments.
#pragma once

#include <string>

#include "main/settings.hpp"

namespace rois {

// Sets the keys of the file. Throws BadSettings with the file, the line and the key.
void read_configuration_file(std::string const& file, GatewaySettings&);

// Returns a configuration file that sets every key to its value in `settings`, with comments.
std::string commented_configuration(GatewaySettings const&);

// Returns the content of a file. Throws BadSettings with its name.
std::string text_of_file(std::string const& file);

}  // namespace rois
