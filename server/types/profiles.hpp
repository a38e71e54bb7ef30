// Profiles (7.5, tables 24 to 30): descriptions of engines, components and their messages.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "types/values.hpp"

namespace rois {

// Table 24. Defines a parameter, an argument or a result.
struct ParameterProfile {
    std::string name;
    Identifier data_type_ref;
    std::optional<std::string> default_value;
    std::string description;

    bool operator==(ParameterProfile const&) const = default;
};

enum class MessageKind : std::uint8_t { command, query, event };

// Tables 25 to 28. `arguments` and `timeout` belong to commands only.
struct MessageProfile {
    MessageKind kind = MessageKind::command;
    std::string name;
    std::vector<ParameterProfile> results;
    std::vector<ParameterProfile> arguments;
    std::optional<std::chrono::milliseconds> timeout;  // within which the component must start the command

    bool operator==(MessageProfile const&) const = default;
};

// The part of a profile from IO_IdentifiedObject [ISO 19111].
struct IdentifiedObject {
    std::string identifier;  // a URN
    std::string code_space;
    std::string name;
    std::string description;
    std::string meta_data;  // xlink:href of metaDataProperty; of a component profile: its adapter

    bool operator==(IdentifiedObject const&) const = default;
};

// Table 29. The messages of the sub components also belong to it: see `flattened`.
struct ComponentProfile {
    IdentifiedObject object;
    std::vector<std::string> sub_components;  // URNs, or names
    std::vector<MessageProfile> messages;
    std::vector<ParameterProfile> parameters;

    bool operator==(ComponentProfile const&) const = default;
};

// Table 30. `components` are refs (codes of instances).
struct EngineProfile {
    IdentifiedObject object;
    std::vector<EngineProfile> sub_profiles;
    std::vector<std::string> components;
    std::vector<ParameterProfile> parameters;

    bool operator==(EngineProfile const&) const = default;
};

// The codebooks of one parameter of type RoISIdentifier (decision 31).
struct Codebooks {
    std::string parameter;
    std::vector<std::string> known;  // the first one is the default

    bool operator==(Codebooks const&) const = default;
};

// What an engine must know of another engine's component and its profile does not say (decision 41). The members mean the same as
// in ComponentDescription (engine/component.hpp).
struct ComponentTraits {
    std::vector<std::string> positions;
    std::vector<Codebooks> codebooks;
    std::vector<std::vector<std::string>> alternatives;
    CompletedStatus status_when_stopped = CompletedStatus::abort;
    bool moves = false;

    bool operator==(ComponentTraits const&) const = default;
};

// Returns the profile with the messages and parameters of all its sub components added, its own first. Names are unique. The
// first definition of a parameter sets its type and default value in all messages. Sub components are looked up in `known`.
// Throws std::runtime_error with the URN if a sub component is unknown or includes itself.
ComponentProfile flattened(ComponentProfile const&, std::vector<ComponentProfile> const& known);

// Returns the profile with this URN, ignoring case. A text without colons may also be the name of profiles or the last part of
// their URN; then case and underscores are ignored. Several matches are in the order of `known`.
std::vector<ComponentProfile const*> find_profiles(std::vector<ComponentProfile> const& known, std::string_view urn_or_name);

// Returns all profiles that match the name of a sub component of `whole`. Returns `whole` itself only if no other profile
// matches.
std::vector<ComponentProfile const*> find_parts(std::vector<ComponentProfile> const& known, ComponentProfile const& whole,
                                                std::string_view urn_or_name);

// Return null if there is no such message or parameter. Message names are case-sensitive; parameter names are not (decision 26).
MessageProfile const* find_message(ComponentProfile const&, MessageKind, std::string_view name);
ParameterProfile const* find_parameter(std::vector<ParameterProfile> const&, std::string_view name);

}  // namespace rois
