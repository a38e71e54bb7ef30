// Navigation (7.6.13): drives to positions in order. Also the base of components that extend it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "basic/base/drive_action.hpp"

namespace rois::basic {

class Navigation : public DriveAction {
public:
    // `owner` names the component to the mobile base. It must be a literal.
    Navigation(Context context, std::string_view owner)
        : DriveAction{with_position_parameter(std::move(context), "target_position"), owner} {}

protected:
    std::optional<std::string> parameter_problem(ParameterList const&) const override;
    std::variant<Plan, Refused> plan(ParameterList const&) override;

    // Plans to visit these positions or places in order, with time_limit and routing_policy of the parameters. The action ends
    // with ERROR at once if the robot can never stand at one of them.
    Plan visit(std::vector<std::string> targets, ParameterList const&);

private:
    void set_out(std::vector<std::string> names, GoTo way, WorldTime limit);
    void act() final;
    void report_reached();

    std::vector<std::string> names_;  // targets as given, in the robot's frame
    std::size_t reported_ = 0;        // number of reported targets
    WorldTime limit_{};               // 0: none
};

}  // namespace rois::basic
