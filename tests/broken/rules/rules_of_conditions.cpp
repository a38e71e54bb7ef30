// Components and results selected by conditions, and the end of Follow.
#include <memory>
#include <set>

#include "broken/breaking.hpp"
#include "broken/rules.hpp"

namespace rois::broken {

namespace {

// Applies `edit` to every element `name` of a condition.
Breaking edits_conditions(std::string const& operation, std::string const& name, Edit const& edit) {
    return edits_requests(operation, [=](pugi::xml_node root) {
        for_each_below(root.child("condition"), [&](pugi::xml_node node) {
            if (node.name() == name) edit(node);
        });
    });
}

Breaking replaces_operator(std::string const& operation, char const* name, char const* other) {
    return edits_conditions(operation, name, [=](pugi::xml_node node) { node.set_name(other); });
}

void drop_attributes(pugi::xml_node node) {
    while (node.remove_attribute(node.first_attribute())) {
    }
}

Breaking ignores_wildcards() {
    return edits_conditions("search", "fes:PropertyIsLike", [](pugi::xml_node node) {
        node.set_name("fes:PropertyIsEqualTo");
        drop_attributes(node);
    });
}

Breaking compares_case(bool always) {
    return edits_conditions("search", "fes:PropertyIsEqualTo", [=](pugi::xml_node node) {
        node.remove_attribute("matchCase");
        if (!always) node.append_attribute("matchCase").set_value(false);
    });
}

Breaking selects_nothing_as_null() {
    return edits_conditions("search", "fes:PropertyIsNull", [](pugi::xml_node node) {
        node.set_name("fes:PropertyIsEqualTo");
        node.child("fes:ValueReference").text().set("component_ref");
        node.append_child("fes:Literal").text().set("unknown");
    });
}

// Also selects components with a value.
Breaking selects_everything_as_null() {
    return edits_conditions("search", "fes:PropertyIsNull", [](pugi::xml_node node) {
        node.set_name("fes:PropertyIsNotEqualTo");
        node.child("fes:ValueReference").text().set("component_ref");
        node.append_child("fes:Literal").text().set("unknown");
    });
}

Breaking ignores_sort_by() {
    return edits_requests("search", [](pugi::xml_node root) {
        auto condition = root.child("condition");
        if (!condition.remove_child("fes:SortBy")) return;
        if (!condition.first_child()) root.remove_child(condition);
    });
}

Breaking ignores_units() {
    return edits_conditions("search", "fes:Distance", [](pugi::xml_node node) { node.attribute("uom").set_value("mm"); });
}

Breaking ignores_frames() {
    return edits_conditions("search", "gml:Envelope", [](pugi::xml_node node) { node.remove_attribute("srsName"); });
}

// Compares numbers as texts: leading zeros and decimal places make a difference.
Breaking compares_texts() {
    return edits_conditions("get_event_detail", "fes:Literal", [](pugi::xml_node node) {
        std::string const text = node.text().get();
        if (text.starts_with("00") || text.ends_with(".0")) node.text().set("not a number");
    });
}

Breaking ignores_time_zones() {
    return edits_conditions("get_event_detail", "fes:Literal", [](pugi::xml_node node) {
        std::string const text = node.text().get();
        if (auto const zone = text.find("+01:00"); zone != std::string::npos)
            node.text().set((text.substr(0, zone) + "Z").c_str());
    });
}

// Replaces one reference by `name`.
Breaking reads_reference_as_name(std::string const& reference) {
    return edits_conditions("search", "fes:ValueReference", [=](pugi::xml_node node) {
        if (node.text().get() == reference) node.text().set("name");
    });
}

// Follow's start always completes with this status.
Breaking ends_follow_with(char const* expected, char const* status) {
    auto follows = std::make_shared<std::set<std::string>>();
    auto breaking = edits_answers("execute", [follows](pugi::xml_node root) {
        for_each_below(root, [&](pugi::xml_node node) {
            if (node.attribute("rois:command_type").value() == std::string_view{"start"} &&
                std::string_view{node.child("rois:component_ref").attribute("rois:code").value()} == "follow")
                follows->insert(node.attribute("rois:command_id").value());
        });
    });
    breaking.notification =
        edits_notifications("completed", [=](pugi::xml_node root) {
            auto text = root.child("status").text();
            if (follows->contains(root.child("command_id").text().get()) && text.get() == std::string_view{expected})
                text.set(status);
        }).notification;
    return breaking;
}

}  // namespace

std::vector<BrokenRule> rules_of_conditions() {
    return {
        {"And selects like Or", "and_or_not_select_components", [] { return replaces_operator("search", "fes:And", "fes:Or"); }},
        {"NotEqualTo selects like EqualTo", "and_or_not_select_components",
         [] { return replaces_operator("search", "fes:PropertyIsNotEqualTo", "fes:PropertyIsEqualTo"); }},
        {"Like ignores wildcards", "like_supports_wildcards", ignores_wildcards},
        {"numbers are compared as texts", "numbers_are_compared_by_value", compares_texts},
        {"LessThanOrEqualTo selects like LessThan", "numbers_are_compared_by_value",
         [] { return replaces_operator("get_event_detail", "fes:PropertyIsLessThanOrEqualTo", "fes:PropertyIsLessThan"); }},
        {"time zones are ignored", "times_are_compared_by_value", ignores_time_zones},
        {"After selects like Before", "times_are_compared_by_value",
         [] { return replaces_operator("get_event_detail", "fes:After", "fes:Before"); }},
        {"Disjoint selects like Within", "spatial_operators_select_components",
         [] { return replaces_operator("search", "fes:Disjoint", "fes:Within"); }},
        {"units of distances are ignored", "spatial_operators_select_components", ignores_units},
        {"frames are ignored", "unknown_names_in_conditions_are_refused", ignores_frames},
        {"the reference bound selects by name", "references_select_the_named_property",
         [] { return reads_reference_as_name("bound"); }},
        {"the reference status selects by name", "references_select_the_named_property",
         [] { return reads_reference_as_name("status"); }},
        {"the reference engine selects by name", "references_select_the_named_property",
         [] { return reads_reference_as_name("engine"); }},
        {"matchCase is ignored", "comparisons_are_case_sensitive_by_default", [] { return compares_case(true); }},
        {"comparisons are never case-sensitive", "comparisons_are_case_sensitive_by_default",
         [] { return compares_case(false); }},
        {"PropertyIsNull selects no component", "a_parameter_without_a_value_is_null", selects_nothing_as_null},
        {"PropertyIsNull selects every component", "a_parameter_without_a_value_is_null", selects_everything_as_null},
        {"SortBy is ignored", "search_results_can_be_sorted", ignores_sort_by},
        {"a stopped follow is reported as aborted", "follow_continues_until_stop",
         [] { return ends_follow_with("OK", "ABORT"); }},
        {"an exceeded time limit is reported as done", "follow_ends_at_its_time_limit",
         [] { return ends_follow_with("TIMEOUT", "OK"); }}};
}

}  // namespace rois::broken
