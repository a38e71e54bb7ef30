// Finding, binding and releasing components (7.4.2, figures 8, 9 and 11; table 3; decisions 4 to 7).
#include <algorithm>
#include <cctype>

#include "conformance/stage.hpp"

namespace rois::conformance {

namespace {

using kit::equal;
using kit::where;

void search_finds_all(Stage& stage) {
    Guest guest{stage};
    auto found = guest.search();
    std::ranges::sort(found);
    std::vector<std::string> all;
    for (auto const& component : stage.catalogue().components) all.push_back(component.ref);
    require(found == all, "search without a condition finds " + list(found) + ", the profile has " + list(all));
}

void search_finds_what_was_asked_for(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest guest{stage};
    auto const by_ref = guest.search(only(component));
    require(by_ref == std::vector{component.ref}, "only " + component.ref + " was asked for; found " + list(by_ref));
    for (auto const& ref : guest.search(where(equal("component_type", component.type)))) {
        auto const* const found = stage.catalogue().find(ref);
        require(found && found->basic() == component.basic(), ref + " is not of the type " + component.type);
    }
}

void component_types_are_compared_ignoring_case(Stage& stage) {
    auto const& component = *stage.two_common().first;
    auto type = component.type;
    std::ranges::transform(type, type.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    Guest guest{stage};
    auto const found = guest.search(where(equal("component_type", type)));
    require(std::ranges::find(found, component.ref) != found.end(),
            type + " should find " + component.ref + "; found " + list(found));
}

void conditions_know_their_references(Stage& stage) {
    Guest guest{stage};
    for (auto const* const reference : {"component_ref", "component_type", "name", "engine", "status", "bound"})
        ok(guest.ask("search", where(equal(reference, reference == std::string{"bound"} ? "true" : nobody))));
}

void references_mean_what_they_say(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest guest{stage};
    guest.take(component);
    auto const finds = [&](kit::Xml const& filter) {
        auto const found = guest.search(where(filter));
        return std::ranges::find(found, component.ref) != found.end();
    };
    require(finds(equal("bound", "true")), "bound = true does not find " + component.ref + ", which is bound");
    require(!finds(equal("bound", "false")), "bound = false finds " + component.ref + ", which is bound");
    require(!finds(equal("engine", nobody)), "engine = an unknown engine finds " + component.ref);
    require(component.engine.empty() || finds(equal("engine", component.engine)),
            "engine = " + component.engine + " does not find " + component.ref + ", which is of it");
    auto const status = guest.component_status(component.ref);
    require(finds(equal("status", status)), "status = " + status + " does not find " + component.ref + ", whose status it is");
    require(!finds(equal("status", nobody)), "status = an unknown status finds " + component.ref);
}

void conditions_combine(Stage& stage) {
    auto const [one, other] = stage.two_common();
    Guest guest{stage};
    auto const is_one = equal("component_ref", one->ref), is_other = kit::literal_first(other->ref, "component_ref");
    auto either = guest.search(where(kit::either(is_one, is_other)));
    std::ranges::sort(either);
    require(either == std::vector{one->ref, other->ref}, "one or the other was asked for; found " + list(either));
    auto const both = guest.search(where(kit::both(is_one, is_other)));
    require(both.empty(), "nothing is one and the other; found " + list(both));
    require(guest.search(where(kit::both(is_one, equal("name", one->ref)))) == std::vector{one->ref},
            "the name of " + one->ref + " is not its component_ref");
}

void search_without_a_match_is_an_empty_list(Stage& stage) {
    Guest guest{stage};
    auto const answer = ok(guest.ask("search", where(equal("component_ref", nobody))));
    require(!answer.root().child("component_ref_list").first_child(), "the list should be empty: " + answer.whole());
}

void bind_of_a_bound_component_returns_ok(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest guest{stage};
    guest.take(component);
    ok(guest.bind(component.ref));
}

void a_binding_is_exclusive(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest first{stage}, second{stage};
    first.take(component);
    refused(second.bind(component.ref), "OUT_OF_RESOURCES");
    ok(first.get_parameter(component.ref));
    refused(second.get_parameter(component.ref), "ERROR");
}

void bind_of_an_unknown_component_is_refused(Stage& stage) {
    Guest guest{stage};
    refused(guest.bind(nobody), "BAD_PARAMETER");
    refused(guest.release(nobody), "BAD_PARAMETER");
    refused(guest.get_parameter(nobody), "BAD_PARAMETER");
    refused(guest.set_parameter(nobody, {}), "BAD_PARAMETER");
}

void bind_any_binds_what_matches(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest guest{stage}, rival{stage};
    auto const answer = guest.ask("bind_any", only(component));
    if (answer.return_code() == "OUT_OF_RESOURCES") throw NotPlayed{"another application uses " + component.ref};
    same("the component", component.ref, ok(answer).ref());
    ok(guest.get_parameter(component.ref));
    refused(rival.bind(component.ref), "OUT_OF_RESOURCES");
}

void bind_any_takes_a_free_one_before_mine(Stage& stage) {
    auto const [one, other] = stage.two_common();
    if (one->engine != other->engine) throw NotPlayed{"no engine has two components with start and stop"};
    Guest guest{stage};
    auto const either = where(kit::either(equal("component_ref", one->ref), equal("component_ref", other->ref)));
    auto const bound = [&] { return ok(guest.ask("bind_any", either)).ref(); };
    guest.take(*one);
    guest.take(*other);
    ok(guest.release(one->ref));
    ok(guest.release(other->ref));
    same("the lowest of two that are free", std::min(one->ref, other->ref), bound());
    same("the one that is free", std::max(one->ref, other->ref), bound());
    same("the lowest when both are mine", std::min(one->ref, other->ref), bound());
}

void bind_any_says_why_not(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest guest{stage}, rival{stage};
    refused(guest.ask("bind_any", where(equal("component_ref", nobody))), "UNSUPPORTED");
    rival.take(component);
    refused(guest.ask("bind_any", only(component)), "OUT_OF_RESOURCES");
}

void commands_need_the_binding(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest guest{stage};
    refused(guest.get_parameter(component.ref), "ERROR");
    refused(guest.set_parameter(component.ref, {}), "ERROR");
    refused(guest.execute(command(component, "stop")), "ERROR");
}

void after_release_nothing_is_allowed(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest guest{stage}, next{stage};
    guest.take(component);
    ok(guest.release(component.ref));
    refused(guest.get_parameter(component.ref), "ERROR");
    refused(guest.set_parameter(component.ref, {}), "ERROR");
    refused(guest.execute(command(component, "stop")), "ERROR");
    next.take(component);
}

void release_of_an_unbound_component_has_no_effect(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest owner{stage}, other{stage};
    ok(other.release(component.ref));
    owner.take(component);
    ok(other.release(component.ref));
    ok(owner.get_parameter(component.ref));
}

void release_stops_what_runs(Stage& stage) {
    auto const& speaker = stage.speaker();
    Guest guest{stage};
    guest.take(speaker);
    auto const id = guest.order(long_speech(speaker, ""));
    ok(guest.release(speaker.ref));
    same("the status of the speech", "ABORT", guest.status_of(id));
    guest.take(speaker);
    same("the status of a suspended component without a running command", "ERROR", guest.ending(command(speaker, "suspend")));
}

void a_bound_component_is_busy_for_others(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest owner{stage}, other{stage};
    owner.take(component);
    same("the status for another application", "BUSY", other.component_status(component.ref));
    require(owner.component_status(component.ref) != "BUSY", "a component is BUSY for the one that has it bound");
    ok(owner.release(component.ref));
    require(other.component_status(component.ref) != "BUSY", "a component without an owner is BUSY");
}

}  // namespace

Clause binding_clause() {
    return {"7.4.2 Command interface: search, bind, release",
            {{"search_finds_all", "figure 9; table 3", search_finds_all},
             {"search_finds_what_was_asked_for", "figure 9; table 3; decision 25", search_finds_what_was_asked_for},
             {"component_types_are_compared_ignoring_case", "decision 25", component_types_are_compared_ignoring_case},
             {"conditions_know_their_references", "table 3; decision 18", conditions_know_their_references},
             {"references_mean_what_they_say", "table 3; decision 18", references_mean_what_they_say},
             {"conditions_combine", "table 3; ISO 19143: And, Or", conditions_combine},
             {"search_without_a_match_is_an_empty_list", "table 3; decision 4", search_without_a_match_is_an_empty_list},
             {"bind_of_a_bound_component_returns_ok", "figure 9; decision 4", bind_of_a_bound_component_returns_ok},
             {"a_binding_is_exclusive", "figure 8; decision 4", a_binding_is_exclusive},
             {"bind_of_an_unknown_component_is_refused", "table 3; decisions 4, 6", bind_of_an_unknown_component_is_refused},
             {"bind_any_binds_what_matches", "figure 9; decision 4", bind_any_binds_what_matches},
             {"bind_any_takes_a_free_one_before_mine", "figure 9; decision 6", bind_any_takes_a_free_one_before_mine},
             {"bind_any_says_why_not", "table 1; decision 4", bind_any_says_why_not},
             {"commands_need_the_binding", "figure 8; table 3; decision 5", commands_need_the_binding},
             {"after_release_nothing_is_allowed", "figures 8, 11; decision 6", after_release_nothing_is_allowed},
             {"release_of_an_unbound_component_has_no_effect", "figure 11; decision 6",
              release_of_an_unbound_component_has_no_effect},
             {"release_stops_what_runs", "figure 11; decision 6", release_stops_what_runs},
             {"a_bound_component_is_busy_for_others", "table 33; decision 7", a_bound_component_is_busy_for_others}}};
}

}  // namespace rois::conformance
