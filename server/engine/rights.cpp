#include "engine/rights.hpp"

#include <fnmatch.h>

#include <algorithm>

namespace rois {

bool Rights::sees_everything() const { return std::ranges::find(sees_, "*") != sees_.end(); }

bool Rights::sees_all_of(std::string const& beginning) const {
    return std::ranges::any_of(sees_, [&](std::string const& pattern) {
        if (!pattern.ends_with('*')) return false;
        auto const before_star = pattern.substr(0, pattern.size() - 1);
        for (std::size_t size = 0; size <= beginning.size(); ++size)
            if (::fnmatch(before_star.c_str(), beginning.substr(0, size).c_str(), FNM_NOESCAPE) == 0) return true;
        return false;
    });
}

bool Rights::matches(std::vector<std::string> const& patterns, std::string const& ref) {
    return std::ranges::any_of(patterns, [&](std::string const& pattern) {
        return pattern == "*" || ::fnmatch(pattern.c_str(), ref.c_str(), FNM_NOESCAPE) == 0;
    });
}

}  // namespace rois
