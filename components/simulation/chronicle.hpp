// What happened in the hall lately, for all who listen: several sensors read the same happenings, each at its own pace.
#pragma once

#include <cstdint>
#include <deque>
#include <ranges>
#include <string>

#include "simulation/entity.hpp"
#include "simulation/pose.hpp"

namespace rois::simulation {

struct Happening {
    enum class Kind : std::uint8_t {
        entered,          // a person came in
        left,             // a person went out
        speech_started,   // `text`, `language`
        speech_finished,  // the same, after its last word
        speech_broken,    // the same, ended before its last word
        gesture_made,     // `text` is the gesture's id; it begins now
        reaction_shown    // `text` is the code of the robot's reaction; it begins now
    };
    std::uint64_t sequence = 0;  // from 1, without gaps
    WorldTime at{};
    Kind kind{};
    Entity who;
    Point place = Point::Zero();  // where they were
    std::string text;
    std::string language;
    Seconds lasts = 0;        // speech_started of a robot: how long it takes when nothing holds it up
    std::string prosody;      // speech_started of a robot: how its voice sounds, as a passage has it
    std::string character{};  // speech_started of a robot: with which voice (voice_characters.hpp)
};

// Append only; keeps the last `capacity` happenings.
class Chronicle {
public:
    static constexpr std::size_t capacity = 4'096;

    void add(Happening);  // the sequence is given here

    // The sequence of the last one; 0 when nothing happened yet.
    std::uint64_t last() const { return last_; }

    // Those with a greater sequence, oldest first. Valid until the world steps or somebody speaks.
    auto since(std::uint64_t sequence) const {
        std::uint64_t first = last_ - happenings_.size();
        std::uint64_t skipped = sequence <= first ? 0 : std::min<std::uint64_t>(sequence - first, happenings_.size());
        return std::ranges::subrange(happenings_.begin() + static_cast<std::ptrdiff_t>(skipped), happenings_.end());
    }

private:
    std::deque<Happening> happenings_;
    std::uint64_t last_ = 0;
};

}  // namespace rois::simulation
