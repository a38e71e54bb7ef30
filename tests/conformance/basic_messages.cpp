#include "conformance/basic_messages.hpp"

#include <algorithm>

namespace rois::conformance {

namespace {

constexpr bool event = true, query = false;

TypedName const timestamp{"timestamp", "DateTime"}, number{"number", "int"}, positions{"position_data", "string[]"};

TypedName refs(std::string const& name) { return {name, "RoISIdentifier[]"}; }

BasicMessage detected(std::string const& what) {
    return {what + "detection", what + "_detected", event, {timestamp, number}, {}};
}

BasicMessage localized(std::string const& what) {
    return {what + "localization", what + "_localized", event, {timestamp, refs(what + "_ref"), positions}, {}};
}

}  // namespace

std::vector<BasicMessage> const& basic_messages() {
    static std::vector<BasicMessage> const all{
        {"systeminformation", "robot_position", query, {timestamp, positions}, {}},
        {"systeminformation", "engine_status", query, {{"status", "Component_Status"}}, {}},
        detected("person"),
        detected("face"),
        detected("sound"),
        localized("person"),
        localized("face"),
        localized("sound"),
        {"personidentification", "person_identified", event, {timestamp, refs("person_ref")}, {}},
        {"speechrecognition", "speech_recognized", event, {timestamp, {"recognized_text", "string[]"}}, {}},
        {"speechrecognition", "speech_input_started", event, {timestamp}, {}},
        {"speechrecognition", "speech_input_finished", event, {timestamp}, {}},
        {"speechrecognition", "get_parameter", query, {{"recognizable_languages", "string[]"}}, {{"languages", "string[]"}}},
        {"gesturerecognition", "gesture_recognized", event, {timestamp, refs("gesture_ref")}, {}},
        {"gesturerecognition", "get_parameter", query, {refs("recognizable_gestures")}, {}},
        {"reaction", "get_parameter", query, {refs("available_reactions")}, {{"reaction_ref", "RoISIdentifier"}}},
        {"navigation", "get_parameter", query, {}, {{"target_position", "string[]"}}},
        {"follow", "get_parameter", query, {}, {{"target_object_ref", "RoISIdentifier"}, {"distance", "int"}}}};
    return all;
}

BasicMessage const* basic_message(std::string const& kind, std::string const& name) {
    auto const& all = basic_messages();
    auto const found = std::ranges::find_if(all, [&](auto const& one) { return one.kind == kind && one.name == name; });
    return found == all.end() ? nullptr : &*found;
}

}  // namespace rois::conformance
