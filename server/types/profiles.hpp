// The profiles (7.5, tables 24 to 30): what an engine, its components and their messages are.
#pragma once

#include <chrono>
#include <memory>
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
    std::optional<std::chrono::milliseconds> timeout;  // in which the component must have started

    bool operator==(MessageProfile const&) const = default;
};

// What IO_IdentifiedObject [ISO 19111] gives to profiles.
struct IdentifiedObject {
    std::string identifier;  // a URN
    std::string code_space;
    std::string name;
    std::string description;
    std::string meta_data;  // where metaDataProperty leads to; of a component profile: its adapter

    bool operator==(IdentifiedObject const&) const = default;
};

// Table 29. The messages of the sub components belong to it, too: see `flattened`.
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
};

// The profile with the messages and parameters of all its sub components, its own first; a name is there once. What is said
// first of a parameter, its type and its default value, counts in all messages: those that are included say the same.
// `known` are the profiles among which sub components are looked up (see below).
// Throws std::runtime_error naming the URN when one is unknown or includes itself.
ComponentProfile flattened(ComponentProfile const&, std::vector<ComponentProfile> const& known);

// The profile that this text means: a URN, compared without regard to case; or what has no colon, the name of a profile or the
// last part of its URN, without regard to case and underscores. Null when there is none.
ComponentProfile const* find_profile(std::vector<ComponentProfile> const& known, std::string_view urn_or_name);

// All that the text may mean, in their order; the first is the one that is found.
std::vector<ComponentProfile const*> find_profiles(std::vector<ComponentProfile> const& known, std::string_view urn_or_name);

// All that a profile may mean by the name of one of its sub components: itself only where there is no other.
std::vector<ComponentProfile const*> find_parts(std::vector<ComponentProfile> const& known, ComponentProfile const& whole,
                                                std::string_view urn_or_name);

// Null when the profile has no such message or parameter. Names of messages are compared to the letter, names of parameters
// without regard to case (decision 26).
MessageProfile const* find_message(ComponentProfile const&, MessageKind, std::string_view name);
ParameterProfile const* find_parameter(std::vector<ParameterProfile> const&, std::string_view name);

}  // namespace rois
