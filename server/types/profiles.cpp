#include "types/profiles.hpp"

#include <algorithm>
#include <stdexcept>

#include "types/texts.hpp"

namespace rois {

namespace {

ComponentProfile const& look_up(std::string const& urn, std::vector<ComponentProfile> const& known) {
    auto const found = std::ranges::find_if(
        known, [&](ComponentProfile const& p) { return equal_ignoring_case(p.object.identifier, trimmed(urn)); });
    if (found == known.end()) throw std::runtime_error("no component profile " + quoted(urn, 200) + " is known");
    return *found;
}

// Adds what `part` and its own parts have, each name once; `path` are the profiles that are being added.
void add_all(ComponentProfile& whole, ComponentProfile const& part, std::vector<ComponentProfile> const& known,
             std::vector<ComponentProfile const*>& path) {
    if (std::ranges::find(path, &part) != path.end())
        throw std::runtime_error("the component profile " + quoted(part.object.identifier, 200) + " includes itself");
    path.push_back(&part);
    for (auto const& message : part.messages)
        if (find_message(whole, message.kind, message.name) == nullptr) whole.messages.push_back(message);
    for (auto const& parameter : part.parameters)
        if (find_parameter(whole.parameters, parameter.name) == nullptr) whole.parameters.push_back(parameter);
    for (auto const& urn : part.sub_components) add_all(whole, look_up(urn, known), known, path);
    path.pop_back();
}

}  // namespace

ComponentProfile flattened(ComponentProfile const& profile, std::vector<ComponentProfile> const& known) {
    ComponentProfile whole{.object = profile.object, .sub_components = profile.sub_components, .messages = {}, .parameters = {}};
    std::vector<ComponentProfile const*> path;
    add_all(whole, profile, known, path);
    return whole;
}

MessageProfile const* find_message(ComponentProfile const& profile, MessageKind kind, std::string_view name) {
    auto const found =
        std::ranges::find_if(profile.messages, [&](MessageProfile const& m) { return m.kind == kind && m.name == name; });
    return found == profile.messages.end() ? nullptr : &*found;
}

ParameterProfile const* find_parameter(std::vector<ParameterProfile> const& list, std::string_view name) {
    auto const found = std::ranges::find_if(list, [&](ParameterProfile const& p) { return equal_ignoring_case(p.name, name); });
    return found == list.end() ? nullptr : &*found;
}

}  // namespace rois
