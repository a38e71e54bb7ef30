#include "simulation/world/simulation.hpp"

#include <algorithm>
#include <utility>

namespace rois::simulation {

Simulation::Simulation(FloorPlan plan, Scenario scenario, std::uint64_t seed, double speed)
    : faults_(scenario.faults), hall_(std::move(plan), std::move(scenario), seed) {
    if (speed != 0) time_.emplace(speed, Hall::step_length);
}

void Simulation::advance(Instant now) {
    std::int64_t const steps = time_ ? time_->steps_due(now.steady) : 0;
    if (!std::exchange(begun_, true)) return step(now);
    for (std::int64_t k = 1; k <= steps; ++k) step_of_world(time_->due(k, steps, now));
    if (goes_on()) step_of_world(now);
    notify_time_passed(now);
}

WorldTime Simulation::let_pass(WorldTime time) { return pass_until_ = std::max(pass_until_, hall_.now()) + time; }

void Simulation::stand_still() { pass_until_ = hall_.now(); }

void Simulation::step(Instant when) {
    step_of_world(when);
    notify_time_passed(when);
}

void Simulation::step_of_world(Instant when) {
    hall_.step();
    for (Observer* observer : observers_) observer->observe(when);
}

void Simulation::notify_time_passed(Instant now) {
    for (Observer* observer : observers_) observer->time_passed(now);
}

void Simulation::join(Observer& observer) { observers_.push_back(&observer); }

void Simulation::part(Observer& observer) { std::erase(observers_, &observer); }

}  // namespace rois::simulation
