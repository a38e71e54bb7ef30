// Actions that drive: navigation, follow and move share the wheels of their robot, one at a time.
#pragma once

#include <string_view>

#include "simulation/robot_component.hpp"

namespace rois::simulation {

class WheelAction : public Action {
public:
    // `owner` names the component to the drive; a literal.
    WheelAction(Fitting fitting, std::string_view owner) : Action{moving(std::move(fitting))}, owner_{owner} {}

protected:
    // Begins a motion; when the wheels are another's, ends the action with OUT_OF_RESOURCES.
    void drive(Motion);
    // How the motion goes; `ended` when there is none.
    Progress progress() const;
    // For how long the robot has been kept from moving without a break, by somebody in the way or by its brakes; asked once a
    // step.
    WorldTime blocked(MotionState);
    // By what, for people.
    std::string what_blocks() const;

    bool wheels_are_anothers() const;
    // Why they cannot be had.
    std::string busy_wheels() const;

    // WARNING while somebody is in the way, or a motion waits for the brakes to be put off.
    ComponentStatus condition() const override;
    bool has_ceased() const final;
    void cease() override;
    void hold() override;
    void go_on() override;

private:
    std::string_view owner_;
    std::optional<MotionId> motion_;
    WorldTime blocked_{};
};

}  // namespace rois::simulation
