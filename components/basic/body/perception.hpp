// What a body senses of the people and robots around it. Poses are in the body's frame (Body::crs).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "basic/body/entity.hpp"
#include "basic/body/pose.hpp"

namespace rois::basic {

enum class Sense : std::uint8_t { people, faces, sounds };

// A measurement of a person, a face or the source of a sound.
struct Sighting {
    EntityId who{};
    std::string ref;    // the temporary name: "person-3", "face-3", "sound-3"
    Pose pose;          // the heading of a sound is the direction from the robot to its source
    Metres height = 0;  // of the measured point above the floor
    Covariance covariance = Covariance::Zero();
};

// Codes of ISO 5218.
enum class Gender : std::uint8_t { not_known = 0, male = 1, female = 2, not_applicable = 9 };

struct AgeRange {
    int lowest = 0;  // years
    int highest = 0;
};

// A person who is near enough and turned to the robot, so that the robot can identify them.
struct RecognizedPerson {
    EntityId who{};
    std::string track;              // the temporary name: "person-3"
    std::optional<std::string> id;  // the permanent id, if the person is known
    Gender gender = Gender::not_known;
    std::optional<AgeRange> age{};  // an estimate
};

// The beginning or end of speech near the robot, by a person or another robot.
struct SpeechEvent {
    enum class Kind : std::uint8_t {
        began,  // within hearing range
        ended,  // within hearing range, after its last word: `text`, `language`
        lost    // broken off, or ended out of hearing range
    };
    std::uint64_t sequence = 0;
    Kind kind{};
    EntityId speaker{};
    Point place = Point::Zero();  // of the speaker
    std::string text{};
    std::string language{};            // ISO 639-1
    std::optional<Sighting> source{};  // of `began`: the measured source, if the robot can locate it
};

// A part of the body, which owns it. Not thread-safe: its functions are called one at a time with all others of the body (Body).
//
// The measurements are the same for all calls between two notifications of the body's observers. Speech and gestures are kept for
// some time. Each component reads them at its own pace: it remembers last_sequence(), and asks later for newer
// speech and gestures.
class Perception {
public:
    virtual ~Perception() = default;

    // The current measurements, nearest first.
    virtual std::vector<Sighting> sightings(Sense) const = 0;

    // The standard deviation of the sensor's noise, for each axis.
    virtual Metres sigma(Sense) const = 0;

    virtual std::vector<RecognizedPerson> recognized() const = 0;

    // Returns the person or robot that a reference of a service application means: a robot's name, a temporary name, or the
    // permanent id of an identified person. `codebook` limits the kinds of names (codebooks.hpp); empty: all names. Returns
    // nothing if the robot perceives no person or robot of that name now.
    virtual std::optional<EntityId> find(std::string_view ref, std::string_view codebook) const = 0;

    // Returns whether `ref` is, was or may become the name of a person or robot.
    virtual bool knows(std::string_view ref) const = 0;

    // The greatest sequence number so far; 0 at first. Sequence numbers increase, perhaps with gaps.
    virtual std::uint64_t last_sequence() const = 0;

    // Return the speech and the gestures (gestures() in reaction_types.hpp) of others with a greater sequence number, oldest
    // first.
    virtual std::vector<SpeechEvent> speech_since(std::uint64_t sequence) const = 0;
    virtual std::vector<std::string> gestures_since(std::uint64_t sequence) const = 0;
};

}  // namespace rois::basic
