// The methods of every component that is free (7.6, tables 31 to 47): the common commands, `start` with what it needs, and its
// events.
#include <algorithm>

#include "conformance/basic_messages.hpp"
#include "conformance/stage.hpp"

namespace rois::conformance {

namespace {

// What `start` of a basic component needs; nothing when that cannot be known here.
std::optional<std::vector<Argument>> arguments_of_start(Guest& guest, Component const& component) {
    auto const kind = component.basic();
    if (kind == "speechsynthesis") return {{spoken(component, "Hi.")}};
    if (kind == "move")
        return {{component.parameter_named("line") ? straight_on(component, 10) : argument(component, "curve", {"10 10"})}};
    if (kind == "follow") {
        auto const robot = guest.robot_of(component);
        if (!robot) return {};
        return {{argument(component, "target_object_ref", {robot->ref}), argument(component, "distance", {"1000"})}};
    }
    if (kind == "navigation") {
        auto const robot = guest.robot_of(component);
        if (!robot) return {};
        return {{argument(component, "target_position", {robot->position})}};
    }
    if (kind == "reaction") {
        auto const parameters = guest.get_parameter(component.ref).values("parameters");
        auto const reactions = parameters.find("available_reactions");
        if (reactions == parameters.end() || reactions->second.empty()) return {};
        return {{argument(component, "reaction_ref", {reactions->second.front()})}};
    }
    if (kind.empty()) return {};
    return std::vector<Argument>{};
}

bool is_completed_status(std::string const& status) {
    static std::vector<std::string> const all{"OK", "ERROR", "ABORT", "OUT_OF_RESOURCES", "TIMEOUT"};
    return std::ranges::find(all, status) != all.end();
}

// Each free component, bound by the guest; NotPlayed when none was.
void with_each(Stage& stage, Guest& guest, void (*play)(Guest&, Component const&)) {
    bool played = false;
    for (auto const& component : stage.catalogue().components) {
        if (guest.bind(component.ref).return_code() != "OK") continue;
        {
            Keeping const keeping{guest, component};
            play(guest, component);
        }
        ok(guest.release(component.ref));
        played = true;
    }
    if (!played) throw NotPlayed{"other applications use all components"};
}

void start_and_stop(Guest& guest, Component const& component) {
    if (!component.is_common) return;
    auto const arguments = arguments_of_start(guest, component);
    if (!arguments) return;
    auto const answer = guest.execute({.component = component.ref, .arguments = *arguments});
    if (answer.return_code() == "BAD_PARAMETER" && component.basic() == "follow") return;  // the target is the application itself
    auto const start = first("a command in the answer", kit::command_ids(ok(answer)));
    auto const stop = guest.order(command(component, "stop"));
    same("the status of stop of " + component.ref, "OK", guest.status_of(stop));
    guest.settle(component);
    auto const endings = guest.endings(start);
    require(endings.size() == 1 && is_completed_status(endings.front()),
            "start of " + component.ref + " should complete once, and did with " + list(endings));
}

void common_commands(Guest& guest, Component const& component) {
    if (!component.is_common) return;
    same("the status of stop of " + component.ref, "OK", guest.ending(command(component, "stop")));
    same("the status of suspend of " + component.ref, "ERROR", guest.ending(command(component, "suspend")));
    same("the status of resume of " + component.ref, "ERROR", guest.ending(command(component, "resume")));
}

void hold_and_go_on(Guest& guest, Component const& component) {
    if (!component.is_function()) return;
    if (guest.ending(command(component, "start")) != "OK") return;  // a component that has failed
    auto const ends = [&](char const* type, char const* when, char const* status) {
        same(std::string{"the status of "} + type + " of " + component.ref + when, status,
             guest.ending(command(component, type)));
    };
    ends("suspend", "", "OK");
    ends("suspend", " again", "ERROR");
    ends("resume", "", "OK");
    ends("resume", " again", "ERROR");
    ends("stop", "", "OK");
    ends("suspend", " after stop", "ERROR");
    if (guest.ending(command(component, "start")) != "OK") return;
    ok(guest.release(component.ref));
    if (guest.bind(component.ref).return_code() != "OK") return;
    ends("suspend", " after release", "ERROR");
}

// Without people, only this is observable: get_parameter returns the set values.
void parameters_set_and_read(Guest& guest, Component const& component) {
    auto const read = guest.get_parameter(component.ref);
    if (read.return_code() != "OK" || component.parameters.empty()) return;
    auto const values = read.values("parameters");
    std::vector<Argument> same_again;
    for (auto const& parameter : component.parameters)
        if (auto const found = values.find(parameter.name);
            found != values.end() && !found->second.empty() && component.can_set(parameter))
            same_again.push_back({parameter.name, parameter.type, found->second});
    same("set_parameter with the values read from " + component.ref, "OK",
         guest.status_of(ok(guest.set_parameter(component.ref, same_again)).text("command_id")));
    require(ok(guest.get_parameter(component.ref)).values("parameters") == values,
            "the parameters of " + component.ref + " changed when they were set to what they are");
}

void every_component_starts_and_stops(Stage& stage) {
    Guest guest{stage};
    for (auto const& component : stage.catalogue().components)
        for (auto const& event : component.events) ok(guest.subscribe(event.name, only(component), true));
    with_each(stage, guest, start_and_stop);
}

void every_component_knows_the_common_commands(Stage& stage) {
    Guest guest{stage};
    with_each(stage, guest, common_commands);
}

void every_function_can_be_suspended(Stage& stage) {
    Guest guest{stage};
    with_each(stage, guest, hold_and_go_on);
}

void every_parameter_can_be_set_to_what_it_is(Stage& stage) {
    Guest guest{stage};
    with_each(stage, guest, parameters_set_and_read);
}

// Those that the tables name; the profile may have more.
void basic_components_have_their_messages(Stage& stage) {
    using Names = std::vector<std::string>;
    static std::map<std::string, std::pair<Names, Names>> const tables{
        // queries, events
        {"systeminformation", {{"robot_position", "engine_status"}, {}}},
        {"persondetection", {{}, {"person_detected"}}},
        {"personlocalization", {{}, {"person_localized"}}},
        {"personidentification", {{}, {"person_identified"}}},
        {"facedetection", {{}, {"face_detected"}}},
        {"facelocalization", {{}, {"face_localized"}}},
        {"sounddetection", {{}, {"sound_detected"}}},
        {"soundlocalization", {{}, {"sound_localized"}}},
        {"speechrecognition", {{}, {"speech_recognized", "speech_input_started", "speech_input_finished"}}},
        {"gesturerecognition", {{}, {"gesture_recognized"}}},
        {"audiostreaming", {{"get_stream_status"}, {"notify_stream_status"}}},
        {"videostreaming", {{"get_stream_status"}, {"notify_stream_status"}}}};
    auto const has = [](std::vector<Message> const& messages, std::string const& name) {
        return std::ranges::find(messages, name, &Message::name) != messages.end();
    };
    for (auto const& component : stage.catalogue().components) {
        if (component.basic().empty()) continue;
        require(component.has_common || component.basic() == "systeminformation",
                component.ref + " lacks the parts common to all components (table 32)");
        auto const found = tables.find(component.basic());
        if (found == tables.end()) continue;
        for (auto const& query : found->second.first)
            require(has(component.queries, query), component.ref + " has no query " + query);
        for (auto const& event : found->second.second)
            require(has(component.events, event), component.ref + " has no event " + event);
    }
}

void basic_messages_have_their_results(Stage& stage) {
    for (auto const& component : stage.catalogue().components) {
        for (auto const& basic : basic_messages()) {
            if (component.basic() != basic.kind) continue;
            auto const* const message = basic.is_event ? component.event(basic.name) : component.query(basic.name);
            require(message != nullptr, component.ref + " has no " + (basic.is_event ? "event " : "query ") + basic.name);
            for (auto const* const due : {&basic.results, &basic.settable})
                for (auto const& result : *due) {
                    auto const found = std::ranges::find(message->results, result.name, &TypedName::name);
                    require(found != message->results.end(),
                            basic.name + " of " + component.ref + " has no result " + result.name + " in its profile");
                    require(is_same_type(found->type, result.type), result.name + " of " + basic.name + " of " + component.ref +
                                                                        " should be of the type " + result.type + ", and is of " +
                                                                        found->type);
                }
        }
    }
}

// The mandatory ones. Of conditional ones, which exclude each other, there is one at least.
void basic_components_have_their_parameters(Stage& stage) {
    using Alternatives = std::vector<std::string>;
    static std::map<std::string, std::vector<Alternatives>> const tables{{"speechrecognition", {{"languages"}}},
                                                                         {"speechsynthesis", {{"speech_text", "SSML_text"}}},
                                                                         {"reaction", {{"reaction_ref"}}},
                                                                         {"navigation", {{"target_position"}}},
                                                                         {"follow", {{"target_object_ref"}, {"distance"}}},
                                                                         {"move", {{"line", "curve"}}}};
    for (auto const& component : stage.catalogue().components) {
        auto const found = tables.find(component.basic());
        if (found == tables.end()) continue;
        for (auto const& names : found->second)
            require(std::ranges::any_of(names, [&](auto const& name) { return component.parameter_named(name) != nullptr; }),
                    component.ref + " has no parameter " + list(names));
    }
}

}  // namespace

Clause component_clause() {
    return {
        "7.6 Common messages: every component",
        {{"basic_components_have_their_messages", "tables 32 to 47", basic_components_have_their_messages, Way::http},
         {"basic_messages_have_their_results", "tables 34 to 47", basic_messages_have_their_results, Way::http},
         {"basic_components_have_their_parameters", "tables 42 to 47; 7.6.15", basic_components_have_their_parameters, Way::http},
         {"every_component_knows_the_common_commands", "table 32; decision 9", every_component_knows_the_common_commands},
         {"every_component_starts_and_stops", "tables 32 to 47; decisions 8, 9, 12", every_component_starts_and_stops},
         {"every_function_can_be_suspended", "table 32; decisions 6, 8, 9", every_function_can_be_suspended},
         {"every_parameter_can_be_set_to_what_it_is", "table 16; decision 8", every_parameter_can_be_set_to_what_it_is}}};
}

}  // namespace rois::conformance
