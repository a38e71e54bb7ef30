// Checks that bytes are UTF-8 and characters of XML 1.0.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace rois::xml {

struct BadCharacter {
    std::size_t offset;
    std::size_t length;  // in bytes; 1 if the bytes are not UTF-8
    std::string_view complaint;
};

// Returns the first place that is not UTF-8 or not a character of XML 1.0.
std::optional<BadCharacter> first_bad_character(std::string_view);

// Returns whether XML 1.0 allows this character.
bool is_character(char32_t);

}  // namespace rois::xml
