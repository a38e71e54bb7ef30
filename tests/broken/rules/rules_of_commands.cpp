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

Breaking reports_status(char const* status, char const* instead) {
    return edits_notifications("completed", [=](pugi::xml_node root) {
        auto text = root.child("status").text();
        if (text.get() == std::string_view{status}) text.set(instead);
    });
}

Breaking drops_the_fifth_completion() {
    auto completed = std::make_shared<int>(0);
    return {.notification = [completed](std::string const& notification) -> Documents {
        if (is(notification, "completed") && ++*completed == 5) return {};
        return {notification};
    }};
}

// Renames the commands in answers of execute and in `completed`.
Breaking renames_commands() {
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

Breaking omits_the_path() {
    return edits_answers("execute", [](pugi::xml_node root) {
        auto reason = root.child("reason").text();
        std::string const text = reason.get();
        if (auto const colon = text.find(": "); colon != std::string::npos) reason.set(text.substr(colon + 2).c_str());
    });
}

// Runs the first unit of a sequence that is refused.
Breaking runs_units_before_an_invalid_one() {
    return {.answer = [](std::string const& request, std::string const& answer, ProxiedConnection& link) -> Documents {
        if (is(request, "execute") && answer.find("BAD_PARAMETER") != std::string::npos)
            link.send_hidden(edited(request, [](pugi::xml_node root) {
                auto sequence = root.first_child();
                while (sequence.first_child().next_sibling()) sequence.remove_child(sequence.last_child());
            }));
        return {answer};
    }};
}

Breaking ignores_delays() {
    return edits_requests("execute", in_all("rois:delay_time", [](pugi::xml_attribute delay) {
                              if (delay.as_int() > 0) delay.set_value(0);
                          }));
}

Breaking accepts_negative_delays() {
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

Breaking replaces_stop_by_suspend() {
    return edits_requests("execute", in_all("rois:command_type", [](pugi::xml_attribute type) {
                              if (type.value() == std::string_view{"stop"}) type.set_value("suspend");
                          }));
}

Breaking echoes_parallel_as_sequential() {
    return edits_answers("execute", in_all("xsi:type", [](pugi::xml_attribute type) {
                             if (type.value() == std::string_view{"rois:ParallelCommandUnitType"})
                                 type.set_value("rois:SequentialCommandUnitType");
                         }));
}

Breaking omits_nested_arguments() {
    return edits_answers("execute", [](pugi::xml_node root) {
        for_each_below(root, [](pugi::xml_node node) {
            if (node.name() == std::string_view{"rois:command_list"}) node.remove_child("rois:arguments");
        });
    });
}

// Localization continues: set_parameter replaces `type`, and completes with OK, too.
Breaking continues_localization(char const* type) {
    return edits_requests("execute", [=](pugi::xml_node root) {
        for_each_below(root, [&](pugi::xml_node node) {
            auto command = node.attribute("rois:command_type");
            if (command.value() == std::string_view{type} &&
                std::string_view{node.child("rois:component_ref").attribute("rois:code").value()}.ends_with("_localization"))
                command.set_value("set_parameter");
        });
    });
}

Breaking reports_waiting_as_running() {
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
        {"set_parameter stores nothing", "set_parameter_completes_once_and_stores_the_value", stores_nothing},
        {"invalid parameters are accepted", "invalid_parameters_are_refused",
         [] { return answers_with("set_parameter", "BAD_PARAMETER", "OK", "<command_id>c-0</command_id>"); }},
        {"commands have no id", "every_command_gets_an_id", leaves_ids_empty},
        {"an application cannot name its commands", "every_command_gets_an_id", renames_commands},
        {"an invalid unit is not named", "an_invalid_unit_is_named_by_its_path", omits_the_path},
        {"an invalid sequence runs up to the invalid command", "an_invalid_sequence_runs_no_command",
         runs_units_before_an_invalid_one},
        {"commands complete twice", "commands_complete_once", [] { return repeats("completed"); }},
        {"a command never completes", "every_command_of_a_sequence_completes_once", drops_the_fifth_completion},
        {"a stopped command is reported as done", "stop_aborts_the_running_action", [] { return reports_status("ABORT", "OK"); }},
        {"errors are reported as done", "suspend_and_resume_fail_in_a_wrong_state", [] { return reports_status("ERROR", "OK"); }},
        {"stop only suspends", "stop_aborts_the_running_action", replaces_stop_by_suspend},
        {"a waiting command is reported as running", "results_report_the_progress_of_a_command", reports_waiting_as_running},
        {"other applications can read the results of a command", "results_of_unknown_and_foreign_commands_are_refused",
         [] { return answers_with("get_command_result", "BAD_PARAMETER", "OK", a_status); }},
        {"the condition on results is ignored", "a_condition_selects_results_of_a_command",
         [] { return edits_requests("get_command_result", remove_condition); }},
        {"delays are ignored", "delays_are_in_milliseconds_and_add_up", ignores_delays},
        {"negative delays are accepted", "a_negative_delay_is_refused", accepts_negative_delays},
        {"units change their type in the answer", "the_answer_echoes_the_structure", echoes_parallel_as_sequential},
        {"arguments within branches are not echoed", "the_answer_echoes_the_structure", omits_nested_arguments},
        {"localization continues after stop", "every_function_can_be_suspended", [] { return continues_localization("stop"); }},
        {"localization cannot be suspended", "every_function_can_be_suspended", [] { return continues_localization("suspend"); }},
        {"parallel units run in sequence", "sequential_and_parallel_units_can_be_nested", runs_all_in_sequence}};
}

}  // namespace rois::broken
