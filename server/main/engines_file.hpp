// The file of sub engines (key `engines`; docs/engines.md): JSON with // comments.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "remote/sub_engine.hpp"

namespace rois {

bool is_gateway_url(std::string_view);

// Throws BadSettings with the file, the line, the sub engine and the key.
std::vector<remote::SubEngine> read_engines_file(std::string const& file);

}  // namespace rois
