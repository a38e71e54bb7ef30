// What recognizers of speech have in common: they follow what people and other robots say near the robot from its beginning to
// its end.
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "simulation/robot_component.hpp"
#include "simulation/senses.hpp"

namespace rois::simulation {

// Speech that was heard from beginning to end.
struct HeardSpeech {
    std::string text;
    std::string language;
    Instant began;
    std::optional<HeardSound> from;  // where it was heard from when it began
};

class Listening : public ContinuousFunction {
public:
    using ContinuousFunction::ContinuousFunction;

protected:
    // Whether speech from there counts; all that the robot hears, unless a component says otherwise.
    virtual bool listens_to(Point const&) const { return true; }

    // Somebody has begun to speak, or has ended, perhaps too early or out of earshot.
    virtual void began(Instant when) = 0;
    virtual void ended(Instant when) = 0;
    virtual void heard(HeardSpeech const&, Instant when) = 0;

private:
    void begin() final;
    void suspended() final;
    void resumed() final;
    void sense(Instant when) final;
    void begins(Happening const& speech, Instant when);
    void ends(Happening const& speech, Instant when);

    // An utterance that has begun.
    struct Input {
        bool whole = true;
        Instant began;
        std::optional<HeardSound> from;
    };
    std::map<Entity, Input> inputs_;  // whose beginning was told
    std::uint64_t read_ = 0;
    std::uint64_t missed_until_ = 0;  // what began by then was not heard
};

}  // namespace rois::simulation
