// A robot in the hall: its drive, its voice and the reactions that it shows.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/drive.hpp"
#include "simulation/person.hpp"
#include "simulation/voice_characters.hpp"

namespace rois::simulation {

// Names one utterance of one robot.
enum class UtteranceId : std::uint64_t {};

// Some of what a robot says, in one language, with one voice and one prosody.
struct Passage {
    std::string text;      // plain
    std::string language;  // ISO 639-1
    Seconds duration = 0;  // with its pauses
    std::string prosody;   // how the voice sounds, "pitch high, volume loud"; empty: as usual
    std::string character{default_character};

    bool operator==(Passage const&) const = default;
};

struct Utterance {
    std::string text;  // plain
    std::string language = "en";
    double loudness = 0.5;                     // 0 to 1: visitors hear 0.5 at 5 m
    std::optional<Seconds> duration;           // absent: speech_duration(text) at the pace of the character
    std::string prosody{};                     // of `text`, as a passage has it
    std::string character{default_character};  // of `text`: with which voice it is said
    std::vector<Passage> further{};            // said after it, each heard as speech of its own
};

enum class SpeechState : std::uint8_t {
    speaking,
    held,
    spoken,  // over, to its last word
    broken   // over, before its last word
};

// How long somebody speaks a text: by its characters, at least half a second. Scripts without spaces count more per character.
Seconds speech_duration(std::string_view text);
// The same of a part of a text, which may be shorter.
Seconds spoken_seconds(std::string_view text);

// What a robot shows at the moment.
struct Showing {
    std::string reaction;  // its code
    WorldTime ends{};
};

// As others see it. `drive` is reached through the Hall.
struct Robot {
    RobotId id{};
    std::string name;
    Pose pose;
    Twist twist;
    std::optional<Speech> speaking;  // absent while held
    std::optional<Showing> showing;
};

}  // namespace rois::simulation
