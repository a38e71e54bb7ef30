// System information (7.6.1): the robot's position and the status of its engine.
#include "basic/base/codebooks.hpp"
#include "basic/components/basic_components.hpp"

namespace rois::basic {
namespace {

class SystemInformation final : public RobotComponent {
public:
    using RobotComponent::RobotComponent;

    Halted halt(Instant) override { return Halted::confirmed; }
    void suspend(Instant) override {}
    void resume(Instant) override {}

    std::vector<Results> query(std::string_view query_type, Instant now) override {
        if (query_type == "robot_position") return one_row(robot_position(last_step().value_or(now)));
        if (query_type == "engine_status") return one_row(engine_status());
        return {};
    }

private:
    // Never called: the component has no methods of RoIS_Common.
    Prepared prepare_start(ParameterList const&) override { return Refused{"there is nothing to start"}; }

    void on_step(Instant when) override {
        if (!operable_time_) operable_time_ = date_time("operable_time", when.utc);
    }

    // WARNING while the robot is obstructed.
    ComponentStatus running_status() const override {
        return body().base().status().motion == MotionState::obstructed ? ComponentStatus::warning : ComponentStatus::ready;
    }

    Results robot_position(Instant measured_at) const {
        auto const [pose, covariance] = body().measured_pose();
        auto const& name = body().name();
        return {{date_time("timestamp", measured_at.utc), references("robot_ref", {name}, std::string{codebook::robot}),
                 positions("position_data", {to_wire(pose)}, body().crs())},
                {located_entity("position_data", name, pose, 0, covariance)}};
    }

    Results engine_status() const {
        Results results;
        results.parameters.reserve(2);
        results.parameters.push_back(status_of("status", status()));
        if (operable_time_) results.parameters.push_back(*operable_time_);
        return results;
    }

    std::optional<Parameter> operable_time_;  // nothing before the first step
};

}  // namespace

std::unique_ptr<LocalComponent> system_information(Context context) {
    return std::make_unique<SystemInformation>(std::move(context));
}

}  // namespace rois::basic
