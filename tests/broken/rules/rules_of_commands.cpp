// Parameters, commands and their sequences.
#include <memory>
#include <set>

#include "broken/breaking.hpp"
#include "broken/rules.hpp"

namespace rois::broken {

namespace {

Edit in_all(char const* attribute, std::function<void(pugi::xml_attribute)> const& edit) {
    return [=](pugi::xml_node root) {
        for_each_below(root, [&](pugi::xml_node node) {
            if (auto const found = node.attribute(attribute)) edit(found);
        });
    };
}

Breaking stores_nothing() {
    return edits_requests("set_parameter", [](pugi::xml_node root) { root.child("parameters").remove_children(); });
}

Breaking tells_status(char const* status, char const* instead) {
    return edits_notifications("completed", [=](pugi::xml_node root) {
        auto text = root.child("status").text();
        if (text.get() == std::string_view{status}) text.set(instead);
    });
}

Breaking forgets_the_fifth_completion() {
    auto completed = std::make_shared<int>(0);
    return {.notification = [completed](std::string const& notification) -> Documents {
        if (is(notification, "completed") && ++*completed == 5) return {};
        return {notification};
    }};
}

// Everywhere in the same way.
Breaking names_commands_itself() {
    auto named = std::make_shared<std::set<std::string>>();
    auto breaking = edits_answers("execute", in_all("rois:command_id", [named](pugi::xml_attribute id) {
                                      named->insert(id.value());
                                      id.set_value((std::string{"c-"} + id.value()).c_str());
                                  }));
    breaking.notification = edits_notifications("completed", [named](pugi::xml_node root) {
                                auto id = root.child("command_id").text();
                                if (named->contains(id.get())) id.set((std::string{"c-"} + id.get()).c_str());
                            }).notification;
    return breaking;
}

Breaking leaves_ids_empty() {
    return edits_answers("execute", in_all("rois:command_id", [](pugi::xml_attribute id) { id.set_value(""); }));
}

Breaking names_no_path() {
    return edits_answers("execute", [](pugi::xml_node root) {
        auto reason = root.child("reason").text();
        std::string const text = reason.get();
        if (auto const colon = text.find(": "); colon != std::string::npos) reason.set(text.substr(colon + 2).c_str());
    });
}

// Runs the first unit of a sequence that is refused.
Breaking runs_what_comes_before_a_bad_unit() {
    return {.answer = [](std::string const& request, std::string const& answer, ProxiedConnection& link) -> Documents {
        if (is(request, "execute") && answer.find("BAD_PARAMETER") != std::string::npos)
            link.ask_aside(edited(request, [](pugi::xml_node root) {
                auto sequence = root.first_child();
                while (sequence.first_child().next_sibling()) sequence.remove_child(sequence.last_child());
            }));
        return {answer};
    }};
}

Breaking delays_nothing() {
    return edits_requests("execute", in_all("rois:delay_time", [](pugi::xml_attribute delay) {
                              if (delay.as_int() > 0) delay.set_value(0);
                          }));
}

Breaking takes_negative_delays() {
    return edits_requests("execute", in_all("rois:delay_time", [](pugi::xml_attribute delay) {
                              if (delay.as_int() < 0) delay.set_value(0);
                          }));
}

Breaking runs_all_in_sequence() {
    return edits_requests("execute", in_all("xsi:type", [](pugi::xml_attribute type) {
                              if (type.value() == std::string_view{"rois:ParallelCommandUnitType"})
                                  type.set_value("rois:SequentialCommandUnitType");
                          }));
}

Breaking lets_stop_do_nothing() {
    return edits_requests("execute", in_all("rois:command_type", [](pugi::xml_attribute type) {
                              if (type.value() == std::string_view{"stop"}) type.set_value("suspend");
                          }));
}

Breaking echoes_sequences_alone() {
    return edits_answers("execute", in_all("xsi:type", [](pugi::xml_attribute type) {
                             if (type.value() == std::string_view{"rois:ParallelCommandUnitType"})
                                 type.set_value("rois:SequentialCommandUnitType");
                         }));
}

Breaking echoes_no_nested_arguments() {
    return edits_answers("execute", [](pugi::xml_node root) {
        for_each_below(root, [](pugi::xml_node node) {
            if (node.name() == std::string_view{"rois:command_list"}) node.remove_child("rois:arguments");
        });
    });
}

// Localization continues: the operation in place of `type` completes with OK, too.
Breaking lets_localization_go_on(char const* type) {
    return edits_requests("execute", [=](pugi::xml_node root) {
        for_each_below(root, [&](pugi::xml_node node) {
            auto command = node.attribute("rois:command_type");
            if (command.value() == std::string_view{type} &&
                std::string_view{node.child("rois:component_ref").attribute("rois:code").value()}.ends_with("_localization"))
                command.set_value("set_parameter");
        });
    });
}

Breaking calls_waiting_running() {
    return edits_answers("get_command_result", [](pugi::xml_node root) {
        for_each_below(root, [](pugi::xml_node node) {
            if (std::string_view{node.value()} == "WAITING") node.set_value("RUNNING");
        });
    });
}

std::string const a_status =
    "<results><result rois:name=\"status\"><rois:data_type_ref "
    "rois:code=\"string\"/><rois:value>OK</rois:value></result></results>";

}  // namespace

std::vector<BrokenRule> rules_of_commands() {
    return {
        {"set_parameter stores nothing", "set_parameter_completes_once_and_stores", stores_nothing},
        {"bad parameters are taken", "bad_parameters_are_refused",
         [] { return says("set_parameter", "BAD_PARAMETER", "OK", "<command_id>c-0</command_id>"); }},
        {"commands have no id", "every_command_gets_an_id", leaves_ids_empty},
        {"an application cannot name its commands", "every_command_gets_an_id", names_commands_itself},
        {"a bad unit is not named", "a_bad_unit_is_named_by_its_path", names_no_path},
        {"a bad sequence runs until it goes wrong", "of_a_bad_sequence_nothing_runs", runs_what_comes_before_a_bad_unit},
        {"commands complete twice", "commands_complete_once", [] { return repeats("completed"); }},
        {"a command never completes", "every_command_of_a_sequence_completes_once", forgets_the_fifth_completion},
        {"a stopped command is reported as done", "stop_ends_the_action", [] { return tells_status("ABORT", "OK"); }},
        {"errors are reported as done", "in_a_wrong_state_there_is_an_error", [] { return tells_status("ERROR", "OK"); }},
        {"stop only suspends", "stop_ends_the_action", lets_stop_do_nothing},
        {"a waiting command is reported as running", "results_report_the_progress_of_a_command", calls_waiting_running},
        {"anybody sees the results of a command", "results_of_an_unknown_or_anothers_command_are_refused",
         [] { return says("get_command_result", "BAD_PARAMETER", "OK", a_status); }},
        {"results are not chosen", "results_are_chosen_by_condition",
         [] { return edits_requests("get_command_result", remove_condition); }},
        {"delays are ignored", "a_delay_is_in_milliseconds_from_the_turn", delays_nothing},
        {"negative delays are taken", "a_delay_is_not_negative", takes_negative_delays},
        {"units change their type in the answer", "the_answer_echoes_the_structure", echoes_sequences_alone},
        {"arguments within branches are not echoed", "the_answer_echoes_the_structure", echoes_no_nested_arguments},
        {"localization goes on after stop", "every_function_can_be_suspended", [] { return lets_localization_go_on("stop"); }},
        {"localization cannot be suspended", "every_function_can_be_suspended",
         [] { return lets_localization_go_on("suspend"); }},
        {"parallel units run in sequence", "units_nest_freely", runs_all_in_sequence}};
}

}  // namespace rois::broken
