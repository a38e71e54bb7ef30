// The file of sub engines (key `engines`; docs/engines.md): JSON with // comments.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "remote/sub_engine.hpp"

namespace rois {

// Returns whether the text is http://HOST:PORT (or https, ws, wss), with or without a port and a path.
bool is_gateway_url(std::string_view);

// Names that a sub engine must not have, each with its owner and what to do: "this engine (engine_name); choose another name".
using TakenNames = std::map<std::string, std::string>;

// Throws BadSettings with the file, the line, the sub engine and the key.
std::vector<remote::SubEngine> read_engines_file(std::string const& file, TakenNames const& = {});

}  // namespace rois
