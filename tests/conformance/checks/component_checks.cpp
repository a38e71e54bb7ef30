// The messages of every free component (7.6, tables 31 to 47): the common commands, `start` with its arguments, and the events.
#include <algorithm>

#include "conformance/basic_messages.hpp"
#include "conformance/context.hpp"

namespace rois::conformance {

namespace {

// Returns arguments for `start` of a basic component, or nothing if valid values are unknown.
std::optional<std::vector<Argument>> arguments_of_start(Client& client, Component const& component) {
    auto const kind = component.basic();
    if (kind == "speechsynthesis") return {{speech_argument(component, "Hi.")}};
    if (kind == "move")
        return {{component.parameter_named("line") ? straight_line(component, 10) : argument(component, "curve", {"10 10"})}};
    if (kind == "follow") {
        auto const robot = client.robot_of(component);
        if (!robot) return {};
        return {{argument(component, "target_object_ref", {robot->ref}), argument(component, "distance", {"1000"})}};
    }
    if (kind == "navigation") {
        auto const robot = client.robot_of(component);
        if (!robot) return {};
        return {{argument(component, "target_position", {robot->position})}};
    }
    if (kind == "reaction") {
        auto const parameters = client.get_parameter(component.ref).values("parameters");
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

// Calls `run` for each free component while it is bound. Throws Skipped if other applications use all components.
void with_each(Context& context, Client& client, void (*run)(Client&, Component const&)) {
    bool ran = false;
    for (auto const& component : context.catalogue().components) {
        if (client.bind(component.ref).return_code() != "OK") continue;
        {
            SavedParameters const saved{client, component};
            run(client, component);
        }
        require_ok(client.release(component.ref));
        ran = true;
    }
    if (!ran) throw Skipped{"other applications use all components"};
}

void start_and_stop(Client& client, Component const& component) {
    if (!component.is_common) return;
    auto const arguments = arguments_of_start(client, component);
    if (!arguments) return;
    auto const answer = client.execute({.component = component.ref, .arguments = *arguments});
    if (answer.return_code() == "BAD_PARAMETER" && component.basic() == "follow") return;  // the robot cannot follow itself
    auto const start = first_of("a command in the answer", kit::command_ids(require_ok(answer)));
    auto const stop = client.execute_one(command(component, "stop"));
    require_equal("the status of stop of " + component.ref, "OK", client.status_of(stop));
    client.flush_notifications(component);
    auto const completion_statuses = client.completion_statuses(start);
    require(
        completion_statuses.size() == 1 && is_completed_status(completion_statuses.front()),
        "expected start of " + component.ref + " to complete once with a status of table 8, got " + list(completion_statuses));
}

void common_commands(Client& client, Component const& component) {
    if (!component.is_common) return;
    require_equal("the status of stop of " + component.ref, "OK", client.run(command(component, "stop")));
    require_equal("the status of suspend of " + component.ref, "ERROR", client.run(command(component, "suspend")));
    require_equal("the status of resume of " + component.ref, "ERROR", client.run(command(component, "resume")));
}

void hold_and_go_on(Client& client, Component const& component) {
    if (!component.is_function()) return;
    if (client.run(command(component, "start")) != "OK") return;  // a component that has failed
    auto const ends = [&](char const* type, char const* when, char const* status) {
        require_equal(std::string{"the status of "} + type + " of " + component.ref + when, status,
                      client.run(command(component, type)));
    };
    ends("suspend", "", "OK");
    ends("suspend", " again", "ERROR");
    ends("resume", "", "OK");
    ends("resume", " again", "ERROR");
    ends("stop", "", "OK");
    ends("suspend", " after stop", "ERROR");
    if (client.run(command(component, "start")) != "OK") return;
    require_ok(client.release(component.ref));
    if (client.bind(component.ref).return_code() != "OK") return;
    ends("suspend", " after release", "ERROR");
}

// Sets the current values again: without people, only get_parameter shows the effect of parameters.
void parameters_set_and_read(Client& client, Component const& component) {
    auto const read = client.get_parameter(component.ref);
    if (read.return_code() != "OK" || component.parameters.empty()) return;
    auto const values = read.values("parameters");
    std::vector<Argument> same_again;
    for (auto const& parameter : component.parameters)
        if (auto const found = values.find(parameter.name);
            found != values.end() && !found->second.empty() && component.can_set(parameter))
            same_again.push_back({parameter.name, parameter.type, found->second});
    require_equal("set_parameter with the values read from " + component.ref, "OK",
                  client.status_of(require_ok(client.set_parameter(component.ref, same_again)).text("command_id")));
    require(require_ok(client.get_parameter(component.ref)).values("parameters") == values,
            "the parameters of " + component.ref + " changed when they were set to their current values");
}

void every_component_starts_and_stops(Context& context) {
    Client client{context};
    for (auto const& component : context.catalogue().components)
        for (auto const& event : component.events) require_ok(client.subscribe(event.name, only(component), true));
    with_each(context, client, start_and_stop);
}

void every_component_supports_the_common_commands(Context& context) {
    Client client{context};
    with_each(context, client, common_commands);
}

void every_function_can_be_suspended(Context& context) {
    Client client{context};
    with_each(context, client, hold_and_go_on);
}

void every_parameter_accepts_its_current_value(Context& context) {
    Client client{context};
    with_each(context, client, parameters_set_and_read);
}

// Requires the messages in the tables. The profile may have more.
void basic_components_have_their_messages(Context& context) {
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
    for (auto const& component : context.catalogue().components) {
        if (component.basic().empty()) continue;
        require(component.has_common || component.basic() == "systeminformation",
                "the profile of " + component.ref + " lacks the common messages (table 32)");
        auto const found = tables.find(component.basic());
        if (found == tables.end()) continue;
        for (auto const& query : found->second.first)
            require(has(component.queries, query), "the profile of " + component.ref + " lacks the query " + query);
        for (auto const& event : found->second.second)
            require(has(component.events, event), "the profile of " + component.ref + " lacks the event " + event);
    }
}

void basic_messages_have_their_results(Context& context) {
    for (auto const& component : context.catalogue().components) {
        for (auto const& basic : basic_messages()) {
            if (component.basic() != basic.kind) continue;
            auto const* const message = basic.is_event ? component.event(basic.name) : component.query(basic.name);
            require(message != nullptr,
                    "the profile of " + component.ref + " lacks the " + (basic.is_event ? "event " : "query ") + basic.name);
            for (auto const* const expected : {&basic.results, &basic.settable})
                for (auto const& result : *expected) {
                    auto const found = std::ranges::find(message->results, result.name, &TypedName::name);
                    require(found != message->results.end(),
                            "the profile of " + component.ref + " lacks the result " + result.name + " of " + basic.name);
                    require(is_same_type(found->type, result.type), result.name + " of " + basic.name + " of " + component.ref +
                                                                        ": expected the type " + result.type + ", got " +
                                                                        found->type);
                }
        }
    }
}

// Requires the mandatory parameters, and at least one of each group of alternatives.
void basic_components_have_their_parameters(Context& context) {
    using Alternatives = std::vector<std::string>;
    static std::map<std::string, std::vector<Alternatives>> const tables{{"speechrecognition", {{"languages"}}},
                                                                         {"speechsynthesis", {{"speech_text", "SSML_text"}}},
                                                                         {"reaction", {{"reaction_ref"}}},
                                                                         {"navigation", {{"target_position"}}},
                                                                         {"follow", {{"target_object_ref"}, {"distance"}}},
                                                                         {"move", {{"line", "curve"}}}};
    for (auto const& component : context.catalogue().components) {
        auto const found = tables.find(component.basic());
        if (found == tables.end()) continue;
        for (auto const& names : found->second)
            require(std::ranges::any_of(names, [&](auto const& name) { return component.parameter_named(name) != nullptr; }),
                    "the profile of " + component.ref + ": expected one of the parameters " + list(names));
    }
}

}  // namespace

Clause component_clause() {
    return {
        "7.6 Common messages: every component",
        {{"basic_components_have_their_messages", "tables 32 to 47", basic_components_have_their_messages, Transport::http},
         {"basic_messages_have_their_results", "tables 34 to 47", basic_messages_have_their_results, Transport::http},
         {"basic_components_have_their_parameters", "tables 42 to 47; 7.6.15", basic_components_have_their_parameters,
          Transport::http},
         {"every_component_supports_the_common_commands", "table 32; decision 9", every_component_supports_the_common_commands},
         {"every_component_starts_and_stops", "tables 32 to 47; decisions 8, 9, 12", every_component_starts_and_stops},
         {"every_function_can_be_suspended", "table 32; decisions 6, 8, 9", every_function_can_be_suspended},
         {"every_parameter_accepts_its_current_value", "table 16; decision 8", every_parameter_accepts_its_current_value}}};
}

}  // namespace rois::conformance
