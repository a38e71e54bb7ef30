// A placeholder for a component that is not implemented yet.
#include <utility>

#include "basic/adapters/example_components.hpp"
#include "types/data_type.hpp"

namespace rois::basic {
namespace {

// Returns the results that have a default value.
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
    StandIn(Context context, ComponentProfile whole) : ContinuousFunction{std::move(context)}, whole_{std::move(whole)} {}

    Prepared prepare_command(std::string_view command_type, ParameterList const&) override {
        auto const* message = find_message(whole_, MessageKind::command, command_type);
        return [this, results = message == nullptr ? Results{} : defaults_of(message->results)](CommandHandle command, Instant) {
            port().completed(command, CompletedStatus::ok, results);
        };
    }

    std::vector<Results> query(std::string_view query_type, Instant) override {
        auto const* message = find_message(whole_, MessageKind::query, query_type);
        if (message == nullptr) return {};
        return {defaults_of(message->results)};
    }

    // Default values like in any query. The engine adds the parameters of set_parameter.
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

std::unique_ptr<LocalComponent> stand_in(Context context, ComponentProfile whole) {
    return std::make_unique<StandIn>(std::move(context), std::move(whole));
}

}  // namespace rois::basic
