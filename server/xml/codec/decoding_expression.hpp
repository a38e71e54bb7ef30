// Decodes the operands of predicates: references, literals, geometries, times and functions.
#pragma once

#include <string_view>

#include "types/condition.hpp"
#include "xml/codec/message_tree.hpp"

namespace rois::xml {

// Decodes an expression, a geometry or a time. Returns NotUnderstood, with the reason, for an unsupported part.
Expression decode_expression(MessageTree::Node);

NotUnderstood not_understood(std::string_view name);  // `name`: the unsupported part

}  // namespace rois::xml
