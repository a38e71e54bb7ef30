// Base of the speech recognition components. Collects the speech of people and other robots near the robot.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "basic/base/robot_component.hpp"

namespace rois::basic {

// Speech that the robot received from beginning to end.
struct HeardSpeech {
    std::string text;
    std::string language;
    Instant began;
    std::optional<Sighting> source;  // when the speech began
};

class Listening : public ContinuousFunction {
public:
    using ContinuousFunction::ContinuousFunction;

protected:
    // Whether the component recognizes speech from this point.
    virtual bool listens_to(Point const&) const { return true; }

    // Called when speech begins, and when it ends (also if it was broken off or left the hearing range).
    virtual void began(Instant when) = 0;
    virtual void ended(Instant when) = 0;
    // Called after ended() if the whole speech was received.
    virtual void heard(HeardSpeech const&, Instant when) = 0;

private:
    void begin() final;
    void suspended() final;
    void resumed() final;
    void sense(Instant when) final;
    void begins(SpeechEvent, Instant when);
    void ends(SpeechEvent, Instant when);

    // An utterance in progress.
    struct Input {
        bool whole = true;
        Instant began;
        std::optional<Sighting> source;
    };
    std::map<EntityId, Input> inputs_;  // after began(), by speaker
    std::uint64_t read_ = 0;
    std::uint64_t missed_until_ = 0;  // ignores speech that began at or before this sequence
};

}  // namespace rois::basic
