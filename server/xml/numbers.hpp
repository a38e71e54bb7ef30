// Lists of numbers, as xsd:list writes them.
#pragma once

#include <string_view>
#include <vector>

namespace rois::xml {

// Separated by white space; NaN for what is none.
std::vector<double> decode_numbers(std::string_view);

}  // namespace rois::xml
