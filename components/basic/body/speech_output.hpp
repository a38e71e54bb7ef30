// The voice of a body.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "basic/speech/passage.hpp"

namespace rois::basic {

// Names one utterance of one robot.
enum class UtteranceId : std::uint64_t {};

struct Utterance {
    std::vector<Passage> passages;  // one or more, spoken one after the other
    double loudness = 0.5;          // 0 to 1
};

enum class SpeechState : std::uint8_t {
    speaking,
    held,
    spoken,  // over: completed
    broken   // over: broken off before the last word
};

// Speaks one utterance at a time. A part of the body, which owns it. Not thread-safe: its functions are called one at a time with
// all others of the body (Body).
class SpeechOutput {
public:
    virtual ~SpeechOutput() = default;

    // Starts an utterance, and breaks off the previous one. It ends by itself.
    virtual UtteranceId speak(Utterance) = 0;

    // Returns the state of an utterance; `broken` for one that the body no longer knows.
    virtual SpeechState state(UtteranceId) const = 0;

    // End, suspend and resume the current utterance; ignored for any other utterance. Silence begins at once.
    virtual void break_off(UtteranceId) = 0;
    virtual void hold(UtteranceId) = 0;
    virtual void go_on(UtteranceId) = 0;

    // Returns the character of the voice that speaks now (voice_characters.hpp); nothing while silent or held.
    virtual std::optional<std::string> speaking() const = 0;
};

}  // namespace rois::basic
