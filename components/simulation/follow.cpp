// Follow (7.6.14): stays with somebody until it is stopped.
#include "simulation/basic_components.hpp"
#include "simulation/parameter_reading.hpp"
#include "simulation/wheels.hpp"
#include "types/texts.hpp"

namespace rois::simulation {
namespace {

// For how long the target may be out of sight, or cannot be come up to, before it counts as lost.
constexpr WorldTime patience{5'000};

// After following for this long it is no longer lost.
constexpr WorldTime settled{200};

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
        lost_ = kept_ = {};
        if (wheels_are_anothers()) return end(CompletedStatus::out_of_resources);
        look();
    }

    void act() override {
        if (limit_.count() > 0 && elapsed() >= limit_) return give_up(CompletedStatus::timeout);
        bool const keeps = whom_ && !over(progress().state);
        kept_ = keeps ? kept_ + Hall::step_length : WorldTime{};
        lost_ = kept_ >= settled ? WorldTime{} : lost_ + Hall::step_length;
        if (lost_ >= patience) return give_up(CompletedStatus::error);
        look();
    }

    // Begins to keep the distance when the target is found, and again each second while it cannot be come up to.
    void look() {
        auto const found = hall().find(ref_);
        if (!found) {
            cease();
            whom_.reset();
            return;
        }
        bool const again = over(progress().state) && lost_ % std::chrono::seconds{1} == WorldTime{};
        if (whom_ == found && !again) return;
        whom_ = found;
        drive(KeepDistance{.whom = *found, .distance = distance_});
    }

    void give_up(CompletedStatus status) {
        cease();
        end(status);
    }

    std::string ref_;
    Metres distance_ = 0;
    WorldTime limit_{};  // 0: none
    std::optional<Entity> whom_;
    WorldTime kept_{};  // for how long the distance has been kept, or come up to
    WorldTime lost_{};  // for how long it was not
};

}  // namespace

std::unique_ptr<Component> follow(Fitting fitting) { return std::make_unique<Follow>(std::move(fitting)); }

}  // namespace rois::simulation
