// Converts real time to steps of world time.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "simulation/world/units.hpp"
#include "types/instant.hpp"

namespace rois::simulation {

// Counts the steps that are due. Carries the remainder from call to call.
class SimulatedTime {
public:
    // Limits of one call, in real time and in steps, so that a machine that slept does not catch up.
    static constexpr std::chrono::seconds longest_gap{3};
    static constexpr std::int64_t most_steps = 3'000;

    // `speed`: simulated seconds per real second. Throws std::invalid_argument unless it is finite and above 0.
    SimulatedTime(double speed, WorldTime step);

    // Returns the steps that have become due since the last call. The first call starts the clock. A time before the last call
    // counts as 0 steps.
    std::int64_t steps_due(Steady now);

    // Returns when step `k` (from 1) of the `steps` of the last call was due, at the latest `now` of that call.
    Instant due(std::int64_t k, std::int64_t steps, Instant now) const;

private:
    double speed_;
    double step_;      // nanoseconds of world time
    double owed_ = 0;  // nanoseconds of world time, less than a step
    std::optional<Steady> last_;
};

}  // namespace rois::simulation
