// Finding, binding and releasing components (7.4.2, figures 8, 9 and 11; table 3; decisions 4 to 7).
#include <algorithm>
#include <cctype>

#include "conformance/context.hpp"

namespace rois::conformance {

namespace {

using kit::equal;
using kit::where;

void search_without_a_condition_returns_all_components(Context& context) {
    Client client{context};
    auto found = client.search();
    std::ranges::sort(found);
    std::vector<std::string> all;
    for (auto const& component : context.catalogue().components) all.push_back(component.ref);
    require(found == all, "search without a condition: expected " + list(all) + " from the profile, got " + list(found));
}

void search_returns_only_matching_components(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client client{context};
    auto const by_ref = client.search(only(component));
    require(by_ref == std::vector{component.ref},
            "search for component_ref = " + component.ref + ": expected only this component, got " + list(by_ref));
    for (auto const& ref : client.search(where(equal("component_type", component.type)))) {
        auto const* const found = context.catalogue().find(ref);
        require(found && found->basic() == component.basic(),
                "search for component_type = " + component.type + " returned " + ref + ", which has another type");
    }
}

void component_types_are_compared_ignoring_case(Context& context) {
    auto const& component = *context.two_common_components().first;
    auto type = component.type;
    std::ranges::transform(type, type.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    Client client{context};
    auto const found = client.search(where(equal("component_type", type)));
    require(std::ranges::find(found, component.ref) != found.end(),
            "search for component_type = " + type + ": expected " + component.ref + ", got " + list(found));
}

void known_references_are_accepted(Context& context) {
    Client client{context};
    for (auto const* const reference : {"component_ref", "component_type", "name", "engine", "status", "bound"})
        require_ok(client.ask("search", where(equal(reference, reference == std::string{"bound"} ? "true" : unknown_name))));
}

void references_select_the_named_property(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client client{context};
    client.bind_or_skip(component);
    auto const finds = [&](kit::Xml const& filter) {
        auto const found = client.search(where(filter));
        return std::ranges::find(found, component.ref) != found.end();
    };
    require(finds(equal("bound", "true")), "search for bound = true: expected " + component.ref + ", which is bound");
    require(!finds(equal("bound", "false")), "search for bound = false returned " + component.ref + ", which is bound");
    require(!finds(equal("engine", unknown_name)), "search for an unknown engine returned " + component.ref);
    require(component.engine.empty() || finds(equal("engine", component.engine)),
            "search for engine = " + component.engine + ": expected " + component.ref + ", a component of this engine");
    auto const status = client.component_status(component.ref);
    require(finds(equal("status", status)),
            "search for status = " + status + ": expected " + component.ref + ", which has this status");
    require(!finds(equal("status", unknown_name)), "search for an unknown status returned " + component.ref);
}

void and_or_combine_conditions(Context& context) {
    auto const [one, other] = context.two_common_components();
    Client client{context};
    auto const is_one = equal("component_ref", one->ref), is_other = kit::literal_first(other->ref, "component_ref");
    auto either = client.search(where(kit::either(is_one, is_other)));
    std::ranges::sort(either);
    require(either == std::vector{one->ref, other->ref},
            "search for " + one->ref + " Or " + other->ref + ": expected both, got " + list(either));
    auto const both = client.search(where(kit::both(is_one, is_other)));
    require(both.empty(), "search for " + one->ref + " And " + other->ref + ": expected no component, got " + list(both));
    require(client.search(where(kit::both(is_one, equal("name", one->ref)))) == std::vector{one->ref},
            "search for component_ref = " + one->ref + " And name = " + one->ref + ": expected this component");
}

void search_without_a_match_returns_an_empty_list(Context& context) {
    Client client{context};
    auto const answer = require_ok(client.ask("search", where(equal("component_ref", unknown_name))));
    require(!answer.root().child("component_ref_list").first_child(),
            "expected an empty component_ref_list, got " + answer.whole());
}

void bind_of_a_bound_component_returns_ok(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client client{context};
    client.bind_or_skip(component);
    require_ok(client.bind(component.ref));
}

void a_binding_is_exclusive(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client first{context}, second{context};
    first.bind_or_skip(component);
    require_refusal(second.bind(component.ref), "OUT_OF_RESOURCES");
    require_ok(first.get_parameter(component.ref));
    require_refusal(second.get_parameter(component.ref), "ERROR");
}

void bind_of_an_unknown_component_is_refused(Context& context) {
    Client client{context};
    require_refusal(client.bind(unknown_name), "BAD_PARAMETER");
    require_refusal(client.release(unknown_name), "BAD_PARAMETER");
    require_refusal(client.get_parameter(unknown_name), "BAD_PARAMETER");
    require_refusal(client.set_parameter(unknown_name, {}), "BAD_PARAMETER");
}

void bind_any_binds_a_matching_component(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client client{context}, competitor{context};
    auto const answer = client.ask("bind_any", only(component));
    if (answer.return_code() == "OUT_OF_RESOURCES") throw Skipped{"another application uses " + component.ref};
    require_equal("the component", component.ref, require_ok(answer).ref());
    require_ok(client.get_parameter(component.ref));
    require_refusal(competitor.bind(component.ref), "OUT_OF_RESOURCES");
}

void bind_any_prefers_a_free_component(Context& context) {
    auto const [one, other] = context.two_common_components();
    if (one->engine != other->engine) throw Skipped{"no engine has two components with start and stop"};
    Client client{context};
    auto const either = where(kit::either(equal("component_ref", one->ref), equal("component_ref", other->ref)));
    auto const bound = [&] { return require_ok(client.ask("bind_any", either)).ref(); };
    client.bind_or_skip(*one);
    client.bind_or_skip(*other);
    require_ok(client.release(one->ref));
    require_ok(client.release(other->ref));
    require_equal("bind_any of two free components", std::min(one->ref, other->ref), bound());
    require_equal("bind_any of a bound and a free component", std::max(one->ref, other->ref), bound());
    require_equal("bind_any of two components that this application has bound", std::min(one->ref, other->ref), bound());
}

void bind_any_distinguishes_bound_from_unknown_components(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client client{context}, competitor{context};
    require_refusal(client.ask("bind_any", where(equal("component_ref", unknown_name))), "UNSUPPORTED");
    competitor.bind_or_skip(component);
    require_refusal(client.ask("bind_any", only(component)), "OUT_OF_RESOURCES");
}

void commands_need_a_binding(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client client{context};
    require_refusal(client.get_parameter(component.ref), "ERROR");
    require_refusal(client.set_parameter(component.ref, {}), "ERROR");
    require_refusal(client.execute(command(component, "stop")), "ERROR");
}

void commands_are_refused_after_release(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client client{context}, next{context};
    client.bind_or_skip(component);
    require_ok(client.release(component.ref));
    require_refusal(client.get_parameter(component.ref), "ERROR");
    require_refusal(client.set_parameter(component.ref, {}), "ERROR");
    require_refusal(client.execute(command(component, "stop")), "ERROR");
    next.bind_or_skip(component);
}

void release_of_an_unbound_component_has_no_effect(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client owner{context}, other{context};
    require_ok(other.release(component.ref));
    owner.bind_or_skip(component);
    require_ok(other.release(component.ref));
    require_ok(owner.get_parameter(component.ref));
}

void release_stops_the_running_command(Context& context) {
    auto const& speaker = context.speaker();
    Client client{context};
    client.bind_or_skip(speaker);
    auto const id = client.execute_one(long_speech(speaker, ""));
    require_ok(client.release(speaker.ref));
    require_equal("the status of the speech", "ABORT", client.status_of(id));
    client.bind_or_skip(speaker);
    require_equal("the status of suspend without a running command", "ERROR", client.run(command(speaker, "suspend")));
}

void a_bound_component_is_busy_for_others(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client owner{context}, other{context};
    owner.bind_or_skip(component);
    require_equal("the status for another application", "BUSY", other.component_status(component.ref));
    require(owner.component_status(component.ref) != "BUSY", "component_status of a bound component is BUSY for its owner");
    require_ok(owner.release(component.ref));
    require(other.component_status(component.ref) != "BUSY", "component_status of a released component is BUSY");
}

}  // namespace

Clause binding_clause() {
    return {
        "7.4.2 Command interface: search, bind, release",
        {{"search_without_a_condition_returns_all_components", "figure 9; table 3",
          search_without_a_condition_returns_all_components},
         {"search_returns_only_matching_components", "figure 9; table 3; decision 25", search_returns_only_matching_components},
         {"component_types_are_compared_ignoring_case", "decision 25", component_types_are_compared_ignoring_case},
         {"known_references_are_accepted", "table 3; decision 18", known_references_are_accepted},
         {"references_select_the_named_property", "table 3; decision 18", references_select_the_named_property},
         {"and_or_combine_conditions", "table 3; ISO 19143: And, Or", and_or_combine_conditions},
         {"search_without_a_match_returns_an_empty_list", "table 3; decision 4", search_without_a_match_returns_an_empty_list},
         {"bind_of_a_bound_component_returns_ok", "figure 9; decision 4", bind_of_a_bound_component_returns_ok},
         {"a_binding_is_exclusive", "figure 8; decision 4", a_binding_is_exclusive},
         {"bind_of_an_unknown_component_is_refused", "table 3; decisions 4, 6", bind_of_an_unknown_component_is_refused},
         {"bind_any_binds_a_matching_component", "figure 9; decision 4", bind_any_binds_a_matching_component},
         {"bind_any_prefers_a_free_component", "figure 9; decision 6", bind_any_prefers_a_free_component},
         {"bind_any_distinguishes_bound_from_unknown_components", "table 1; decision 4",
          bind_any_distinguishes_bound_from_unknown_components},
         {"commands_need_a_binding", "figure 8; table 3; decision 5", commands_need_a_binding},
         {"commands_are_refused_after_release", "figures 8, 11; decision 6", commands_are_refused_after_release},
         {"release_of_an_unbound_component_has_no_effect", "figure 11; decision 6",
          release_of_an_unbound_component_has_no_effect},
         {"release_stops_the_running_command", "figure 11; decision 6", release_stops_the_running_command},
         {"a_bound_component_is_busy_for_others", "table 33; decision 7", a_bound_component_is_busy_for_others}}};
}

}  // namespace rois::conformance
