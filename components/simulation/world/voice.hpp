// The voice of a person or robot. It speaks one utterance at a time, which ends by itself.
#pragma once

#include <deque>
#include <optional>
#include <utility>

#include "basic/body/speech_output.hpp"
#include "simulation/world/chronicle.hpp"
#include "simulation/world/person.hpp"

namespace rois::simulation {

using basic::Passage;
using basic::SpeechState;
using basic::Utterance;
using basic::UtteranceId;

class Voice {
public:
    explicit Voice(Entity speaker) : speaker_(speaker) {}

    // `place` is the speaker's position. Every start and end of speech is added to the chronicle.
    UtteranceId speak(Utterance, WorldTime now, Point const& place, Chronicle&);
    SpeechState state(UtteranceId) const;
    void break_off(UtteranceId, WorldTime now, Point const& place, Chronicle&);
    void hold(UtteranceId, WorldTime now);
    void go_on(UtteranceId, WorldTime now);

    // Advances to `now`: begins the next passage, or ends the utterance.
    void step(WorldTime now, Point const& place, Chronicle&);

    // The current speech; nothing while held or silent.
    std::optional<Speech> speech() const;
    double loudness() const { return loudness_; }  // of the last utterance

private:
    void begin_passage(WorldTime now, Point const& place, Chronicle&);
    void finish(SpeechState, WorldTime now, Point const& place, Chronicle&);

    Entity speaker_;
    UtteranceId last_{};
    SpeechState state_ = SpeechState::spoken;
    Speech speech_;
    std::deque<Passage> further_;  // the passages of the last utterance that have not begun
    WorldTime left_when_held_{};
    double loudness_ = 0.5;
    std::deque<std::pair<UtteranceId, SpeechState>> ended_;  // the last few
};

}  // namespace rois::simulation
