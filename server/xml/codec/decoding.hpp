// Decodes message trees into messages.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "types/messages.hpp"
#include "xml/codec/codec.hpp"
#include "xml/codec/message_tree.hpp"

namespace rois::xml {

// Returns the root elements of requests, in the order of Operation.
std::span<std::string_view const> operation_names();

// Returns nothing if the root is not a request.
std::optional<Request> decode(MessageTree const&);

// Decodes an engine's message that was not validated. Returns nothing if it is not a message of an engine, or lacks a mandatory
// part. Does not decode the profiles in the reply of get_profile.
std::optional<EngineMessage> decode_engine_message(MessageTree const&);

// Returns nothing if the root is another element, or has no valid `stopped`.
std::optional<StopState> decode_stop_state(MessageTree const&);

// Returns nothing if the root is another element, or an engine has no valid state.
std::optional<std::vector<EngineState>> decode_engines(MessageTree const&);

// Parts of messages. A missing node gives an empty part.
Identifier decode_identifier(MessageTree::Node);
ParameterList decode_parameters(MessageTree::Node list, std::string_view element = "parameter");
CommandUnitSequence decode_sequence(MessageTree::Node command_unit_sequence);
Results decode_results(MessageTree::Node results);
QueryExpression decode_condition(MessageTree::Node condition);

// Decodes an operand of a predicate: a reference, a literal, a geometry, a time or a function. Returns NotUnderstood, with the
// reason, for an unsupported part.
Expression decode_expression(MessageTree::Node);
NotUnderstood not_understood(std::string_view unsupported_part);

// Returns whether the trimmed text is "true" or "1".
bool decode_boolean(std::string_view);

// Decode a whole number of any length; one that does not fit is saturated.
std::int64_t decode_integer(std::string_view);
std::uint64_t decode_unsigned(std::string_view);

}  // namespace rois::xml
