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
    std::vector<TypedName> parameters;  // those of ParameterProfile and of set_parameter
    bool has_common = false;            // start, stop, suspend, resume and component_status (table 32)
    bool is_common = false;             // has them, and its commands need no arguments

    // The basic component: the end of its URN in lower case, "persondetection"; empty for others.
    std::string basic() const;
    // A basic component that is active from `start` to `stop`: detection, localization, identification or recognition.
    bool is_function() const;
    Message const* query(std::string const& name) const;
    Message const* event(std::string const& name) const;
    // By its name, in any case; null when neither set_parameter nor a ParameterProfile has it.
    TypedName const* parameter_named(std::string const& name) const;
    // Whether it can be read or set.
    bool parameter(std::string const& name) const;
    // Whether set_parameter should take it. Parameters that tell what a component can do need not be settable.
    bool can_set(TypedName const& parameter) const;
    // Of "persondetection": "person_detected", the event of its first measurement.
    std::string detection() const;
};

struct Catalogue {
    std::string engine;
    std::vector<Component> components;                   // by ref
    std::map<std::string, std::set<std::string>> whole;  // by engine: the refs of its components and of its sub engines'

    // `answer` is that of get_profile without a condition.
    static Catalogue read(kit::Document const& answer);

    Component const* find(std::string const& ref) const;
};

// What a gml:id names: "_x3A_" in it stands for a byte (UTF-8) of a character that no name of XML has.
std::string named_by(std::string_view gml_id);

// The profile of the component `ref` in an answer of get_profile; null when there is none.
pugi::xml_node profile_of(pugi::xml_node answer, std::string const& ref);

// Types are the same when they differ in case, in the name of a number, or in that one is a URN (decision 26).
bool is_same_type(std::string const& one, std::string const& other);

// These are values of this type, in any form that XML Schema has for it (decision 26); a time is in UTC (decision 28).
bool is_of_type(std::string const& type, std::vector<std::string> const& values);

// Whether each of its items is a value of its own; numbers and bools stand in one.
bool is_list_of_texts(std::string const& type);

}  // namespace rois::conformance
