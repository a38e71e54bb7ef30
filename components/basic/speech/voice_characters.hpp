// The voices of robots: the values of `character` (table 44).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rois::basic {

struct VoiceCharacter {
    std::string_view name;
    double pitch;  // Hz
    double pace;   // speed relative to the default voice
};

inline constexpr std::string_view default_character = "default";

// All voices; the first one is the default.
std::span<VoiceCharacter const> voice_characters();

// Returns null if the name is unknown.
VoiceCharacter const* find_voice_character(std::string_view name);

// Returns the voice of that name, or the default one.
VoiceCharacter const& voice_character(std::string_view name);

std::vector<std::string> names_of_voice_characters();

}  // namespace rois::basic
