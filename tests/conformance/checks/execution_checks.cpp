// execute and what it refuses (7.4.2, figure 10; tables 10 to 12; decisions 8 to 11).
#include <algorithm>
#include <set>

#include "conformance/stage.hpp"

namespace rois::conformance {

namespace {

using kit::unit;

void every_command_gets_an_id(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest guest{stage};
    guest.take(component);
    auto const name = unique_name();
    auto const answer = ok(guest.execute(unit(command(component, "stop")) + unit(command(component, "stop", name)) +
                                         kit::concurrent(kit::branch({command(component, "stop")}))));
    require(answer.children() == std::vector<std::string>{"rois:CommandUnitSequence"},
            "the answer should hold the sequence: " + answer.whole());
    auto const ids = kit::command_ids(answer);
    require(ids.size() == 3 && std::set(ids.begin(), ids.end()).size() == 3 && !std::set(ids.begin(), ids.end()).contains(""),
            "each of the three commands should have an id of its own: " + answer.whole());
    same("the id that the application gave", name, ids[1]);
    guest.settle(component);
}

void the_answer_echoes_the_commands(Stage& stage) {
    auto const dial = dial_of(stage);
    Guest guest{stage};
    guest.take(*dial.component);
    auto const answer = ok(
        guest.execute({.component = dial.component->ref, .type = "set_parameter", .arguments = {turned(dial, 50)}, .delay = 1}));
    auto const echoed = answer.root().first_child().first_child();
    same("command_type", "set_parameter", echoed.attribute("rois:command_type").value());
    same("delay_time", "1", echoed.attribute("rois:delay_time").value());
    same("component_ref", dial.component->ref, echoed.child("rois:component_ref").attribute("rois:code").value());
    auto const argument = echoed.child("rois:arguments").child("rois:parameter");
    same("the argument's name", dial.parameter, argument.attribute("rois:name").value());
    same("the argument's value", dial.text(50), argument.child("rois:value").text().get());
    guest.status_of(first("a command in the answer", kit::command_ids(answer)));
}

// What an application says of its commands and their structure, without ids and what a gateway may add to references.
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

void the_answer_echoes_the_structure(Stage& stage) {
    auto const dial = dial_of(stage);
    Guest guest{stage};
    guest.take(*dial.component);
    auto const stop = command(*dial.component, "stop");
    Command const set{.component = dial.component->ref, .type = "set_parameter", .arguments = {turned(dial, 50)}};
    auto const sequence = kit::sequence(kit::side_by_side(kit::one_after_another(unit(stop) + unit(set)) + unit(stop)) +
                                        kit::concurrent(kit::branch({stop, set}) + kit::branch({stop})) +
                                        kit::concurrent(kit::command_list(set)) + kit::pause(1) + unit(set));
    Document const sent{kit::request("execute", sequence)};
    auto const answer = ok(guest.ask("execute", sequence));
    same("the sequence in the answer", structure_of(sent.root().first_child()), structure_of(answer.root().first_child()));
    auto const ids = kit::command_ids(answer);
    require(ids.size() == 8, "each of eight commands should have an id: " + answer.whole());
    guest.status_of(ids.back());
}

void a_name_is_used_once(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest guest{stage};
    guest.take(component);
    auto const name = unique_name();
    auto const stop = [&](std::string const& id) { return unit(command(component, "stop", id)); };
    refused(guest.execute(stop(name) + stop(name)), "BAD_PARAMETER", "command_unit_list[2]");
    ok(guest.execute(stop(name)));
    guest.status_of(name);
    refused(guest.execute(stop(name)), "BAD_PARAMETER", "command_unit_list[1]");
}

void command_types_are_those_of_the_profile(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest guest{stage};
    guest.take(component);
    refused(guest.execute(command(component, nobody)), "BAD_PARAMETER");
}

void a_bad_unit_is_named_by_its_path(Stage& stage) {
    auto const [one, other] = stage.two_common();
    Guest guest{stage};
    guest.take(*one);
    auto const good = command(*one, "stop");
    auto const unbound = command(*other, "stop");
    Command const unknown{.component = nobody, .type = "stop"};
    refused(guest.execute(unit(good) + unit(unknown)), "BAD_PARAMETER", "command_unit_list[2]");
    refused(guest.execute(unit(good) + kit::concurrent(kit::branch({good}) + kit::branch({good, unbound}))), "ERROR",
            "command_unit_list[2]/branch_list[2]/command_list[2]");
    refused(guest.execute(kit::side_by_side(unit(good) + kit::one_after_another(unit(good) + unit(unknown)))), "BAD_PARAMETER",
            "command_unit_list[1]/command_unit_list[2]/command_unit_list[2]");
    refused(guest.execute(unit(unbound) + unit(unknown)), "ERROR", "command_unit_list[1]");
}

void of_a_bad_sequence_nothing_runs(Stage& stage) {
    auto const dial = dial_of(stage);
    Guest guest{stage};
    guest.take(*dial.component);
    guest.set_parameter(dial.component->ref, {turned(dial, 51)});
    auto const name = unique_name();
    Command const good{.component = dial.component->ref, .type = "set_parameter", .id = name, .arguments = {turned(dial, 52)}};
    Command const bad{
        .component = dial.component->ref, .type = "set_parameter", .arguments = {{dial.parameter, dial.type, {"soon"}}}};
    refused(guest.execute(unit(good) + unit(bad)), "BAD_PARAMETER", "command_unit_list[2]");
    refused(guest.get_command_result(name), "BAD_PARAMETER");
    guest.settle(*dial.component);
    require(guest.endings(name).empty(), "a command of a sequence that was refused has completed");
    auto const values = ok(guest.get_parameter(dial.component->ref)).values("parameters");
    require(values.contains(dial.parameter) && values.at(dial.parameter) == std::vector{dial.text(51)},
            dial.parameter + " was set by a sequence that was refused");
}

void arguments_of_start_are_stored_first(Stage& stage) {
    auto const& speaker = stage.speaker();
    Guest guest{stage};
    guest.take(speaker);
    auto const start = short_speech(speaker, "");
    guest.require_success(guest.order(start), speaker);
    auto const values = ok(guest.get_parameter(speaker.ref)).values("parameters");
    auto const& [name, type, said] = start.arguments.front();
    require(values.contains(name) && values.at(name) == said, name + " is not what `start` said");
}

void bad_arguments_are_refused(Stage& stage) {
    auto const& speaker = stage.speaker();
    Guest guest{stage};
    guest.take(speaker);
    auto start = short_speech(speaker, "");
    start.arguments.push_back({nobody, "string", {"red"}});
    refused(guest.execute(start), "BAD_PARAMETER", nobody);
    if (!speaker.parameter_named("volume")) return;
    start.arguments.back() = argument(speaker, "volume", {"loud"});
    refused(guest.execute(start), "BAD_PARAMETER", "volume");
}

// Unless it has a default value.
void start_needs_what_is_mandatory(Stage& stage) {
    static std::vector<std::pair<std::string, std::vector<std::string>>> const mandatory{
        {"follow", {"target_object_ref"}},
        {"navigation", {"target_position"}},
        {"move", {"line", "curve"}},
        {"reaction", {"reaction_ref"}},
        {"speechsynthesis", {"speech_text", "SSML_text"}}};
    bool played = false;
    for (auto const& component : stage.catalogue().components) {
        for (auto const& [kind, names] : mandatory) {
            if (component.basic() != kind) continue;
            Guest guest{stage};
            if (guest.bind(component.ref).return_code() != "OK") continue;
            auto const read = guest.get_parameter(component.ref);
            auto const values = read.values("parameters");
            if (read.return_code() != "OK" || std::ranges::any_of(names, [&](auto const& name) { return values.contains(name); }))
                continue;
            refused(guest.execute(command(component, "start")), "BAD_PARAMETER");
            played = true;
        }
    }
    if (!played) throw NotPlayed{"no free component has mandatory arguments for its start"};
}

}  // namespace

Clause execution_clause() {
    return {"7.4.2 Command interface: execute",
            {{"every_command_gets_an_id", "figure 10; table 12; decision 11", every_command_gets_an_id},
             {"the_answer_echoes_the_commands", "figure 10; table 3; decision 11", the_answer_echoes_the_commands},
             {"the_answer_echoes_the_structure", "figure 10; tables 10 to 15; decision 11", the_answer_echoes_the_structure},
             {"a_name_is_used_once", "decision 11", a_name_is_used_once},
             {"command_types_are_those_of_the_profile", "tables 12, 32; decision 9", command_types_are_those_of_the_profile},
             {"a_bad_unit_is_named_by_its_path", "decision 10", a_bad_unit_is_named_by_its_path},
             {"of_a_bad_sequence_nothing_runs", "decision 10", of_a_bad_sequence_nothing_runs},
             {"arguments_of_start_are_stored_first", "tables 12, 18; decision 8", arguments_of_start_are_stored_first},
             {"bad_arguments_are_refused", "table 18; decisions 10, 26", bad_arguments_are_refused},
             {"start_needs_what_is_mandatory", "tables 44 to 47; decision 8", start_needs_what_is_mandatory}}};
}

}  // namespace rois::conformance
