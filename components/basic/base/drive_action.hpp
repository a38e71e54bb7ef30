// Base of the actions that drive: navigation, follow and move share the robot's mobile base, one at a time.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "basic/base/robot_component.hpp"

namespace rois::basic {

class DriveAction : public Action {
public:
    // `owner` names the component to the mobile base. It must be a literal.
    DriveAction(Context, std::string_view owner);

    // `battery`, if the body knows its charge.
    ParameterList readable_parameters() const override;

protected:
    MobileBase& base() const { return body().base(); }

    // Begins a motion. If the base rejects it, ends the action and returns false. `names` are those of a GoTo's targets, for the
    // reason.
    bool drive(Motion, std::span<std::string const> names = {});
    // The progress of the motion; `ended` if there is none.
    Progress progress() const;
    // Returns for how long an obstacle or the brakes have blocked the robot without interruption. Call this once in each step.
    WorldTime blocked(MotionState);
    // Describes the blockage, for messages.
    std::string blocking_reason() const;
    // Stops the motion and ends the action.
    void give_up(CompletedStatus, std::string reason);

    // WARNING while the robot is obstructed, or a motion waits for the release of the brakes.
    ComponentStatus running_status() const override;
    bool has_stopped() const final;
    void stop() override;
    void hold() override;
    void go_on() override;

private:
    std::string_view owner_;
    std::optional<MotionId> motion_;
    WorldTime blocked_{};
};

}  // namespace rois::basic
