// The documents that mutations begin with.
#pragma once

#include <string>
#include <vector>

namespace rois::fuzz {

// All samples of the schemas, and profiles, floor plans, scenarios; in the order of their names.
std::vector<std::string> samples();

}  // namespace rois::fuzz
