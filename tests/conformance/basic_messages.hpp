// The queries and events of the basic components, from tables 34 to 47.
#pragma once

#include <string>
#include <vector>

#include "conformance/catalogue.hpp"

namespace rois::conformance {

struct BasicMessage {
    std::string kind;  // Component::basic()
    std::string name;
    bool is_event;
    std::vector<TypedName> results;   // present in each answer
    std::vector<TypedName> settable;  // present in each answer after an application has set them
};

std::vector<BasicMessage> const& basic_messages();
// Returns the query or event `name` of a component of this kind, or null if no table has it.
BasicMessage const* basic_message(std::string const& kind, std::string const& name);

}  // namespace rois::conformance
