// Follow (7.6.14): keeps a distance to a person or robot until it is stopped.
#include "basic/base/codebooks.hpp"
#include "basic/base/drive_action.hpp"
#include "basic/base/parameter_reading.hpp"
#include "basic/components/basic_components.hpp"
#include "types/text/texts.hpp"

namespace rois::basic {
namespace {

// How long Follow waits for a missing target, in world time.
constexpr WorldTime patience{30'000};
// Its end by `stop` is a success (decision 8).
Context that_stops_well(Context context) {
    context.description.status_when_stopped = CompletedStatus::ok;
    return context;
}

// How long Follow waits for an unknown target, in real time. `patience` applies too; in a fast simulation it ends first.
constexpr std::chrono::milliseconds time_to_be_known{5'000};

class Follow final : public DriveAction {
public:
    explicit Follow(Context context)
        : DriveAction{with_identifier_parameter(that_stops_well(std::move(context)), "target_object_ref",
                                                {codebook::entity, codebook::track, codebook::visitor, codebook::robot}),
                      "follow"} {}

private:
    std::optional<std::string> parameter_problem(ParameterList const& parameters) const override {
        if (auto problem = negative(parameters, "distance")) return problem;
        if (auto problem = negative(parameters, "time_limit")) return problem;
        auto const ref = text_of(parameters, "target_object_ref");
        if (perception().find(ref, codebook_of(parameters, "target_object_ref")) != body().self()) return {};
        return "parameter 'target_object_ref': the robot cannot follow itself";
    }

    // A target to follow, from the parameters.
    struct Target {
        std::string ref;
        std::string codebook;  // of ref; empty: any
        Metres distance = 0;
        WorldTime limit{};  // 0: none
    };

    std::variant<Plan, Refused> plan(ParameterList const& parameters) override {
        Target target{.ref = std::string{text_of(parameters, "target_object_ref")},
                      .codebook = std::string{codebook_of(parameters, "target_object_ref")},
                      .limit = WorldTime{integer_of(parameters, "time_limit").value_or(0)}};
        if (target.ref.empty()) return Refused{"parameter 'target_object_ref' is mandatory"};
        auto const distance = integer_of(parameters, "distance");
        if (!distance) return Refused{"parameter 'distance' is mandatory"};
        target.distance = *distance / 1000.0;
        return [this, target = std::move(target)] {
            target_ = target;
            whom_.reset();
            waits_ = false;
            waited_ = {};
            look();
        };
    }

    void act() override {
        if (target_.limit.count() > 0 && elapsed() >= target_.limit)
            return give_up(CompletedStatus::timeout, (waits_ ? target_is_not_there() + " within" : "the follow has lasted for") +
                                                         " time_limit, " + std::to_string(target_.limit.count()) + " ms");
        look();
        waited_ = waits_ ? waited_ + step_length() : WorldTime{};
        if (waited_ >= patience && !perception().knows(target_.ref)) return give_up(CompletedStatus::error, target_is_unknown());
        if (waited_ >= patience)
            give_up(CompletedStatus::error, target_is_not_there() + " for " + std::to_string(patience.count()) + " ms");
    }

    // Real time: an unknown target may never appear, at any simulation speed.
    void time_passed(Instant now) override {
        if (!waits_ || held_ || perception().knows(target_.ref)) return unknown_since_.reset();
        if (!unknown_since_) unknown_since_ = now.steady;
        if (now.steady - *unknown_since_ < time_to_be_known) return;
        give_up(CompletedStatus::error, target_is_unknown());
    }

    std::string target_is_unknown() const {
        return "parameter 'target_object_ref': " + quoted(target_.ref) +
               " is unknown: no robot has this name, and no robot has seen a person of this name";
    }

    std::string target_is_not_there() const { return quoted(target_.ref) + " has not been seen"; }

    // Keeps the distance to the target, or stands and waits for it.
    void look() {
        auto const found = perception().find(target_.ref, target_.codebook);
        if (found ? whom_ == found && !over(progress().state) : waits_) return;
        if (!drive(found ? Motion{KeepDistance{.whom = *found, .distance = target_.distance}} : Stay{})) return;
        whom_ = found;
        waits_ = !found;
    }

    ComponentStatus running_status() const override { return waits_ ? ComponentStatus::warning : DriveAction::running_status(); }

    void stop() override {
        waits_ = held_ = false;
        unknown_since_.reset();
        DriveAction::stop();
    }

    void hold() override {
        held_ = true;
        DriveAction::hold();
    }

    void go_on() override {
        held_ = false;
        DriveAction::go_on();
    }

    Target target_;
    std::optional<EntityId> whom_;
    bool waits_ = false;  // for the target
    bool held_ = false;
    WorldTime waited_{};                   // without interruption
    std::optional<Steady> unknown_since_;  // waits for an unknown target
};

}  // namespace

std::unique_ptr<LocalComponent> follow(Context context) { return std::make_unique<Follow>(std::move(context)); }

}  // namespace rois::basic
