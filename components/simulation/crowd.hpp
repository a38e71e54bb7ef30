// Who comes into the hall when: the roles of the scenario, round after round, and visitors drawn from the seed.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "simulation/floor_plan.hpp"
#include "simulation/random.hpp"
#include "simulation/scenario.hpp"

namespace rois::simulation {

class Crowd {
public:
    Crowd(Scenario, FloorPlan const&, std::uint64_t seed);

    // The one who comes in now, if any. `inside` counts the people in the hall and `is_inside` knows their roles: nobody plays a
    // role twice at a time. Asked only while the entrance is free.
    std::optional<Role> next(WorldTime now, std::size_t inside, std::function<bool(std::string_view)> const& is_inside);

private:
    Role stranger();

    Scenario scenario_;
    std::vector<std::string> robots_;
    Random random_;
    std::vector<std::optional<Seconds>> next_entry_;  // of each role; nothing when it does not come again
    Seconds next_arrival_ = 0;
    std::uint64_t strangers_ = 0;
};

}  // namespace rois::simulation
