// Whether bytes are characters that XML may carry.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace rois::xml {

struct BadCharacter {
    std::size_t offset;
    std::size_t length;  // in bytes; 1 for what is not UTF-8
    std::string_view complaint;
};

// The first byte that is not UTF-8 or not a character of XML 1.0.
std::optional<BadCharacter> first_bad_character(std::string_view);

// Whether XML 1.0 has this character.
bool is_character(char32_t);

}  // namespace rois::xml
