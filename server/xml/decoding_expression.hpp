// The values that predicates relate: references, literals, geometries, times and functions.
#pragma once

#include <pugixml.hpp>
#include <string_view>
#include <vector>

#include "types/condition.hpp"

namespace rois::xml {

// An expression, a geometry or a time, from the element that is one. What is not understood in it is named.
Expression decode_expression(pugi::xml_node);

NotUnderstood not_understood(std::string_view what);

std::vector<pugi::xml_node> elements_in(pugi::xml_node);

}  // namespace rois::xml
