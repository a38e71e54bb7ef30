// The section `choosing` of the file of sub engines (docs/choosing.md).
#pragma once

#include <string>
#include <vector>

#include "choosing/settings.hpp"
#include "remote/sub_engine.hpp"

namespace rois {

// Returns settings without logical components if the file has no such section. Throws BadSettings with the file, the line and the
// key.
choosing::Settings read_choosing(std::string const& file, std::vector<remote::SubEngine> const&);

}  // namespace rois
