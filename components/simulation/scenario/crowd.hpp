// Decides which visitors enter the hall, and when: the roles of the scenario, round after round, and random visitors.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "simulation/plan/floor_plan.hpp"
#include "simulation/scenario/scenario.hpp"
#include "simulation/world/random.hpp"

namespace rois::simulation {

class Crowd {
public:
    Crowd(Scenario, FloorPlan const&, std::uint64_t seed);

    // Returns the role that enters now, if any. `inside` is the number of people in the hall. A role for which `is_inside`
    // returns true does not enter. Call it only while the entrance is free.
    std::optional<Role> next(WorldTime now, std::size_t inside, std::function<bool(std::string_view)> const& is_inside);

private:
    Role stranger();

    Scenario scenario_;
    std::vector<std::string> robots_;
    Random random_;
    std::vector<std::optional<Seconds>> next_entry_;  // of each role; nothing if it does not enter again
    Seconds next_arrival_ = 0;
    std::uint64_t strangers_ = 0;
};

}  // namespace rois::simulation
