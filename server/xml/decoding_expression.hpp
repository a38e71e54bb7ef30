// The values that predicates relate: references, literals, geometries, times and functions.
#pragma once

#include <string_view>

#include "types/condition.hpp"
#include "xml/message_tree.hpp"

namespace rois::xml {

// An expression, a geometry or a time, from the element that is one. What is not understood in it is named.
Expression decode_expression(MessageTree::Node);

NotUnderstood not_understood(std::string_view what);

}  // namespace rois::xml
