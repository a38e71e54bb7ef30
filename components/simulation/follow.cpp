// Follow (7.6.14): stays with somebody until it is stopped.
#include "simulation/basic_components.hpp"
#include "simulation/parameter_reading.hpp"
#include "simulation/wheels.hpp"
#include "types/texts.hpp"

namespace rois::simulation {
namespace {

class Follow final : public WheelAction {
public:
    explicit Follow(Fitting fitting) : WheelAction{std::move(fitting), "follow"} {}

    CompletedStatus status_when_stopped() const override { return CompletedStatus::ok; }

private:
    std::optional<std::string> unfit(ParameterList const& parameters) const override {
        if (auto problem = negative(parameters, "distance")) return problem;
        if (auto problem = negative(parameters, "time_limit")) return problem;
        if (hall().find_robot(text_of(parameters, "target_object_ref")) != robot()) return {};
        return "parameter 'target_object_ref': the robot cannot follow itself";
    }

    std::optional<std::string> missing(ParameterList const& parameters) const override {
        if (text_of(parameters, "target_object_ref").empty()) return "parameter 'target_object_ref' is mandatory";
        if (!integer_of(parameters, "distance")) return "parameter 'distance' is mandatory";
        return {};
    }

    void begin(ParameterList const& parameters) override {
        ref_ = text_of(parameters, "target_object_ref");
        distance_ = *integer_of(parameters, "distance") / 1000.0;
        limit_ = WorldTime{integer_of(parameters, "time_limit").value_or(0)};
        whom_.reset();
        waits_ = false;
        if (wheels_are_anothers()) return end(CompletedStatus::out_of_resources, busy_wheels());
        look();
    }

    void act() override {
        if (limit_.count() == 0 || elapsed() < limit_) return look();
        cease();
        end(CompletedStatus::timeout, "time_limit has passed");
    }

    // Keeps the distance to the target, or stands and waits until it is found.
    void look() {
        auto found = hall().find(ref_);
        if (found && !hall().pose_of(*found)) found.reset();
        if (found ? whom_ == found && !over(progress().state) : waits_) return;
        whom_ = found;
        waits_ = !found;
        if (found) return drive(KeepDistance{.whom = *found, .distance = distance_});
        drive(Stay{});
    }

    ComponentStatus condition() const override { return waits_ ? ComponentStatus::warning : WheelAction::condition(); }

    void cease() override {
        waits_ = false;
        WheelAction::cease();
    }

    std::string ref_;
    Metres distance_ = 0;
    WorldTime limit_{};  // 0: none
    std::optional<Entity> whom_;
    bool waits_ = false;  // for the target to be found
};

}  // namespace

std::unique_ptr<Component> follow(Fitting fitting) { return std::make_unique<Follow>(std::move(fitting)); }

}  // namespace rois::simulation
