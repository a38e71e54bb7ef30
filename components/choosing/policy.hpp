// Which member a logical component prefers (docs/choosing.md).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "choosing/roster.hpp"

namespace rois::choosing {

// The purpose for which a member is chosen.
struct Occasion {
    std::uint64_t session = 0;                    // of the application
    std::vector<std::string> order;               // refs, in the sort order of the application's condition; empty: it has none
    std::optional<std::array<double, 2>> target;  // where it will act, in the main engine's frame, in mm
    std::string current;                          // ref of the member that was chosen last; empty: none
    Steady now{};
};

// Another member is chosen only if it is nearer to the target than the current one by more than this.
constexpr double hysteresis = 1'000;  // mm

// Returns the members that can act, the best one first.
std::vector<Member*> in_order(std::vector<Member*> members, Occasion const&, Roster const&);

}  // namespace rois::choosing
