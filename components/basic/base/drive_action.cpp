#include "basic/base/drive_action.hpp"

#include <cmath>
#include <cstdint>
#include <memory>
#include <variant>

#include "types/text/texts.hpp"

namespace rois::basic {
namespace {

// Adds the read-only parameter `battery` to the profile, if the body knows its charge.
Context with_battery(Context context) {
    if (!context.body->battery()) return context;
    auto profile = std::make_shared<ComponentProfile>(*context.description.profile);
    for (auto& message : profile->messages)
        if (message.kind == MessageKind::query && message.name == "get_parameter")
            message.results.push_back({.name = "battery",
                                       .data_type_ref = {.code = "int", .authority = {}, .codebook_ref = {}, .version = {}},
                                       .default_value = {},
                                       .description = "Charge of the battery, in percent."});
    context.description.profile = std::move(profile);
    return context;
}

}  // namespace

DriveAction::DriveAction(Context context, std::string_view owner)
    : Action{with_battery(with_motion(std::move(context)))}, owner_{owner} {}

ParameterList DriveAction::readable_parameters() const {
    auto const charge = body().battery();
    if (!charge) return {};
    return {integer("battery", static_cast<std::int64_t>(std::floor(*charge)))};
}

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
