#include "simulation/basic/drive_action.hpp"

#include <utility>

namespace rois::simulation {

void DriveAction::drive(Motion motion) {
    blocked_ = {};
    motion_ = hall().drive(robot()).begin(owner_, std::move(motion));
    if (!motion_) end(CompletedStatus::out_of_resources, wheels_busy_reason());
}

Progress DriveAction::progress() const { return motion_ ? hall().drive(robot()).progress(*motion_) : Progress{}; }

WorldTime DriveAction::blocked(MotionState state) {
    bool const is_blocked = state == MotionState::obstructed || hall().drive(robot()).brakes_are_on();
    blocked_ = is_blocked ? blocked_ + Hall::step_length : WorldTime{};
    return blocked_;
}

std::string DriveAction::blocking_reason() const {
    return hall().drive(robot()).brakes_are_on() ? "the brakes of the robot are on" : "a person or robot is in the way";
}

std::string DriveAction::wheels_busy_reason() const {
    return "the wheels are busy with " + std::string{hall().drive(robot()).owner()};
}

bool DriveAction::wheels_are_busy() const {
    auto const owner = hall().drive(robot()).owner();
    return !owner.empty() && owner != owner_;
}

ComponentStatus DriveAction::running_status() const {
    auto const state = progress().state;
    bool const is_braked = !over(state) && hall().drive(robot()).brakes_are_on();
    return state == MotionState::obstructed || is_braked ? ComponentStatus::warning : ComponentStatus::ready;
}

// While no world time passes, the robot does not move.
bool DriveAction::has_stopped() const { return !hall().drive(robot()).is_stopping() || !world_goes_on(); }

void DriveAction::stop() {
    if (auto const motion = std::exchange(motion_, {})) hall().drive(robot()).stop(*motion);
}

void DriveAction::hold() {
    if (motion_) hall().drive(robot()).hold(*motion_);
}

void DriveAction::go_on() {
    if (motion_) hall().drive(robot()).go_on(*motion_);
}

}  // namespace rois::simulation
