// Decodes lists of numbers (xsd:list).
#pragma once

#include <string_view>
#include <vector>

namespace rois::xml {

// Returns the numbers of a list separated by white space. An item that is not a number gives NaN.
std::vector<double> decode_numbers(std::string_view);

}  // namespace rois::xml
