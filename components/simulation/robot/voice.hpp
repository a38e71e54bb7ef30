// The voice of one robot. It speaks one utterance at a time, which ends by itself.
#pragma once

#include <deque>
#include <string>
#include <utility>

#include "simulation/robot/robot.hpp"
#include "simulation/world/chronicle.hpp"

namespace rois::simulation {

class Voice {
public:
    explicit Voice(RobotId robot) : robot_(robot) {}

    // `place` is the robot's position. Every start and end of speech is added to the chronicle.
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
    void begin(Passage, WorldTime now, Point const& place, Chronicle&);
    void finish(SpeechState, WorldTime now, Point const& place, Chronicle&);

    RobotId robot_;
    UtteranceId last_{};
    SpeechState state_ = SpeechState::spoken;
    Speech speech_;
    std::deque<Passage> further_;  // remaining passages of the last utterance
    WorldTime left_when_held_{};
    double loudness_ = 0.5;
    std::deque<std::pair<UtteranceId, SpeechState>> ended_;  // the last few
};

}  // namespace rois::simulation
