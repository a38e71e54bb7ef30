// System information (7.6.1): the robot's position and the status of its engine.
#include "simulation/basic/basic_components.hpp"
#include "simulation/basic/codebooks.hpp"
#include "simulation/world/random.hpp"

namespace rois::simulation {
namespace {

// Standard deviations of the robot's own position.
constexpr Metres sigma = 0.01;
constexpr Radians heading_sigma = from_degrees(0.5);

// Separates these random numbers from those of the sensors.
constexpr std::uint64_t own_position = 0x6f776e;

class SystemInformation final : public RobotComponent {
public:
    using RobotComponent::RobotComponent;

    // Never called: the component has no methods of RoIS_Common.
    void start(CommandHandle command, ParameterList const&, Instant) override {
        port().completed(command, CompletedStatus::error, {}, Afterwards::as_before, "there is nothing to start");
    }
    Halted halt(Instant) override { return Halted::confirmed; }
    void suspend(Instant) override {}
    void resume(Instant) override {}

    std::vector<Results> query(std::string_view query_type, Instant now) override {
        if (query_type == "robot_position") return one_row(robot_position(last_step().value_or(now)));
        if (query_type == "engine_status") return one_row(engine_status());
        return {};
    }

private:
    void on_step(Instant when) override {
        if (!operable_time_) operable_time_ = date_time("operable_time", when.utc);
    }

    // WARNING while the robot is obstructed.
    ComponentStatus running_status() const override {
        auto const motion = hall().drive(robot()).current();
        return motion && motion->state == MotionState::obstructed ? ComponentStatus::warning : ComponentStatus::ready;
    }

    Results robot_position(Instant measured_at) const {
        Robot const& self = hall().robot(robot());
        Pose const pose = measured(self.pose);
        Covariance const covariance =
            Eigen::Vector3d{sigma * sigma, sigma * sigma, heading_sigma * heading_sigma}.asDiagonal().toDenseMatrix();
        return {{date_time("timestamp", measured_at.utc), references("robot_ref", {self.name}, std::string{codebook::robot}),
                 positions("position_data", {pose_text(pose)}, crs())},
                {located_entity("position_data", self.name, pose, 0, covariance)}};
    }

    // Returns the same for all calls within a step.
    Pose measured(Pose const& pose) const {
        auto const step = static_cast<std::uint64_t>(hall().now() / Hall::step_length);
        Random random{mixed({hall().seed(), step, static_cast<std::uint64_t>(robot()), own_position})};
        Point const error{random.gaussian() * sigma, random.gaussian() * sigma};
        return {pose.position + error, wrapped(pose.heading + random.gaussian() * heading_sigma)};
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

std::unique_ptr<Component> system_information(Context context) { return std::make_unique<SystemInformation>(std::move(context)); }

}  // namespace rois::simulation
