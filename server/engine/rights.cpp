#include "engine/rights.hpp"

#include <fnmatch.h>

#include <algorithm>

namespace rois {

bool Rights::matches(std::vector<std::string> const& patterns, std::string const& ref) {
    return std::ranges::any_of(patterns, [&](std::string const& pattern) {
        return pattern == "*" || ::fnmatch(pattern.c_str(), ref.c_str(), FNM_NOESCAPE) == 0;
    });
}

}  // namespace rois
