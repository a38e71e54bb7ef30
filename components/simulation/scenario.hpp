// Who comes into the hall and what they do there. Plain values; read from a file by scenario_file.hpp.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "simulation/pose.hpp"

namespace rois::simulation {

// The gestures that visitors make and robots know: codes of the codebook "urn:x-rois:def:codebook:simulation::gesture".
std::span<std::string_view const> gestures();

// Where somebody walks or looks: the name of a place or robot, or a point.
struct Whereabouts {
    std::variant<std::string, Point> at;
};

// The actions of a person, done one after the other.
struct Walk {
    Whereabouts to;
};
struct Face {
    Whereabouts whom;  // stays so until the next walk, face or ignore
};
struct Ignore {};  // looks at no robot and answers to none from now on
struct Say {
    std::string language;  // ISO 639-1
    std::string text;
};
struct Gesture {
    std::string id;
};
struct Wait {
    Seconds duration;
};
struct Wander {
    Seconds duration;
};
struct Leave {};

struct ScriptedAction {
    std::variant<Walk, Face, Ignore, Say, Gesture, Wait, Wander, Leave> what;
    std::optional<Seconds> at;  // not before this time after coming in
};

// What a person who looks at a robot does when it has spoken or shown a reaction nearby.
struct Answer {
    std::string to;  // words that the robot's speech holds, without regard to case; "*" is any speech; empty: see `reaction`
    std::string reaction;  // the reaction's code; empty: see `to`
    std::string language;
    std::string text;     // may be empty
    std::string gesture;  // may be empty
    bool once = false;    // at most once a visit
};

// Codes of ISO 5218.
enum class Gender : std::uint8_t { not_known = 0, male = 1, female = 2, not_applicable = 9 };

// One person of a scenario.
struct Role {
    std::string id;        // permanent; "tanaka"
    bool known = false;    // the robots can identify them by `id`
    std::string language;  // of what they say, ISO 639-1
    Metres height = 1.68;
    MetresPerSecond speed = 1.1;
    Gender gender = Gender::not_known;
    std::optional<int> age;  // years
    std::vector<Answer> answers;
    Seconds enters = 0;  // after the beginning of the round
    std::vector<ScriptedAction> actions;
};

// Visitors who come by themselves, drawn from the seed. Every gap between two of them lies between the two times; nobody comes
// while the hall holds `at_most` people.
struct Arrivals {
    Seconds gap_least = 20;
    Seconds gap_most = 50;
    std::size_t at_most = 5;
};

// Something wrong with a component for some time of the world, whatever people do.
struct Fault {
    enum class Kind : std::uint8_t {
        silent,      // takes commands and begins none, answers no query
        failed,      // its status is ERROR, and whatever it is asked or told ends with an error
        complaining,  // works, but its status is WARNING, and it tells a USER_DEFINED_ERROR when that begins
        unstoppable   // what it does goes on when it is told to halt, and no halt is confirmed
    };

    std::string component;  // its ref
    Kind kind = Kind::silent;
    Seconds from = 0;
    std::optional<Seconds> until;  // absent: for ever
};

struct Scenario {
    std::string name;
    std::vector<Fault> faults;
    std::vector<Role> roles;
    std::optional<Seconds> round;  // the roles begin anew after this time, for ever; absent: once
    std::optional<Arrivals> arrivals;
};

}  // namespace rois::simulation
