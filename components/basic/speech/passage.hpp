// A part of spoken text, and how long speech takes.
#pragma once

#include <string>
#include <string_view>

#include "basic/body/pose.hpp"
#include "basic/speech/voice_characters.hpp"

namespace rois::basic {

// Text in one language, with one voice and one prosody.
struct Passage {
    std::string text;       // without markup
    std::string language;   // ISO 639-1
    Seconds duration = 0;   // with pauses
    std::string prosody{};  // "pitch high, volume loud"; empty: the default
    std::string character{default_character};

    bool operator==(Passage const&) const = default;
};

// Estimates how long a text takes to speak, from its characters; at least 0.5 s. Characters of scripts without spaces count more.
Seconds speech_duration(std::string_view text);
// The same for a part of a text, without the minimum.
Seconds spoken_seconds(std::string_view text);

}  // namespace rois::basic
