// Reading W3C SSML as far as a voice without prosody of its own needs it (7.6.11): the words, the pauses and the pace.
#pragma once

#include <string>
#include <string_view>
#include <variant>

#include "simulation/pose.hpp"

namespace rois::simulation {

struct SpokenText {
    std::string text;      // plain, white space collapsed
    std::string language;  // of the document's xml:lang, without its region ("en" of "en-US"); empty when it has none
    double stretch = 1;    // how much longer than at a usual pace the text takes
    Seconds pauses = 0;    // to be added
};

// Not well-formed, or no SSML at all: says what and where, "line 1, column 12: ...".
struct BadSsml {
    std::string reason;
};

// Honours `break` (time, strength; 60 s at most), the rate of `prosody`, `sub` and xml:lang of the root; other elements are
// skipped and what they hold is spoken, but for metadata and descriptions. Document types, entities beyond the five of XML and
// processing instructions are refused.
std::variant<SpokenText, BadSsml> read_ssml(std::string_view document);

}  // namespace rois::simulation
