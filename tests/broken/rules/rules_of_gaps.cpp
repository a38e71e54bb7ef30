// What is left out of an answer or a profile, or empty there.
#include "broken/breaking.hpp"
#include "broken/rules.hpp"

namespace rois::broken {

namespace {

using Chosen = std::function<bool(pugi::xml_node)>;

bool is_named(pugi::xml_node node, std::string_view name) { return node.attribute("rois:name").value() == name; }

// Everywhere below the root.
Edit removes(Chosen const& chosen) {
    return [=](pugi::xml_node root) {
        for_each_below(root, [&](pugi::xml_node node) {
            if (chosen(node)) node.parent().remove_child(node);
        });
    };
}

Edit removes_result(std::string const& name) {
    return removes([=](pugi::xml_node node) { return std::string_view{node.name()} == "result" && is_named(node, name); });
}

Breaking tells_profiles(Edit const& edit) { return edits_answers("get_profile", edit); }

Breaking tells_no_detections() {
    return tells_profiles(removes([](pugi::xml_node node) {
        return std::string_view{node.name()} == "rois:MessageProfile" &&
               std::string_view{node.attribute("rois:name").value()}.ends_with("_detected");
    }));
}

Breaking tells_no_components() {
    return tells_profiles([](pugi::xml_node root) { root.child("components").remove_children(); });
}

Breaking tells_no_localized_people() {
    return tells_profiles([](pugi::xml_node root) {
        for_each_below(root, [](pugi::xml_node node) {
            if (is_named(node, "person_localized")) node.remove_children();
        });
    });
}

Breaking calls_positions_numbers() {
    return tells_profiles([](pugi::xml_node root) {
        for_each_below(root, [](pugi::xml_node node) {
            if (is_named(node, "position_data")) node.child("rois:data_type_ref").attribute("rois:code").set_value("int");
        });
    });
}

Breaking hides_a_component_of_the_engine() {
    return tells_profiles([](pugi::xml_node root) {
        auto const first = root.select_node("rois:HRIEngineProfile//rois:HRIComponent").node();
        first.parent().remove_child(first);
    });
}

Breaking has_purple_defaults() {
    return tells_profiles([](pugi::xml_node root) {
        for_each_below(root, [](pugi::xml_node node) {
            if (is_named(node, "time_limit")) node.attribute("rois:default_value").set_value("purple");
        });
    });
}

Breaking echoes_nothing() {
    return edits_answers("execute", [](pugi::xml_node root) { root.remove_child("rois:CommandUnitSequence"); });
}

Breaking counts_nothing() {
    return edits_answers("get_event_detail", [](pugi::xml_node root) {
        root.child("results").find_child_by_attribute("rois:name", "number").remove_child("rois:value");
    });
}

}  // namespace

std::vector<BrokenRule> rules_of_gaps() {
    auto const http = Over::http;
    std::string const queries = "every_query_of_every_component_is_answered";
    return {{"detectors have no event", "basic_components_have_their_messages", tells_no_detections, http},
            {"there is no component", "get_profile_chooses_by_condition", tells_no_components},
            {"an event has no results in its profile", "basic_messages_have_their_results", tells_no_localized_people, http},
            {"positions are numbers in the profile", "basic_messages_have_their_results", calls_positions_numbers, http},
            {"the engine's profile lacks a component", "get_profile_lists_all_components", hides_a_component_of_the_engine},
            {"default values are not of their types", "default_values_are_of_their_types", has_purple_defaults, http},
            {"execute does not answer with the sequence", "every_command_gets_an_id", echoes_nothing},
            {"a number has no value", "details_are_chosen_by_condition", counts_nothing},
            {"results of commands have no status", "results_report_the_progress_of_a_command",
             [] { return edits_answers("get_command_result", removes_result("status")); }},
            {"a status has no value", "a_bound_component_is_busy_for_others",
             [] {
                 return edits_answers("query", [](pugi::xml_node root) {
                     root.child("results").find_child_by_attribute("rois:name", "status").remove_child("rois:value");
                 });
             }},
            {"a position has no time", queries, [] { return edits_answers("query", removes_result("timestamp")); }},
            {"engine_status has no status", queries, [] { return edits_answers("query", removes_result("status")); }},
            {"gestures that can be recognized are not told", queries,
             [] { return edits_answers("query", removes_result("recognizable_gestures")); }},
            {"reactions that there are are not told", queries,
             [] { return edits_answers("query", removes_result("available_reactions")); }}};
}

}  // namespace rois::broken
