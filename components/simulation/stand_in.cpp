// What stands in for a component that nobody has built yet.
#include <utility>

#include "simulation/example_components.hpp"
#include "types/data_type.hpp"

namespace rois::simulation {
namespace {

// The results that have a default value, with it.
Results defaults_of(std::vector<ParameterProfile> const& profiles) {
    Results results;
    for (auto const& profile : profiles)
        if (profile.default_value)
            results.parameters.push_back(
                {profile.name, profile.data_type_ref, default_values(profile.data_type_ref, *profile.default_value)});
    return results;
}

class StandIn final : public ContinuousFunction {
public:
    StandIn(Fitting fitting, ComponentProfile whole) : ContinuousFunction{std::move(fitting)}, whole_{std::move(whole)} {}

    void perform(CommandHandle command, std::string_view command_type, ParameterList const&, Instant) override {
        auto const* message = find_message(whole_, MessageKind::command, command_type);
        port().completed(command, CompletedStatus::ok, message == nullptr ? Results{} : defaults_of(message->results));
    }

    std::vector<Results> query(std::string_view query_type, Instant) override {
        auto const* message = find_message(whole_, MessageKind::query, query_type);
        if (message == nullptr) return {};
        return {defaults_of(message->results)};
    }

    // As any query; what set_parameter sets, too, is the engine's to tell.
    ParameterList readable_parameters() const override {
        auto const* message = find_message(whole_, MessageKind::query, "get_parameter");
        return message == nullptr ? ParameterList{} : defaults_of(message->results).parameters;
    }

private:
    void begin() override {}
    void sense(Instant) override {}

    ComponentProfile whole_;
};

}  // namespace

std::unique_ptr<Component> stand_in(Fitting fitting, ComponentProfile whole) {
    return std::make_unique<StandIn>(std::move(fitting), std::move(whole));
}

}  // namespace rois::simulation
