// Base of the actions that drive: navigation, follow and move share their robot's drive, one at a time.
#pragma once

#include <string_view>

#include "simulation/basic/robot_component.hpp"

namespace rois::simulation {

class DriveAction : public Action {
public:
    // `owner` names the component to the drive. It must be a literal.
    DriveAction(Context context, std::string_view owner) : Action{with_motion(std::move(context))}, owner_{owner} {}

protected:
    // Begins a motion. If another component is using the drive, ends the action with OUT_OF_RESOURCES.
    void drive(Motion);
    // The progress of the motion; `ended` if there is none.
    Progress progress() const;
    // Returns for how long an obstacle or the brakes have blocked the robot without interruption. Call this once in each step.
    WorldTime blocked(MotionState);
    // Describes the blockage, for messages.
    std::string blocking_reason() const;

    bool wheels_are_busy() const;
    // Says which component is using the drive, for messages.
    std::string wheels_busy_reason() const;

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

}  // namespace rois::simulation
