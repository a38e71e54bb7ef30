#include "types/identifier_length.hpp"

#include <algorithm>

#include "types/texts.hpp"

namespace rois {

std::optional<std::string> why_too_long(std::string_view what, std::string_view text) {
    if (text.size() <= longest_identifier) return {};
    auto const begins_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
    auto const characters = static_cast<std::size_t>(std::ranges::count_if(text, begins_character));
    if (characters <= longest_identifier) return {};
    return std::string{what} + " " + quoted(text) + " has " + std::to_string(characters) + " characters: expected " +
           std::to_string(longest_identifier) + " at most";
}

}  // namespace rois
