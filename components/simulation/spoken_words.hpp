// What is said, as words that can be compared: case (of ASCII letters), punctuation and the amount of white space do not count.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace rois::simulation {

// "green tea" of "Green  tea!".
std::string spoken_words(std::string_view text);

// One by one. Kana and Han characters are a word each, since nothing stands between their words.
std::vector<std::string> split_into_words(std::string_view text);

// How alike two words sound: 1 for the same, towards 0 the more of their letters differ.
double likeness(std::string_view a, std::string_view b);

}  // namespace rois::simulation
