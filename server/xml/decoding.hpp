// From trees of messages to messages.
#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "types/messages.hpp"
#include "xml/codec.hpp"
#include "xml/message_tree.hpp"

namespace rois::xml {

// The elements that are requests, in the order of wire.md.
std::span<std::string_view const> operation_names();

// Nothing when the root is no request.
std::optional<Request> decode(MessageTree const&);

// What an engine says, of which nothing is known: nothing when it is none of these, or lacks what it must have. The profiles of
// get_profile's reply are left out.
std::optional<Heard> decode_heard(MessageTree const&);

// Nothing when the root is another element, or does not say whether everything is stopped.
std::optional<StopState> decode_stop_state(MessageTree const&);

// Parts of messages. Of none: empty ones; no condition restricts nothing.
Identifier decode_identifier(MessageTree::Node);
ParameterList decode_parameters(MessageTree::Node list, std::string_view element = "parameter");
CommandUnitSequence decode_sequence(MessageTree::Node command_unit_sequence);
Results decode_results(MessageTree::Node results);
QueryExpression decode_condition(MessageTree::Node condition);

// "true" and "1", with white space around them.
bool decode_boolean(std::string_view);

// A whole number of any length: one that does not fit is saturated.
std::int64_t decode_integer(std::string_view);
std::uint64_t decode_unsigned(std::string_view);

}  // namespace rois::xml
