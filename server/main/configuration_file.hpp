// The configuration file: JSON with // comments.
#pragma once

#include <string>

#include "main/settings.hpp"

namespace rois {

// Sets what the file sets. Throws BadSettings naming the file, the line and the key.
void read_configuration_file(std::string const& file, Settings&);

// A file that sets every key to these settings and says what it is.
std::string commented_configuration(Settings const&);

// The bytes of a file. Throws BadSettings naming it.
std::string text_of_file(std::string const& file);

}  // namespace rois
