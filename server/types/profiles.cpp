#include "types/profiles.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "types/data_type.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

// Returns "PersonDetection" for "urn:x-rois:def:component:OMG::PersonDetection".
std::string_view last_part(std::string_view urn) { return urn.substr(urn.rfind(':') + 1); }

std::string without_underscores(std::string_view name) {
    std::string letters{name};
    std::erase(letters, '_');
    return letters;
}

bool same_name(std::string_view a, std::string_view b) {
    return equal_ignoring_case(without_underscores(a), without_underscores(b));
}

// Returns the definition of a parameter in the profile, in set_parameter or in get_parameter; null if there is none.
ParameterProfile const* definition_of(ComponentProfile const& profile, std::string_view name) {
    if (auto const* found = find_parameter(profile.parameters, name)) return found;
    if (auto const* message = find_message(profile, MessageKind::command, "set_parameter"))
        if (auto const* found = find_parameter(message->arguments, name)) return found;
    auto const* message = find_message(profile, MessageKind::query, "get_parameter");
    return message == nullptr ? nullptr : find_parameter(message->results, name);
}

bool same_type(ParameterProfile const& a, ParameterProfile const& b) {
    return DataType::of(a.data_type_ref) == DataType::of(b.data_type_ref);
}

// Gives the parameters the type and default value of their definition in `first`, if there is one.
void adopt_definitions(std::vector<ParameterProfile>& added, ComponentProfile const& first) {
    for (auto& parameter : added) {
        auto const* const known = definition_of(first, parameter.name);
        if (known == nullptr) continue;
        if (known->default_value || !same_type(parameter, *known)) parameter.default_value = known->default_value;
        parameter.data_type_ref = known->data_type_ref;
    }
}

MessageProfile with_definitions(MessageProfile message, ComponentProfile const& first) {
    if (message.kind == MessageKind::command && message.name == "set_parameter") adopt_definitions(message.arguments, first);
    if (message.kind == MessageKind::query && message.name == "get_parameter") adopt_definitions(message.results, first);
    return message;
}

// Adds messages and parameters of `part` and its sub components that `whole` lacks. `path` holds the profiles being added.
void add_all(ComponentProfile& whole, ComponentProfile const& part, std::vector<ComponentProfile> const& known,
             std::vector<ComponentProfile const*>& path) {
    if (std::ranges::find(path, &part) != path.end())
        throw std::runtime_error("the component profile " + quoted(part.object.identifier, 200) + " includes itself");
    path.push_back(&part);
    auto const before = whole;
    for (auto const& message : part.messages)
        if (find_message(whole, message.kind, message.name) == nullptr)
            whole.messages.push_back(with_definitions(message, before));
    auto parameters = part.parameters;
    adopt_definitions(parameters, before);
    for (auto& parameter : parameters)
        if (find_parameter(whole.parameters, parameter.name) == nullptr) whole.parameters.push_back(std::move(parameter));
    for (auto const& urn : part.sub_components) {
        auto const meant = find_parts(known, part, urn);
        if (meant.empty()) throw std::runtime_error("no component profile " + quoted(urn, 200) + " is known");
        add_all(whole, *meant.front(), known, path);
    }
    path.pop_back();
}

}  // namespace

ComponentProfile flattened(ComponentProfile const& profile, std::vector<ComponentProfile> const& known) {
    ComponentProfile whole{.object = profile.object, .sub_components = profile.sub_components, .messages = {}, .parameters = {}};
    std::vector<ComponentProfile const*> path;
    add_all(whole, profile, known, path);
    return whole;
}

std::vector<ComponentProfile const*> find_profiles(std::vector<ComponentProfile> const& known, std::string_view urn_or_name) {
    auto const wanted = trimmed(urn_or_name);
    auto const urn = std::ranges::find_if(known, [&](auto const& p) { return equal_ignoring_case(p.object.identifier, wanted); });
    if (urn != known.end()) return {&*urn};
    std::vector<ComponentProfile const*> found;
    if (wanted.find(':') != wanted.npos || wanted.empty()) return found;
    for (auto const& profile : known)
        if (same_name(profile.object.name, wanted) || same_name(last_part(profile.object.identifier), wanted))
            found.push_back(&profile);
    return found;
}

std::vector<ComponentProfile const*> find_parts(std::vector<ComponentProfile> const& known, ComponentProfile const& whole,
                                                std::string_view urn_or_name) {
    auto found = find_profiles(known, urn_or_name);
    if (found.size() > 1)
        std::erase_if(found, [&](auto const* p) { return equal_ignoring_case(p->object.identifier, whole.object.identifier); });
    return found;
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
