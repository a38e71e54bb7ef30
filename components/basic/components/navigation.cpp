#include "basic/components/navigation.hpp"

#include <algorithm>

#include "basic/base/parameter_reading.hpp"
#include "basic/components/basic_components.hpp"
#include "types/text/texts.hpp"

namespace rois::basic {
namespace {

// How long the robot waits for a blocked way or target.
constexpr WorldTime patience{30'000};

}  // namespace

std::optional<std::string> Navigation::parameter_problem(ParameterList const& parameters) const {
    if (auto problem = negative(parameters, "time_limit")) return problem;
    auto const policy = text_of(parameters, "routing_policy");
    if (!policy.empty() && policy != "time" && policy != "distance")
        return "parameter 'routing_policy' must be 'time' or 'distance', not " + quoted(policy);
    auto const* targets = find(parameters, "target_position");
    if (targets == nullptr) return {};
    return not_targets(*targets);
}

std::variant<Navigation::Plan, Refused> Navigation::plan(ParameterList const& parameters) {
    auto const* targets = find(parameters, "target_position");
    if (targets == nullptr || targets->values.empty()) return Refused{"parameter 'target_position' is mandatory"};
    return visit(targets->values, parameters);
}

Navigation::Plan Navigation::visit(std::vector<std::string> targets, ParameterList const& parameters) {
    GoTo way;
    way.policy = text_of(parameters, "routing_policy") == "distance" ? RoutingPolicy::distance : RoutingPolicy::time;
    for (auto const& name : targets) way.targets.push_back(*target(name));
    WorldTime const limit{integer_of(parameters, "time_limit").value_or(0)};
    return [this, targets = std::move(targets), way = std::move(way), limit] { set_out(targets, way, limit); };
}

void Navigation::set_out(std::vector<std::string> names, GoTo way, WorldTime limit) {
    limit_ = limit;
    names_ = std::move(names);
    reported_ = 0;
    drive(std::move(way), names_);
}

void Navigation::act() {
    auto const [state, reached] = progress();
    while (reported_ < reached) report_reached();
    if (state == MotionState::arrived) return end(CompletedStatus::ok);
    if (over(state))
        return end(CompletedStatus::error, "no way leads to " + quoted(names_[std::min(reported_, names_.size() - 1)]));
    if (limit_.count() > 0 && elapsed() >= limit_)
        return give_up(CompletedStatus::timeout,
                       "target not reached within time_limit, " + std::to_string(limit_.count()) + " ms");
    if (blocked(state) >= patience) give_up(CompletedStatus::error, blocking_reason());
}

void Navigation::report_reached() {
    auto reached = text("target", names_[reported_++]);
    reached.data_type_ref.codebook_ref = description().crs;
    port().event("reached_target", {{std::move(reached), boolean("is_final_target", reported_ == names_.size())}, {}});
}

std::unique_ptr<LocalComponent> navigation(Context context) {
    return std::make_unique<Navigation>(std::move(context), "navigation");
}

}  // namespace rois::basic
