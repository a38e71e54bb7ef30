// Normalizes speech for comparison: ignores the case of ASCII letters, punctuation and the amount of white space.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rois::basic {

// Returns "green tea" for "Green  tea!".
std::string spoken_words(std::string_view text);

// Splits normalized text into words. Each kana or Han character is a word, since those scripts have no spaces.
std::vector<std::string> split_into_words(std::string_view text);

// The similarity of two words: 1 if equal, lower the more letters differ.
double likeness(std::string_view a, std::string_view b);

}  // namespace rois::basic
