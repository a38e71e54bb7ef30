#include "basic/speech/voice_characters.hpp"

#include <algorithm>
#include <array>

namespace rois::basic {

std::span<VoiceCharacter const> voice_characters() {
    static constexpr std::array<VoiceCharacter, 5> all{{{.name = default_character, .pitch = 165, .pace = 1},
                                                        {.name = "female", .pitch = 210, .pace = 1.1},
                                                        {.name = "male", .pitch = 120, .pace = 0.9},
                                                        {.name = "child", .pitch = 300, .pace = 1.2},
                                                        {.name = "robot", .pitch = 90, .pace = 0.8}}};
    return all;
}

VoiceCharacter const* find_voice_character(std::string_view name) {
    auto const all = voice_characters();
    auto const found = std::ranges::find(all, name, &VoiceCharacter::name);
    return found == all.end() ? nullptr : &*found;
}

VoiceCharacter const& voice_character(std::string_view name) {
    auto const* const found = find_voice_character(name);
    return found == nullptr ? voice_characters().front() : *found;
}

std::vector<std::string> names_of_voice_characters() {
    std::vector<std::string> names;
    for (auto const& character : voice_characters()) names.emplace_back(character.name);
    return names;
}

}  // namespace rois::basic
