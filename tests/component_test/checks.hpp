// The rules for component programs (docs/component-programs.md), as checks that are played in this order.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "component_test/program.hpp"

namespace rois::component_test {

struct Check {
    std::string name;  // the rule in words, with underscores
    std::function<void(Program&)> play;
};

struct Group {
    std::string title;
    std::vector<Check> checks;
};

Group joining_checks();
Group checks_of(ComponentEntry const&);  // of one component
Group link_checks();
Group ending_checks();

}  // namespace rois::component_test
