// The parameters of the 17 components, with the names of the specification and types with units. A parameter that is not set
// keeps its value. Set them one by one, also inside a co_await:
//
//     co_await synthesis.say(Speech().with_speech_text("Welcome.").with_volume(50));
//
// None of these classes is an aggregate: inside a co_await, g++ 12 silently destroys an aggregate made in braces twice.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "rois/units.hpp"
#include "types/values.hpp"

namespace rois {

using Milliseconds = std::chrono::milliseconds;

// How far a person or object must have moved for a new event, and the shortest time between two events.
//
//     co_await localization.set(LocalizationParameters().with_detection_threshold(0.5_m).with_minimum_interval(1s));
struct LocalizationParameters {
    LocalizationParameters() = default;
    LocalizationParameters with_detection_threshold(millimetres length) && {
        detection_threshold = length;
        return *this;
    }
    LocalizationParameters with_minimum_interval(Milliseconds time) && {
        minimum_interval = time;
        return *this;
    }

    std::optional<millimetres> detection_threshold{};
    std::optional<Milliseconds> minimum_interval{};
};

//     co_await recognition.set(SpeechRecognitionParameters().with_language("en").with_language("ja"));
struct SpeechRecognitionParameters {
    SpeechRecognitionParameters() = default;
    SpeechRecognitionParameters with_language(std::string code) && {  // adds a language
        languages.push_back(std::move(code));
        return std::move(*this);
    }
    SpeechRecognitionParameters with_grammar(std::string text) && {
        grammar = std::move(text);
        return std::move(*this);
    }
    SpeechRecognitionParameters with_rule(std::string name) && {
        rule = std::move(name);
        return std::move(*this);
    }

    std::vector<std::string> languages{};  // ISO 639-1; empty: not set
    std::optional<std::string> grammar{};
    std::optional<std::string> rule{};
    std::vector<std::string> recognizable_languages{};  // read only
};

// Plain text, or W3C SSML.
//
//     co_await synthesis.say(Speech().with_speech_text("Willkommen.").with_language("de"));
struct Speech {
    Speech() = default;
    Speech with_speech_text(std::string text) && {
        speech_text = std::move(text);
        return std::move(*this);
    }
    Speech with_SSML_text(std::string text) && {
        SSML_text = std::move(text);
        return std::move(*this);
    }
    Speech with_volume(int level) && {
        volume = level;
        return std::move(*this);
    }
    Speech with_language(std::string code) && {
        language = std::move(code);
        return std::move(*this);
    }
    Speech with_character(std::string name) && {
        character = std::move(name);
        return std::move(*this);
    }

    std::optional<std::string> speech_text{};
    std::optional<std::string> SSML_text{};
    std::optional<int> volume{};
    std::optional<std::string> language{};  // ISO 639-1
    std::optional<std::string> character{};
    std::vector<std::string> synthesizable_languages{};   // read only
    std::vector<std::string> synthesizable_characters{};  // read only
};

enum class RoutingPolicy : std::uint8_t { time, distance };

// A target of Navigation: a pose, or the name of a place that the engine knows.
struct Target {
    Target(Pose const&);
    Target(std::string place) : text{std::move(place)} {}
    Target(char const* place) : text{place} {}
    std::string text{};
    std::string crs{};  // frame of a pose; the engine uses that of the first target for all
};

//     co_await navigation.go(NavigationParameters().with_target_position("lift").with_target_position(Pose(4_m, 7_m)));
struct NavigationParameters {
    NavigationParameters() = default;
    NavigationParameters with_target_position(Target target) && {  // adds a target at the end
        target_position.push_back(std::move(target));
        return std::move(*this);
    }
    NavigationParameters with_time_limit(Milliseconds time) && {
        time_limit = time;
        return std::move(*this);
    }
    NavigationParameters with_routing_policy(RoutingPolicy policy) && {
        routing_policy = policy;
        return std::move(*this);
    }

    std::vector<Target> target_position{};     // in order; empty: not set
    std::optional<Milliseconds> time_limit{};  // 0: none
    std::optional<RoutingPolicy> routing_policy{};
};

//     co_await follow.follow(FollowParameters().with_target_object_ref(person).with_distance(1_m).with_time_limit(30s));
struct FollowParameters {
    FollowParameters() = default;
    FollowParameters with_target_object_ref(Identifier const& ref) && {
        target_object_ref = ref;
        return std::move(*this);
    }
    FollowParameters with_target_object_ref(std::string code) && {
        target_object_ref.emplace().code = std::move(code);
        return std::move(*this);
    }
    FollowParameters with_distance(millimetres length) && {
        distance = length;
        return std::move(*this);
    }
    FollowParameters with_time_limit(Milliseconds time) && {
        time_limit = time;
        return std::move(*this);
    }

    std::optional<Identifier> target_object_ref{};
    std::optional<millimetres> distance{};     // the robot waits while it is closer
    std::optional<Milliseconds> time_limit{};  // 0: none
};

// Turns on the spot by `direction`, then drives `distance` straight along the new heading.
struct Line {
    millimetres distance{};  // backwards when negative
    degrees direction{};     // relative to the heading before; to the left when positive
};

// Drives along a circle until the heading has changed by `direction`.
struct Curve {
    millimetres radius{};  // backwards when negative; 0 turns on the spot
    degrees direction{};   // positive: a left turn, with the centre on the left (on the right if `radius` is negative)
};

//     co_await move.set(MoveParameters().with_line(Line{1_m, 90_deg}).with_time(2s));
struct MoveParameters {
    MoveParameters() = default;
    MoveParameters with_line(Line motion) && {
        line = motion;
        return *this;
    }
    MoveParameters with_curve(Curve motion) && {
        curve = motion;
        return *this;
    }
    MoveParameters with_time(Milliseconds duration) && {
        time = duration;
        return *this;
    }

    std::optional<Line> line{};
    std::optional<Curve> curve{};
    std::optional<Milliseconds> time{};  // how long the motion takes
};

//     co_await streaming.set(StreamParameters().with_transport_parameters("http"));
struct StreamParameters {
    StreamParameters() = default;
    StreamParameters with_encoding_parameters(std::string text) && {
        encoding_parameters = std::move(text);
        return std::move(*this);
    }
    StreamParameters with_transport_parameters(std::string text) && {
        transport_parameters = std::move(text);
        return std::move(*this);
    }

    std::optional<std::string> encoding_parameters{};
    std::optional<std::string> transport_parameters{};
    std::string available_encodings{};   // read only
    std::string available_transports{};  // read only
};

}  // namespace rois
