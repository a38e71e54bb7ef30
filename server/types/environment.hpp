// The variables of the environment that the project's programs read: ROIS_...
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace rois {

// Returns the names of the non-empty ROIS_ variables in `environment` (such as `environ`) that no program of the project reads,
// in order: misspelt ones, which have no effect. `is_key` knows those that stand for configuration keys of the gateway.
std::vector<std::string> unknown_variables(char const* const* environment, std::function<bool(std::string_view)> const& is_key);

}  // namespace rois
