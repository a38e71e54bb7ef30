// Makes the world's time out of real time.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "simulation/pose.hpp"
#include "types/instant.hpp"

namespace rois::simulation {

// Counts how many steps of the world are due. No rounding is lost between calls.
class SimulatedTime {
public:
    // Of one call, so that a machine that slept does not have to catch up: in real time, and in steps for great speeds.
    static constexpr std::chrono::seconds longest_gap{3};
    static constexpr std::int64_t most_steps = 3'000;

    // `speed` > 0; `step` is one step of the world. Throws std::invalid_argument for a speed that is not above 0 or not finite.
    SimulatedTime(double speed, WorldTime step);

    // Steps that have become due since the last call; the first call starts the clock. Time going back counts as none.
    std::int64_t steps_due(Steady now);

    // When the `k`-th (from 1) of the steps of the last call was due, at the latest the last call's `now`.
    Instant due(std::int64_t k, std::int64_t steps, Instant now) const;

private:
    double speed_;
    double step_;      // of the world, in nanoseconds
    double owed_ = 0;  // of the world, in nanoseconds: less than a step
    std::optional<Steady> last_;
};

}  // namespace rois::simulation
