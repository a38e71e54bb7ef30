// Navigation (7.6.13): drives to positions in order. Also the base of components that extend it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "simulation/basic/drive_action.hpp"

namespace rois::simulation {

class Navigation : public DriveAction {
public:
    // `owner` names the component to the drive. It must be a literal.
    Navigation(Context context, std::string_view owner)
        : DriveAction{with_position_parameter(std::move(context), "target_position"), owner} {}

protected:
    std::optional<std::string> parameter_problem(ParameterList const&) const override;
    std::optional<std::string> start_problem(ParameterList const&) const override;
    void begin(ParameterList const&) override;

    // Visits these positions or places in order, with time_limit and routing_policy of the parameters. Ends with ERROR at once if
    // a target is outside of the hall or in a wall or furniture.
    void visit(std::vector<std::string> targets, ParameterList const&);

private:
    void act() final;
    void report_reached();
    void give_up(CompletedStatus, std::string reason);

    std::vector<std::string> names_;  // targets as given, in the robot's frame
    std::size_t reported_ = 0;        // number of reported targets
    WorldTime limit_{};               // 0: none
};

}  // namespace rois::simulation
