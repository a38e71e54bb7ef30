// Reads W3C SSML 1.0 and 1.1 as far as the simulated voice needs it (7.6.11): the words, their languages and voices, how long
// they take, and how the voice is to sound.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "simulation/robot.hpp"

namespace rois::simulation {

// What is to be said, a passage for each change of language, voice and prosody; none when there is nothing. White space in it is
// collapsed. A passage has no language when the document says none for it.
struct SpokenText {
    std::vector<Passage> passages;
};

// Not well-formed, no SSML at all, or in a language that cannot be spoken: says what and where, "line 1, column 12: ...".
struct BadSsml {
    std::string reason;
};

// Honours `break` (time, strength; 60 s at most), `prosody` (rate; duration, 600 s at most; pitch, range, contour, volume),
// `emphasis` (by its pace), `sub`, `voice` (name, gender, age), and xml:lang with `onlangfailure` of any element; other elements,
// those of other namespaces among them, are skipped and what they hold is spoken, but for metadata and descriptions. A document
// without any namespace is taken for SSML. Document types and processing instructions are refused. An xml::Platform lives
// meanwhile. `character` is the voice of what is in no `voice`.
std::variant<SpokenText, BadSsml> read_ssml(std::string_view document, std::string_view character = default_character);

}  // namespace rois::simulation
