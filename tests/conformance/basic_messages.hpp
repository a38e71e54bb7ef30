// What the tables of the basic components (34 to 47) say of their queries and events.
#pragma once

#include <string>
#include <vector>

#include "conformance/catalogue.hpp"

namespace rois::conformance {

struct BasicMessage {
    std::string kind;  // Component::basic()
    std::string name;
    bool is_event;
    std::vector<TypedName> results;   // which each answer has
    std::vector<TypedName> settable;  // which each answer has once they are set
};

std::vector<BasicMessage> const& basic_messages();
// Of a query or an event of a component of this kind; null when no table has it.
BasicMessage const* basic_message(std::string const& kind, std::string const& name);

}  // namespace rois::conformance
