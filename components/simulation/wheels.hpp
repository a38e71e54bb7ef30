// Actions that drive: navigation, follow and move share the wheels of their robot, one at a time.
#pragma once

#include <string_view>

#include "simulation/robot_component.hpp"

namespace rois::simulation {

class WheelAction : public Action {
public:
    // `owner` names the component to the drive; a literal.
    WheelAction(Fitting fitting, std::string_view owner) : Action{std::move(fitting)}, owner_{owner} {}

protected:
    // Begins a motion; when the wheels are another's, ends the action with OUT_OF_RESOURCES.
    void drive(Motion);
    // How the motion goes; `ended` when there is none.
    Progress progress() const;
    // For how long the way has been blocked by somebody without a break; asked once a step.
    WorldTime blocked(MotionState);

    bool wheels_are_anothers() const;
    // Why they cannot be had.
    std::string busy_wheels() const;

    // WARNING while somebody is in the way.
    ComponentStatus condition() const override;
    void cease() override;
    void hold() override;
    void go_on() override;

private:
    std::string_view owner_;
    std::optional<MotionId> motion_;
    WorldTime blocked_{};
};

}  // namespace rois::simulation
