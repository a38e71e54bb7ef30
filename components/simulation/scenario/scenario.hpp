// Scenarios: the visitors of the hall and their actions. Plain values; scenario_file.hpp reads them from a file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "basic/body/perception.hpp"
#include "simulation/world/units.hpp"

namespace rois::simulation {

// A target to walk or look to: the name of a place or robot, or a point.
struct Whereabouts {
    std::variant<std::string, Point> at;
};

// The actions of a person, in order.
struct Walk {
    Whereabouts to;
};
struct Face {
    Whereabouts whom;  // the person looks at it until the next walk, face or ignore
};
struct Ignore {};  // from now on, the person neither looks at robots nor answers them
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
    std::optional<Seconds> at;  // earliest time after entering
};

// The reply of a person who looks at a robot to the robot's speech or reaction nearby.
struct Answer {
    std::string to;        // text in the robot's speech, ignoring case; "*": any speech; empty: see `reaction`
    std::string reaction;  // code of the robot's reaction; empty: see `to`
    std::string language;
    std::string text;     // may be empty
    std::string gesture;  // may be empty
    bool once = false;    // at most once a visit
};

using basic::Gender;

// One person of a scenario.
struct Role {
    std::string id;        // permanent, "tanaka"
    bool known = false;    // robots can identify the person
    std::string language;  // default of what they say, ISO 639-1
    Metres height = 1.68;
    MetresPerSecond speed = 1.1;
    Gender gender = Gender::not_known;
    std::optional<int> age;  // years
    std::vector<Answer> answers;
    Seconds enters = 0;  // after the start of the round
    std::vector<ScriptedAction> actions;
};

// Random visitors. The gap between two arrivals lies between the two times. None arrives while the hall holds `at_most` people.
struct Arrivals {
    Seconds gap_least = 20;
    Seconds gap_most = 50;
    std::size_t at_most = 5;
};

// A fault of a component for some world time.
struct Fault {
    enum class Kind : std::uint8_t {
        silent,       // accepts commands but does not begin them, does not answer queries
        failed,       // has the status ERROR; commands and queries fail
        complaining,  // works, but has the status WARNING; reports a USER_DEFINED_ERROR at the start
        unstoppable   // ignores `halt` and does not confirm it
    };

    std::string component;  // its ref
    Kind kind = Kind::silent;
    Seconds from = 0;
    std::optional<Seconds> until;  // absent: forever
};

struct Scenario {
    std::string name;
    std::vector<Fault> faults;
    std::vector<Role> roles;
    std::optional<Seconds> round;  // the roles repeat with this period; absent: once
    std::optional<Arrivals> arrivals;
};

}  // namespace rois::simulation
