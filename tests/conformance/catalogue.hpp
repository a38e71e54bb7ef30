// What a gateway says that it has: its components and their profiles, read from an answer of get_profile.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/vocabulary.hpp"

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
    std::vector<TypedName> parameters;
    bool is_common = false;  // start, stop, suspend, resume and component_status (table 32)

    // What it is of the basic components: the end of its URN in lower case, "persondetection"; empty for others.
    std::string basic() const;
    Message const* query(std::string const& name) const;
    Message const* event(std::string const& name) const;
    // Whether it can be read or set.
    bool parameter(std::string const& name) const;
    // Of "persondetection": "person_detected", the event of its first measurement.
    std::string detection() const;
};

struct Catalogue {
    std::string engine;
    std::vector<Component> components;  // by ref

    // `answer` is that of get_profile without a condition.
    static Catalogue read(client::Document const& answer);

    Component const* find(std::string const& ref) const;
};

// `text` is a value of this type (decision 26).
bool is_of_type(std::string const& type, std::vector<std::string> const& values);

}  // namespace rois::conformance
