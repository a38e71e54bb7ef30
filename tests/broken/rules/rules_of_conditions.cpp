// The choices of conditions, and the end of Follow.
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

Breaking takes_for(std::string const& operation, char const* name, char const* other) {
    return edits_conditions(operation, name, [=](pugi::xml_node node) { node.set_name(other); });
}

void drop_attributes(pugi::xml_node node) {
    while (node.remove_attribute(node.first_attribute())) {
    }
}

Breaking knows_no_wildcards() {
    return edits_conditions("search", "fes:PropertyIsLike", [](pugi::xml_node node) {
        node.set_name("fes:PropertyIsEqualTo");
        drop_attributes(node);
    });
}

Breaking minds_the_case(bool always) {
    return edits_conditions("search", "fes:PropertyIsEqualTo", [=](pugi::xml_node node) {
        node.remove_attribute("matchCase");
        if (!always) node.append_attribute("matchCase").set_value(false);
    });
}

Breaking finds_nothing_null() {
    return edits_conditions("search", "fes:PropertyIsNull", [](pugi::xml_node node) {
        node.set_name("fes:PropertyIsEqualTo");
        node.child("fes:ValueReference").text().set("component_ref");
        node.append_child("fes:Literal").text().set("nobody");
    });
}

// Also selects components with a value.
Breaking finds_everything_null() {
    return edits_conditions("search", "fes:PropertyIsNull", [](pugi::xml_node node) {
        node.set_name("fes:PropertyIsNotEqualTo");
        node.child("fes:ValueReference").text().set("component_ref");
        node.append_child("fes:Literal").text().set("nobody");
    });
}

Breaking sorts_nothing() {
    return edits_requests("search", [](pugi::xml_node root) {
        auto condition = root.child("condition");
        if (!condition.remove_child("fes:SortBy")) return;
        if (!condition.first_child()) root.remove_child(condition);
    });
}

Breaking knows_no_units() {
    return edits_conditions("search", "fes:Distance", [](pugi::xml_node node) { node.attribute("uom").set_value("mm"); });
}

Breaking knows_no_frames() {
    return edits_conditions("search", "gml:Envelope", [](pugi::xml_node node) { node.remove_attribute("srsName"); });
}

// Leading zeros and decimal places count.
Breaking compares_texts() {
    return edits_conditions("get_event_detail", "fes:Literal", [](pugi::xml_node node) {
        std::string const text = node.text().get();
        if (text.starts_with("00") || text.ends_with(".0")) node.text().set("no number");
    });
}

Breaking passes_over_zones() {
    return edits_conditions("get_event_detail", "fes:Literal", [](pugi::xml_node node) {
        std::string const text = node.text().get();
        if (auto const zone = text.find("+01:00"); zone != std::string::npos)
            node.text().set((text.substr(0, zone) + "Z").c_str());
    });
}

// Replaces one reference by `name`.
Breaking takes_for_name(std::string const& reference) {
    return edits_conditions("search", "fes:ValueReference", [=](pugi::xml_node node) {
        if (node.text().get() == reference) node.text().set("name");
    });
}

// Follow's start always completes with this status.
Breaking ends_follow_with(char const* due, char const* status) {
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
            if (follows->contains(root.child("command_id").text().get()) && text.get() == std::string_view{due}) text.set(status);
        }).notification;
    return breaking;
}

}  // namespace

std::vector<BrokenRule> rules_of_conditions() {
    return {{"And is taken for Or", "logic_chooses_components", [] { return takes_for("search", "fes:And", "fes:Or"); }},
            {"not equal is taken for equal", "logic_chooses_components",
             [] { return takes_for("search", "fes:PropertyIsNotEqualTo", "fes:PropertyIsEqualTo"); }},
            {"Like knows no wildcards", "like_has_wildcards", knows_no_wildcards},
            {"numbers are compared as texts", "numbers_are_compared_as_numbers", compares_texts},
            {"at most is taken for less", "numbers_are_compared_as_numbers",
             [] { return takes_for("get_event_detail", "fes:PropertyIsLessThanOrEqualTo", "fes:PropertyIsLessThan"); }},
            {"zones of times are passed over", "times_are_compared_as_times", passes_over_zones},
            {"after is taken for before", "times_are_compared_as_times",
             [] { return takes_for("get_event_detail", "fes:After", "fes:Before"); }},
            {"Disjoint is taken for Within", "space_chooses_components",
             [] { return takes_for("search", "fes:Disjoint", "fes:Within"); }},
            {"units of distances are passed over", "space_chooses_components", knows_no_units},
            {"frames are passed over", "what_is_not_understood_is_named", knows_no_frames},
            {"bound means nothing", "references_mean_what_they_say", [] { return takes_for_name("bound"); }},
            {"status means nothing", "references_mean_what_they_say", [] { return takes_for_name("status"); }},
            {"engine means nothing", "references_mean_what_they_say", [] { return takes_for_name("engine"); }},
            {"matchCase is passed over", "case_counts_unless_it_is_said_not_to", [] { return minds_the_case(true); }},
            {"case never counts", "case_counts_unless_it_is_said_not_to", [] { return minds_the_case(false); }},
            {"nothing is null", "what_has_no_value_is_null", finds_nothing_null},
            {"everything is null", "what_has_no_value_is_null", finds_everything_null},
            {"nothing is sorted", "what_is_found_can_be_sorted", sorts_nothing},
            {"a stopped follow is reported as aborted", "follow_goes_on_until_it_is_stopped",
             [] { return ends_follow_with("OK", "ABORT"); }},
            {"an exceeded time limit is reported as done", "follow_ends_at_its_time_limit",
             [] { return ends_follow_with("TIMEOUT", "OK"); }}};
}

}  // namespace rois::broken
