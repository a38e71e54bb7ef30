#include "main/engine_profile.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "main/keys.hpp"

namespace rois {

namespace {

// The value of a configuration key, as a text.
std::string shown(std::string_view name, GatewaySettings const& settings) {
    return std::ranges::find(keys(), name, &Key::name)->show(settings);
}

// A parameter of the engine. Its present value is its default value.
ParameterProfile engine_parameter(std::string name, std::string type, std::string value, std::string description) {
    return {.name = std::move(name),
            .data_type_ref = {.code = std::move(type), .authority = {}, .codebook_ref = {}, .version = {}},
            .default_value = std::move(value),
            .description = std::move(description)};
}

}  // namespace

EngineProfile engine_profile(GatewaySettings const& settings, simulation::FloorPlan const& plan, std::string const& instance) {
    EngineProfile profile;
    profile.object.identifier = "urn:x-rois:def:HRIEngine:RoISGateway::" + settings.engine_name;
    profile.object.code_space = "urn:ietf:rfc:2141";
    profile.object.name = settings.engine_name;
    profile.parameters = {
        engine_parameter("sim_speed", "double", shown("sim_speed", settings),
                         "Simulated seconds per second; 0: simulated time stands still."),
        engine_parameter("instance", "string", instance, "Distinguishes this start of the engine from all others."),
        engine_parameter("crs", "string", plan.crs, "The frame of the positions that the engine reports. It may accept others.")};
    return profile;
}

}  // namespace rois
