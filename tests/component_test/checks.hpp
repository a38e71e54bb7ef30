// The checks for component programs (docs/component-programs.md), in the order in which they run.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "component_test/program.hpp"

namespace rois::component_test {

struct Check {
    std::string name;  // what the program must do, with underscores
    std::function<void(Program&)> run;
};

struct Group {
    std::string title;
    std::vector<Check> checks;
};

Group joining_checks();
Group checks_of(ComponentEntry const&);  // for one component, with the next two
Check activity_check_of(ComponentEntry const&);
std::vector<Check> halting_checks_of(ComponentEntry const&);
Group link_checks();
std::vector<Check> lost_link_checks();  // part of link_checks
Group ending_checks();

}  // namespace rois::component_test
