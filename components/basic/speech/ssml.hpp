// Reads W3C SSML 1.0 and 1.1 (7.6.11): words, languages, voices, durations and prosody.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "basic/speech/passage.hpp"

namespace rois::basic {

// The passages of a document: a new one begins where language, voice or prosody changes. White space is collapsed. A passage
// without xml:lang has no language.
struct SpokenText {
    std::vector<Passage> passages;
};

// Why the document is invalid, with the place: "line 1, column 12: ...".
struct BadSsml {
    std::string reason;
};

// Supports `break` (time, strength; at most 60 s), `prosody` (rate; duration, at most 600 s; pitch, range, contour, volume),
// `emphasis` (as pace), `sub`, `voice` (name, gender, age), and xml:lang with `onlangfailure` on any element. Ignores the tags of
// other elements but speaks their content, except metadata and descriptions. A document without namespace counts as SSML. Rejects
// document types and processing instructions. `character` is the voice outside of `voice` elements. Needs a living xml::Platform.
std::variant<SpokenText, BadSsml> read_ssml(std::string_view document, std::string_view character = default_character);

}  // namespace rois::basic
