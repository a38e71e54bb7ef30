// The components of a gateway and their profiles, read from an answer of get_profile.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "kit/vocabulary.hpp"

namespace rois::conformance {

struct TypedName {
    std::string name;
    std::string type;  // the code of its data type
    std::optional<std::string> default_value{};
};

struct Message {
    std::string name;
    std::vector<TypedName> results;
    std::vector<TypedName> arguments;
};

struct Component {
    std::string ref;
    std::string type;  // URN, as written
    std::string engine;
    std::vector<Message> commands, queries, events;
    std::vector<TypedName> parameters;  // from ParameterProfile, and the arguments of set_parameter
    bool has_common = false;            // start, stop, suspend, resume and component_status (table 32)
    bool is_common = false;             // has_common, and start, stop, suspend and resume need no arguments

    // Returns the kind of a basic component, the end of its URN in lower case: "persondetection". Empty for other components.
    std::string basic() const;
    // Returns whether this is a basic component that is active from `start` to `stop`: detection, localization, identification or
    // recognition.
    bool is_function() const;
    Message const* query(std::string const& name) const;
    Message const* event(std::string const& name) const;
    // Returns the parameter with this name (case-insensitive), or null if neither set_parameter nor a ParameterProfile has it.
    TypedName const* parameter_named(std::string const& name) const;
    // Returns whether the component has a parameter with this name that can be read or set.
    bool parameter(std::string const& name) const;
    // Returns whether set_parameter must accept the parameter. Parameters that list abilities, such as `available_reactions`, may
    // be read-only.
    bool can_set(TypedName const& parameter) const;
    // Returns the event of a detection component: "person_detected" for "persondetection".
    std::string detection_event() const;
};

struct Catalogue {
    std::string engine;
    std::vector<Component> components;                            // by ref
    std::map<std::string, std::set<std::string>> refs_by_engine;  // the component refs of each engine, including its sub engines

    // Reads the answer of get_profile without a condition.
    static Catalogue read(kit::Document const& answer);

    Component const* find(std::string const& ref) const;
};

// Returns the name that a gml:id encodes. "_x3A_" stands for a UTF-8 byte of a character that is not allowed in an XML name.
std::string named_by(std::string_view gml_id);

// Returns the profile of the component `ref` in an answer of get_profile, or null if the answer lacks it.
pugi::xml_node profile_of(pugi::xml_node answer, std::string const& ref);

// Returns whether two types are the same (decision 26). Ignores case, the prefix of a URN, and synonyms such as "int" and
// "Integer".
bool is_same_type(std::string const& one, std::string const& other);

// Returns whether the values have this type, in any form that XML Schema allows (decision 26). Times must be in UTC (decision
// 28).
bool is_of_type(std::string const& type, std::vector<std::string> const& values);

// Returns whether the type is a list with one value for each item. Lists of numbers and bools are one value, separated by spaces.
bool is_list_of_texts(std::string const& type);

}  // namespace rois::conformance
