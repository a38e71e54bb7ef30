// Missing and empty parts of answers and profiles.
#include "broken/breaking.hpp"
#include "broken/rules.hpp"

namespace rois::broken {

namespace {

using Chosen = std::function<bool(pugi::xml_node)>;

bool is_named(pugi::xml_node node, std::string_view name) { return node.attribute("rois:name").value() == name; }

// Removes all selected elements below the root.
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

Breaking edits_profiles(Edit const& edit) { return edits_answers("get_profile", edit); }

Breaking omits_detection_events() {
    return edits_profiles(removes([](pugi::xml_node node) {
        return std::string_view{node.name()} == "rois:MessageProfile" &&
               std::string_view{node.attribute("rois:name").value()}.ends_with("_detected");
    }));
}

Breaking omits_components() {
    return edits_profiles([](pugi::xml_node root) { root.child("components").remove_children(); });
}

Breaking omits_results_of_localization() {
    return edits_profiles([](pugi::xml_node root) {
        for_each_below(root, [](pugi::xml_node node) {
            if (is_named(node, "person_localized")) node.remove_children();
        });
    });
}

Breaking declares_positions_as_numbers() {
    return edits_profiles([](pugi::xml_node root) {
        for_each_below(root, [](pugi::xml_node node) {
            if (is_named(node, "position_data")) node.child("rois:data_type_ref").attribute("rois:code").set_value("int");
        });
    });
}

Breaking hides_a_component_of_the_engine() {
    return edits_profiles([](pugi::xml_node root) {
        auto const first = root.select_node("rois:HRIEngineProfile//rois:HRIComponent").node();
        first.parent().remove_child(first);
    });
}

Breaking has_invalid_defaults() {
    return edits_profiles([](pugi::xml_node root) {
        for_each_below(root, [](pugi::xml_node node) {
            if (is_named(node, "time_limit")) node.attribute("rois:default_value").set_value("purple");
        });
    });
}

Breaking omits_the_sequence() {
    return edits_answers("execute", [](pugi::xml_node root) { root.remove_child("rois:CommandUnitSequence"); });
}

Breaking omits_the_number() {
    return edits_answers("get_event_detail", [](pugi::xml_node root) {
        root.child("results").find_child_by_attribute("rois:name", "number").remove_child("rois:value");
    });
}

}  // namespace

std::vector<BrokenRule> rules_of_gaps() {
    auto const http = Over::http;
    std::string const queries = "every_query_of_every_component_is_answered";
    return {{"detectors have no event", "basic_components_have_their_messages", omits_detection_events, http},
            {"get_profile lists no component", "a_condition_selects_profiles", omits_components},
            {"an event has no results in its profile", "basic_messages_have_their_results", omits_results_of_localization, http},
            {"positions are numbers in the profile", "basic_messages_have_their_results", declares_positions_as_numbers, http},
            {"the engine's profile lacks a component", "get_profile_lists_all_components", hides_a_component_of_the_engine},
            {"default values are not of their types", "default_values_match_their_types", has_invalid_defaults, http},
            {"execute does not answer with the sequence", "every_command_gets_an_id", omits_the_sequence},
            {"a number has no value", "a_condition_selects_details_of_an_event", omits_the_number},
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
            {"recognizable_gestures is missing", queries,
             [] { return edits_answers("query", removes_result("recognizable_gestures")); }},
            {"available_reactions is missing", queries,
             [] { return edits_answers("query", removes_result("available_reactions")); }}};
}

}  // namespace rois::broken
