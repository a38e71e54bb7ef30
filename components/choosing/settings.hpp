// Which components an engine shows as one: the section `choosing` of the engines file (docs/choosing.md).
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace rois::choosing {

// The corners of a polygon in the main engine's frame, in mm.
using Area = std::vector<std::array<double, 2>>;

// The members of the logical component `navigation` are the components `<engine>.navigation` of these engines.
struct Settings {
    std::vector<std::string> logical;   // the plain names of those that act
    std::vector<std::string> sensing;   // the plain names of those that sense
    std::vector<std::string> engines;   // the preferred ones first
    std::map<std::string, Area> areas;  // by engine: where its components may act; without an area, everywhere
    int low_battery = 20;               // in percent: below it, a battery is low

    bool operator==(Settings const&) const = default;
};

}  // namespace rois::choosing
