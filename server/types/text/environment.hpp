// Finds misspelt environment variables (ROIS_...) of the project's programs.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace rois {

// Returns the sorted names of the non-empty ROIS_ variables in `environment` (such as `environ`) that no program of the project
// reads. `is_key` returns whether a name stands for a configuration key of the gateway.
std::vector<std::string> unknown_variables(char const* const* environment, std::function<bool(std::string_view)> const& is_key);

}  // namespace rois
