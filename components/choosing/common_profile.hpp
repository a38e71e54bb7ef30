// The messages and parameters that all members of a logical component have (docs/choosing.md).
#pragma once

#include <string>
#include <vector>

#include "engine/component.hpp"

namespace rois::choosing {

struct Common {
    // Has the ref, the common messages and parameters, and the traits of positions and commands.
    ComponentDescription description;
    std::vector<std::string> left_out;  // what some members lack, each with the ref of one that lacks it
};

// `members` is not empty. The first one counts most: its profile gives the type and the texts.
// Returns whether `large` has all messages and parameters of `small`.
bool is_within(ComponentProfile const& small, ComponentProfile const& large);

Common common(std::string const& ref, std::vector<ComponentDescription const*> const& members);

}  // namespace rois::choosing
