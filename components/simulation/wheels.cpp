#include "simulation/wheels.hpp"

#include <utility>

namespace rois::simulation {

void WheelAction::drive(Motion motion) {
    blocked_ = {};
    motion_ = hall().drive(robot()).begin(owner_, std::move(motion));
    if (!motion_) end(CompletedStatus::out_of_resources, busy_wheels());
}

Progress WheelAction::progress() const { return motion_ ? hall().drive(robot()).progress(*motion_) : Progress{}; }

WorldTime WheelAction::blocked(MotionState state) {
    bool const is_blocked = state == MotionState::obstructed || hall().drive(robot()).brakes_are_on();
    blocked_ = is_blocked ? blocked_ + Hall::step_length : WorldTime{};
    return blocked_;
}

std::string WheelAction::what_blocks() const {
    return hall().drive(robot()).brakes_are_on() ? "the brakes of the robot are on" : "somebody is in the way and does not move";
}

std::string WheelAction::busy_wheels() const { return "the wheels are busy with " + std::string{hall().drive(robot()).owner()}; }

bool WheelAction::wheels_are_anothers() const {
    auto const owner = hall().drive(robot()).owner();
    return !owner.empty() && owner != owner_;
}

ComponentStatus WheelAction::condition() const {
    auto const state = progress().state;
    bool const is_braked = !over(state) && hall().drive(robot()).brakes_are_on();
    return state == MotionState::obstructed || is_braked ? ComponentStatus::warning : ComponentStatus::ready;
}

// In a world that stands still, no wheel turns.
bool WheelAction::has_ceased() const { return !hall().drive(robot()).is_stopping() || !world_goes_on(); }

void WheelAction::cease() {
    if (auto const motion = std::exchange(motion_, {})) hall().drive(robot()).stop(*motion);
}

void WheelAction::hold() {
    if (motion_) hall().drive(robot()).hold(*motion_);
}

void WheelAction::go_on() {
    if (motion_) hall().drive(robot()).go_on(*motion_);
}

}  // namespace rois::simulation
