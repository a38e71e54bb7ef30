// The voices with which a robot can speak: the values of `character` (table 44).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rois::simulation {

struct VoiceCharacter {
    std::string_view name;
    double pitch;  // Hz
    double pace;   // how fast it speaks: 1 is the default voice's
};

inline constexpr std::string_view default_character = "default";

// All of them; the first one is the default.
std::span<VoiceCharacter const> voice_characters();

// Null when there is none of this name.
VoiceCharacter const* find_voice_character(std::string_view name);

// The character of that name, or the default one.
VoiceCharacter const& voice_character(std::string_view name);

std::vector<std::string> names_of_voice_characters();

}  // namespace rois::simulation
