// Navigation (7.6.13): to positions, one after the other. Also the base of components that extend it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "simulation/wheels.hpp"

namespace rois::simulation {

class Navigation : public WheelAction {
public:
    // `owner` names the component to the drive; a literal.
    Navigation(Fitting fitting, std::string_view owner)
        : WheelAction{taking_positions(std::move(fitting), "target_position"), owner} {}

protected:
    std::optional<std::string> unfit(ParameterList const&) const override;
    std::optional<std::string> missing(ParameterList const&) const override;
    void begin(ParameterList const&) override;

    // Visits these positions or places, in order; time_limit and routing_policy are read from the parameters. Goes nowhere when a
    // target is outside of the hall or in a wall or furniture.
    void visit(std::vector<std::string> targets, ParameterList const&);

private:
    void act() final;
    void tell_reached();
    void give_up(CompletedStatus, std::string reason);

    std::vector<std::string> names_;  // of the targets, in the robot's frame
    std::size_t told_ = 0;            // of them
    WorldTime limit_{};               // 0: none
};

}  // namespace rois::simulation
