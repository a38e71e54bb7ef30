// The operation execute, and the requests that it must refuse (7.4.2, figure 10; tables 10 to 12; decisions 8 to 11).
#include <algorithm>
#include <set>

#include "conformance/context.hpp"

namespace rois::conformance {

namespace {

using kit::unit;

void every_command_gets_an_id(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client client{context};
    client.bind_or_skip(component);
    auto const name = unique_name();
    auto const answer = require_ok(client.execute(unit(command(component, "stop")) + unit(command(component, "stop", name)) +
                                                  kit::concurrent(kit::branch({command(component, "stop")}))));
    require(answer.children() == std::vector<std::string>{"rois:CommandUnitSequence"},
            "execute: expected rois:CommandUnitSequence in the answer, got " + answer.whole());
    auto const ids = kit::command_ids(answer);
    require(ids.size() == 3 && std::set(ids.begin(), ids.end()).size() == 3 && !std::set(ids.begin(), ids.end()).contains(""),
            "execute: expected three different command ids, got " + answer.whole());
    require_equal("the command id from the request", name, ids[1]);
    client.flush_notifications(component);
}

void the_answer_echoes_the_commands(Context& context) {
    auto const number = number_parameter_of(context);
    Client client{context};
    client.bind_or_skip(*number.component);
    auto const answer = require_ok(client.execute(
        {.component = number.component->ref, .type = "set_parameter", .arguments = {with_value(number, 50)}, .delay = 1}));
    auto const echoed = answer.root().first_child().first_child();
    require_equal("command_type", "set_parameter", echoed.attribute("rois:command_type").value());
    require_equal("delay_time", "1", echoed.attribute("rois:delay_time").value());
    require_equal("component_ref", number.component->ref, echoed.child("rois:component_ref").attribute("rois:code").value());
    auto const argument = echoed.child("rois:arguments").child("rois:parameter");
    require_equal("the name of the argument", number.name, argument.attribute("rois:name").value());
    require_equal("the value of the argument", number.text(50), argument.child("rois:value").text().get());
    client.status_of(first_of("a command in the answer", kit::command_ids(answer)));
}

// Returns the structure and the arguments of a sequence as text. Omits ids and data types, which a gateway may add or change.
std::string structure_of(pugi::xml_node unit) {
    std::string text = unit.name();
    auto const add = [&](char const* what, std::string const& value) {
        if (!value.empty()) text += std::string{" "} + what + "=" + value;
    };
    std::string const type = unit.attribute("xsi:type").value(), delay = unit.attribute("rois:delay_time").value();
    add("type", type);
    add("delay", delay == "0" ? "" : delay);
    for (auto const* const name : {"rois:command_type", "rois:code", "rois:name"}) add(name, unit.attribute(name).value());
    add("value", unit.text().get());
    text += "(";
    for (auto const child : unit.children())
        if (child.type() == pugi::node_element && std::string{child.name()} != "rois:data_type_ref") text += structure_of(child);
    return text + ")";
}

void the_answer_echoes_the_structure(Context& context) {
    auto const number = number_parameter_of(context);
    Client client{context};
    client.bind_or_skip(*number.component);
    auto const stop = command(*number.component, "stop");
    Command const set{.component = number.component->ref, .type = "set_parameter", .arguments = {with_value(number, 50)}};
    auto const sequence = kit::sequence(kit::parallel_unit(kit::sequential_unit(unit(stop) + unit(set)) + unit(stop)) +
                                        kit::concurrent(kit::branch({stop, set}) + kit::branch({stop})) +
                                        kit::concurrent(kit::command_list(set)) + kit::pause(1) + unit(set));
    Document const sent{kit::request("execute", sequence)};
    auto const answer = require_ok(client.ask("execute", sequence));
    require_equal("the sequence in the answer", structure_of(sent.root().first_child()),
                  structure_of(answer.root().first_child()));
    auto const ids = kit::command_ids(answer);
    require(ids.size() == 8, "execute: expected eight command ids, got " + answer.whole());
    client.status_of(ids.back());
}

void a_repeated_command_id_is_refused(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client client{context};
    client.bind_or_skip(component);
    auto const name = unique_name();
    auto const stop = [&](std::string const& id) { return unit(command(component, "stop", id)); };
    require_refusal(client.execute(stop(name) + stop(name)), "BAD_PARAMETER", "command_unit_list[2]");
    require_ok(client.execute(stop(name)));
    client.status_of(name);
    require_refusal(client.execute(stop(name)), "BAD_PARAMETER", "command_unit_list[1]");
}

void an_unknown_command_type_is_refused(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client client{context};
    client.bind_or_skip(component);
    require_refusal(client.execute(command(component, unknown_name)), "BAD_PARAMETER");
}

void an_invalid_unit_is_named_by_its_path(Context& context) {
    auto const [one, other] = context.two_common_components();
    Client client{context};
    client.bind_or_skip(*one);
    auto const good = command(*one, "stop");
    auto const unbound = command(*other, "stop");
    Command const unknown{.component = unknown_name, .type = "stop"};
    require_refusal(client.execute(unit(good) + unit(unknown)), "BAD_PARAMETER", "command_unit_list[2]");
    require_refusal(client.execute(unit(good) + kit::concurrent(kit::branch({good}) + kit::branch({good, unbound}))), "ERROR",
                    "command_unit_list[2]/branch_list[2]/command_list[2]");
    require_refusal(client.execute(kit::parallel_unit(unit(good) + kit::sequential_unit(unit(good) + unit(unknown)))),
                    "BAD_PARAMETER", "command_unit_list[1]/command_unit_list[2]/command_unit_list[2]");
    require_refusal(client.execute(unit(unbound) + unit(unknown)), "ERROR", "command_unit_list[1]");
}

void an_invalid_sequence_runs_no_command(Context& context) {
    auto const number = number_parameter_of(context);
    Client client{context};
    client.bind_or_skip(*number.component);
    client.set_parameter(number.component->ref, {with_value(number, 51)});
    auto const name = unique_name();
    Command const good{
        .component = number.component->ref, .type = "set_parameter", .id = name, .arguments = {with_value(number, 52)}};
    Command const bad{
        .component = number.component->ref, .type = "set_parameter", .arguments = {{number.name, number.type, {"soon"}}}};
    require_refusal(client.execute(unit(good) + unit(bad)), "BAD_PARAMETER", "command_unit_list[2]");
    require_refusal(client.get_command_result(name), "BAD_PARAMETER");
    client.flush_notifications(*number.component);
    require(client.completion_statuses(name).empty(), "a command of a refused sequence completed");
    auto const values = require_ok(client.get_parameter(number.component->ref)).values("parameters");
    require(values.contains(number.name) && values.at(number.name) == std::vector{number.text(51)},
            "a refused sequence has set " + number.name);
}

void arguments_of_start_are_stored_as_parameters(Context& context) {
    auto const& speaker = context.speaker();
    Client client{context};
    client.bind_or_skip(speaker);
    auto const start = short_speech(speaker, "");
    client.require_success(client.execute_one(start), speaker);
    auto const values = require_ok(client.get_parameter(speaker.ref)).values("parameters");
    auto const& [name, type, sent_values] = start.arguments.front();
    require(values.contains(name) && values.at(name) == sent_values, name + ": expected the value from `start`");
}

void invalid_arguments_are_refused(Context& context) {
    auto const& speaker = context.speaker();
    Client client{context};
    client.bind_or_skip(speaker);
    auto start = short_speech(speaker, "");
    start.arguments.push_back({unknown_name, "string", {"red"}});
    require_refusal(client.execute(start), "BAD_PARAMETER", unknown_name);
    if (!speaker.parameter_named("volume")) return;
    start.arguments.back() = argument(speaker, "volume", {"loud"});
    require_refusal(client.execute(start), "BAD_PARAMETER", "volume");
}

// Skips components whose mandatory arguments have values, such as defaults.
void start_without_a_mandatory_argument_is_refused(Context& context) {
    static std::vector<std::pair<std::string, std::vector<std::string>>> const mandatory{
        {"follow", {"target_object_ref"}},
        {"navigation", {"target_position"}},
        {"move", {"line", "curve"}},
        {"reaction", {"reaction_ref"}},
        {"speechsynthesis", {"speech_text", "SSML_text"}}};
    bool ran = false;
    for (auto const& component : context.catalogue().components) {
        for (auto const& [kind, names] : mandatory) {
            if (component.basic() != kind) continue;
            Client client{context};
            if (client.bind(component.ref).return_code() != "OK") continue;
            auto const read = client.get_parameter(component.ref);
            auto const values = read.values("parameters");
            if (read.return_code() != "OK" || std::ranges::any_of(names, [&](auto const& name) { return values.contains(name); }))
                continue;
            require_refusal(client.execute(command(component, "start")), "BAD_PARAMETER");
            ran = true;
        }
    }
    if (!ran) throw Skipped{"no free component has a mandatory argument of `start` without a value"};
}

}  // namespace

Clause execution_clause() {
    return {"7.4.2 Command interface: execute",
            {{"every_command_gets_an_id", "figure 10; table 12; decision 11", every_command_gets_an_id},
             {"the_answer_echoes_the_commands", "figure 10; table 3; decision 11", the_answer_echoes_the_commands},
             {"the_answer_echoes_the_structure", "figure 10; tables 10 to 15; decision 11", the_answer_echoes_the_structure},
             {"a_repeated_command_id_is_refused", "decision 11", a_repeated_command_id_is_refused},
             {"an_unknown_command_type_is_refused", "tables 12, 32; decision 9", an_unknown_command_type_is_refused},
             {"an_invalid_unit_is_named_by_its_path", "decision 10", an_invalid_unit_is_named_by_its_path},
             {"an_invalid_sequence_runs_no_command", "decision 10", an_invalid_sequence_runs_no_command},
             {"arguments_of_start_are_stored_as_parameters", "tables 12, 18; decision 8",
              arguments_of_start_are_stored_as_parameters},
             {"invalid_arguments_are_refused", "table 18; decisions 10, 26", invalid_arguments_are_refused},
             {"start_without_a_mandatory_argument_is_refused", "tables 44 to 47; decision 8",
              start_without_a_mandatory_argument_is_refused}}};
}

}  // namespace rois::conformance
