// A person in the hall: the state that others can observe.
#pragma once

#include <optional>
#include <string>

#include "simulation/scenario/scenario.hpp"
#include "simulation/world/entity.hpp"
#include "simulation/world/units.hpp"

namespace rois::simulation {

inline constexpr Metres person_radius = 0.25;

struct Speech {
    std::string text;
    std::string language;  // ISO 639-1
    WorldTime began{};
    WorldTime ends{};
    std::string character{};  // of the voice (basic/speech/voice_characters.hpp)
};

// A gesture in progress.
struct Gesturing {
    std::string id;
    WorldTime ends{};
};

struct Person {
    PersonId id{};
    std::string role;    // the permanent id, "tanaka"; internal for unknown people
    bool known = false;  // robots can learn `role` by identification
    Metres height = 1.68;
    Gender gender = Gender::not_known;
    std::optional<int> age;          // years
    Pose pose;                       // the heading of body and face
    Point velocity = Point::Zero();  // m/s in the hall's frame
    std::optional<Speech> speaking;
    std::optional<Gesturing> gesturing;

    Metres face_height() const { return height - 0.12; }
};

}  // namespace rois::simulation
