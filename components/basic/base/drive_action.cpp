#include "basic/base/drive_action.hpp"

#include <variant>

#include "types/text/texts.hpp"

namespace rois::basic {

bool DriveAction::drive(Motion motion, std::span<std::string const> names) {
    blocked_ = {};
    motion_.reset();
    auto begun = base().begin(owner_, std::move(motion));
    if (auto* const rejection = std::get_if<Rejection>(&begun)) {
        auto const& target = rejection->target;
        end(rejection->status, target ? quoted(names[*target]) + " " + rejection->reason : std::move(rejection->reason));
        return false;
    }
    motion_ = std::get<MotionId>(begun);
    return true;
}

Progress DriveAction::progress() const { return motion_ ? base().progress(*motion_) : Progress{}; }

WorldTime DriveAction::blocked(MotionState state) {
    bool const is_blocked = state == MotionState::obstructed || base().status().brakes;
    blocked_ = is_blocked ? blocked_ + step_length() : WorldTime{};
    return blocked_;
}

std::string DriveAction::blocking_reason() const {
    return base().status().brakes ? "the brakes of the robot are on" : "a person or robot is in the way";
}

void DriveAction::give_up(CompletedStatus status, std::string reason) {
    stop();
    end(status, std::move(reason));
}

ComponentStatus DriveAction::running_status() const {
    auto const state = progress().state;
    bool const is_braked = !over(state) && base().status().brakes;
    return state == MotionState::obstructed || is_braked ? ComponentStatus::warning : ComponentStatus::ready;
}

bool DriveAction::has_stopped() const { return !base().status().stopping; }

void DriveAction::stop() {
    if (auto const motion = std::exchange(motion_, {})) base().stop(*motion);
}

void DriveAction::hold() {
    if (motion_) base().hold(*motion_);
}

void DriveAction::go_on() {
    if (motion_) base().go_on(*motion_);
}

}  // namespace rois::basic
