// The log of recent events in the hall. Each sensor reads it at its own pace, by sequence number.
#pragma once

#include <cstdint>
#include <deque>
#include <ranges>
#include <string>

#include "simulation/world/entity.hpp"
#include "simulation/world/units.hpp"

namespace rois::simulation {

struct Happening {
    enum class Kind : std::uint8_t {
        entered,          // a person came in
        left,             // a person went out
        speech_started,   // `text`, `language`
        speech_finished,  // after the last word of `text`
        speech_broken,    // ended before its last word
        gesture_made,     // `text` is the gesture's id; it begins now
        reaction_shown    // `text` is the code of the robot's reaction; it begins now
    };
    std::uint64_t sequence = 0;  // from 1, without gaps
    WorldTime at{};
    Kind kind{};
    Entity who;
    Point place = Point::Zero();  // of `who` at that time
    std::string text;
    std::string language;
    // Only for speech_started:
    Seconds lasts = 0;        // duration without interruptions
    std::string prosody;      // as in Passage
    std::string character{};  // the voice (basic/speech/voice_characters.hpp)
};

// Append only; keeps the last `capacity` entries.
class Chronicle {
public:
    static constexpr std::size_t capacity = 4'096;

    void add(Happening);  // assigns the sequence

    // The sequence of the last entry; 0 if there is none.
    std::uint64_t last() const { return last_; }

    // Returns the entries with a greater sequence, oldest first. Valid until the next add().
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
