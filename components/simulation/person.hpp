// A person in the hall, as everybody can see them.
#pragma once

#include <optional>
#include <string>

#include "simulation/entity.hpp"
#include "simulation/pose.hpp"
#include "simulation/scenario.hpp"

namespace rois::simulation {

inline constexpr Metres person_radius = 0.25;

struct Speech {
    std::string text;
    std::string language;  // ISO 639-1
    WorldTime began{};
    WorldTime ends{};
    std::string character{};  // of a robot's voice (voice_characters.hpp); a person has none
};

// A gesture being made.
struct Gesturing {
    std::string id;
    WorldTime ends{};
};

struct Person {
    PersonId id{};
    std::string role;    // the permanent id, "tanaka"; for unknown ones only the scenario's or the arrivals' name of them
    bool known = false;  // robots may learn `role` by identification
    Metres height = 1.68;
    Gender gender = Gender::not_known;
    std::optional<int> age;          // years; what a robot makes of it is only near
    Pose pose;                       // heading: where body and face look
    Point velocity = Point::Zero();  // m/s in the hall's frame
    std::optional<Speech> speaking;
    std::optional<Gesturing> gesturing;

    Metres face_height() const { return height - 0.12; }
};

}  // namespace rois::simulation
