// A robot in the hall: its utterances, its reactions and its observable state.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/robot/drive.hpp"
#include "simulation/robot/voice_characters.hpp"
#include "simulation/world/person.hpp"

namespace rois::simulation {

// Names one utterance of one robot.
enum class UtteranceId : std::uint64_t {};

// A part of an utterance in one language, with one voice and one prosody.
struct Passage {
    std::string text;      // without markup
    std::string language;  // ISO 639-1
    Seconds duration = 0;  // with pauses
    std::string prosody;   // "pitch high, volume loud"; empty: the default
    std::string character{default_character};

    bool operator==(Passage const&) const = default;
};

struct Utterance {
    std::string text;  // without markup
    std::string language = "en";
    double loudness = 0.5;                     // 0 to 1; 0.5 reaches visitors within 5 m
    std::optional<Seconds> duration;           // absent: speech_duration(text) at the pace of the character
    std::string prosody{};                     // of `text`, as in Passage
    std::string character{default_character};  // the voice of `text`
    std::vector<Passage> further{};            // spoken after `text`, each as separate speech
};

enum class SpeechState : std::uint8_t {
    speaking,
    held,
    spoken,  // over: completed
    broken   // over: broken off before the last word
};

// Estimates how long a text takes to speak, from its characters; at least 0.5 s. Characters of scripts without spaces count more.
Seconds speech_duration(std::string_view text);
// The same for a part of a text, without the minimum.
Seconds spoken_seconds(std::string_view text);

// A reaction in progress.
struct Showing {
    std::string reaction;  // its code
    WorldTime ends{};
};

// The observable state of a robot. Hall::drive() returns its drive.
struct Robot {
    RobotId id{};
    std::string name;
    Pose pose;
    Twist twist;
    std::optional<Speech> speaking;  // absent while held
    std::optional<Showing> showing;
};

}  // namespace rois::simulation
