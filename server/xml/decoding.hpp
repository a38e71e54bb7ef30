// From trees of valid documents to messages.
#pragma once

#include <optional>
#include <pugixml.hpp>
#include <span>
#include <string_view>

#include "types/messages.hpp"

namespace rois::xml {

// The elements that are requests, in the order of wire.md.
std::span<std::string_view const> operation_names();

// Nothing when the root is no request.
std::optional<Request> decode(pugi::xml_node root);

// Parts of messages.
Identifier decode_identifier(pugi::xml_node);
ParameterList decode_parameters(pugi::xml_node list);
CommandUnitSequence decode_sequence(pugi::xml_node command_unit_sequence);
QueryExpression decode_condition(pugi::xml_node condition);  // a null node restricts nothing

// "true" and "1", with white space around them.
bool decode_boolean(std::string_view);

// A whole number of any length: one that does not fit is saturated.
std::int64_t decode_integer(std::string_view);
std::uint64_t decode_unsigned(std::string_view);

}  // namespace rois::xml
