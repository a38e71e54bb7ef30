#include "xml/codec/numbers.hpp"

#include <cmath>

#include "types/texts.hpp"

namespace rois::xml {

std::vector<double> decode_numbers(std::string_view text) {
    std::vector<double> numbers;
    for (text = trimmed(text); !text.empty();) {
        auto const item = text.substr(0, text.find_first_of(" \t\r\n"));
        numbers.push_back(to_double(item).value_or(std::nan("")));
        text = trimmed(text.substr(item.size()));
    }
    return numbers;
}

}  // namespace rois::xml
