#include "simulation/world/simulated_time.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace rois::simulation {

SimulatedTime::SimulatedTime(double speed, WorldTime step)
    : speed_(speed), step_(std::chrono::duration<double, std::nano>(step).count()) {
    if (!std::isfinite(speed) || speed <= 0) throw std::invalid_argument("the simulation's speed must be above 0");
}

std::int64_t SimulatedTime::steps_due(Steady now) {
    std::chrono::nanoseconds gap = last_ ? now - *last_ : std::chrono::nanoseconds{0};
    if (gap < std::chrono::nanoseconds{0}) gap = std::chrono::nanoseconds{0};
    last_ = std::max(now, last_.value_or(now));
    owed_ += std::chrono::duration<double, std::nano>(std::min<std::chrono::nanoseconds>(gap, longest_gap)).count() * speed_;
    double const whole = std::floor(owed_ / step_);
    if (whole > static_cast<double>(most_steps)) {
        owed_ = 0;
        return most_steps;
    }
    owed_ -= whole * step_;
    return static_cast<std::int64_t>(whole);
}

Instant SimulatedTime::due(std::int64_t k, std::int64_t steps, Instant now) const {
    double const world_after = owed_ + static_cast<double>(steps - k) * step_;  // world time between that step and now
    return now + std::chrono::nanoseconds{-static_cast<std::int64_t>(world_after / speed_)};
}

}  // namespace rois::simulation
