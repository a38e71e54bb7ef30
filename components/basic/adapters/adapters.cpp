#include "basic/adapters/adapters.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>

#include "basic/adapters/example_components.hpp"
#include "basic/base/component_names.hpp"
#include "types/text/listing.hpp"
#include "types/text/texts.hpp"

namespace rois::basic {
namespace {

constexpr std::string_view adapter_urn = "urn:x-rois:def:adapter:simulation::";

// Makes the component of one robot. The profile includes the messages of its sub components.
using Make = std::function<std::unique_ptr<LocalComponent>(Context, ComponentProfile const&)>;

std::map<std::string, Make, std::less<>> adapters(std::shared_ptr<xml::Schemas const> const& schemas, Streams streams) {
    std::map<std::string, Make, std::less<>> all;
    for (auto const& basic : basic_components(streams))
        all.emplace(basic.ref, [make = basic.make](Context context, auto const&) { return make(std::move(context)); });
    all.emplace("srgs_speech_recognition",
                [schemas](Context context, auto const&) { return srgs_speech_recognition(std::move(context), schemas); });
    all.emplace("person_gender_identification",
                [](Context context, auto const&) { return person_gender_identification(std::move(context)); });
    all.emplace("person_age_recognition",
                [](Context context, auto const&) { return person_age_recognition(std::move(context)); });
    all.emplace("wheelchair_robot", [](Context context, auto const&) { return wheelchair_robot(std::move(context)); });
    all.emplace("stand_in", [](Context context, ComponentProfile const& whole) { return stand_in(std::move(context), whole); });
    return all;
}

// Returns the adapter of the first basic component that the profile is or includes; empty if there is none.
std::string_view included(ComponentProfile const& profile, std::vector<ComponentProfile> const& known, Streams streams) {
    for (auto const& basic : basic_components(streams))
        if (equal_ignoring_case(profile.object.identifier, urn_of(basic))) return basic.ref;
    for (auto const& urn : profile.sub_components)
        if (auto const meant = find_parts(known, profile, urn); !meant.empty())
            if (auto const name = included(*meant.front(), known, streams); !name.empty()) return name;
    return {};
}

}  // namespace

std::string adapter_of(ComponentProfile const& profile, std::vector<ComponentProfile> const& known, Streams streams) {
    auto const& said = profile.object.meta_data;
    if (said.size() <= adapter_urn.size() || !equal_ignoring_case(said.substr(0, adapter_urn.size()), adapter_urn))
        return std::string{included(profile, known, streams)};
    auto name = lower_case(said.substr(adapter_urn.size()));
    auto const all = adapters({}, streams);
    if (!all.contains(name))
        throw std::runtime_error("unknown adapter " + quoted(name) + "; expected one of " + listed(all | std::views::keys));
    return name;
}

std::vector<std::unique_ptr<Component>> Adapters::components(ComponentProfile const& profile,
                                                             std::vector<ComponentProfile> const& known) const {
    auto const name = adapter_of(profile, known, streams());
    if (name.empty()) return {};
    auto const make = adapters(schemas_, streams()).at(name);
    auto const whole = flattened(profile, known);
    auto const shared = std::make_shared<ComponentProfile const>(profile);
    std::vector<std::unique_ptr<Component>> made;
    made.reserve(robots_.bodies.size());
    for (auto const& body : robots_.bodies)
        if (!body->is_fixed())
            made.push_back(robots_.component(body, component_name(profile), shared,
                                             [&](Context context) { return make(std::move(context), whole); }));
    return made;
}

}  // namespace rois::basic
