// Navigation (7.6.13): to positions, one after the other.
#include <algorithm>

#include "simulation/basic_components.hpp"
#include "simulation/parameter_reading.hpp"
#include "simulation/wheels.hpp"
#include "types/texts.hpp"

namespace rois::simulation {
namespace {

// Somebody who stands on the way or the target for longer makes it one that cannot be reached.
constexpr WorldTime patience{30'000};

class Navigation final : public WheelAction {
public:
    explicit Navigation(Fitting fitting) : WheelAction{taking_positions(std::move(fitting), "target_position"), "navigation"} {}

private:
    std::optional<std::string> unfit(ParameterList const& parameters) const override {
        if (auto problem = negative(parameters, "time_limit")) return problem;
        auto const policy = text_of(parameters, "routing_policy");
        if (!policy.empty() && policy != "time" && policy != "distance")
            return "parameter 'routing_policy' must be 'time' or 'distance', not " + quoted(policy);
        auto const* targets = find(parameters, "target_position");
        if (targets == nullptr) return {};
        return not_targets(*targets, hall().plan(), [&](auto const& text) { return target(text).has_value(); });
    }

    std::optional<std::string> missing(ParameterList const& parameters) const override {
        auto const* targets = find(parameters, "target_position");
        if (targets != nullptr && !targets->values.empty()) return {};
        return "parameter 'target_position' is mandatory";
    }

    // Goes nowhere when one of the targets is outside of the hall, in a desk or in a wall.
    void begin(ParameterList const& parameters) override {
        limit_ = WorldTime{integer_of(parameters, "time_limit").value_or(0)};
        names_ = find(parameters, "target_position")->values;
        told_ = 0;
        GoTo way;
        way.policy = text_of(parameters, "routing_policy") == "distance" ? RoutingPolicy::distance : RoutingPolicy::time;
        for (auto const& name : names_) way.targets.push_back(*target(name));
        auto const is_hopeless = [&](Target const& target) { return hall().plan().clearance(target.position) <= 0; };
        auto const hopeless = std::ranges::find_if(way.targets, is_hopeless);
        if (hopeless != way.targets.end()) {
            auto const& name = names_[static_cast<std::size_t>(hopeless - way.targets.begin())];
            return end(CompletedStatus::error, quoted(name) + " is outside of the hall, in a wall or in furniture");
        }
        drive(std::move(way));
    }

    void act() override {
        auto const [state, reached] = progress();
        while (told_ < reached) tell_reached();
        if (state == MotionState::arrived) return end(CompletedStatus::ok);
        if (over(state))
            return end(CompletedStatus::error, "no way leads to " + quoted(names_[std::min(told_, names_.size() - 1)]));
        if (limit_.count() > 0 && elapsed() >= limit_)
            return give_up(CompletedStatus::timeout, "not there within time_limit, " + std::to_string(limit_.count()) + " ms");
        if (blocked(state) >= patience) give_up(CompletedStatus::error, "somebody is in the way and does not move");
    }

    void tell_reached() {
        auto reached = text("target", names_[told_++]);
        reached.data_type_ref.codebook_ref = description().crs;
        port().event("reached_target", {{std::move(reached), boolean("is_final_target", told_ == names_.size())}, {}});
    }

    void give_up(CompletedStatus status, std::string reason) {
        cease();
        end(status, std::move(reason));
    }

    std::vector<std::string> names_;  // of the targets, in the robot's frame
    std::size_t told_ = 0;            // of them
    WorldTime limit_{};               // 0: none
};

}  // namespace

std::unique_ptr<Component> navigation(Fitting fitting) { return std::make_unique<Navigation>(std::move(fitting)); }

}  // namespace rois::simulation
