// Queries (7.4.1.4, figure 12; tables 4, 21; decision 18).
#include <algorithm>
#include <regex>

#include "conformance/basic_messages.hpp"
#include "conformance/stage.hpp"

namespace rois::conformance {

namespace {

using kit::where;

// The results have the names and types of the profile; a result may be left out (tables 34 to 47 call some of them optional).
void require_results(Message const& query, Document const& answer) {
    auto const results = answer.values();
    for (auto const& [name, values] : results) {
        auto const found = std::ranges::find(query.results, name, &TypedName::name);
        require(found != query.results.end(), query.name + " has the result " + name + ", its profile has not");
        require(is_of_type(found->type, values),
                name + " of " + query.name + " is " + list(values) + ", its type is " + found->type);
    }
}

void every_query_of_every_component_is_answered(Stage& stage) {
    Guest guest{stage};
    for (auto const& component : stage.catalogue().components) {
        for (auto const& query : component.queries) {
            auto const answer = guest.query(query.name, only(component));
            if (answer.return_code() == "ERROR") continue;  // a component that has failed says so
            if (query.name == "get_stream_status" && answer.return_code() != "OK") continue;  // there is no stream
            same("the component that answers " + query.name, component.ref, ok(answer).ref());
            if (query.name != "get_parameter") require_results(query, answer);
            if (query.name == "component_status")
                require(answer.values().contains("status"), "component_status tells no status: " + answer.whole());
            auto const* const basic = basic_message(component.basic(), query.name);
            if (!basic) continue;
            auto const told = answer.values();
            for (auto const& due : basic->results)
                require(told.contains(due.name),
                        query.name + " of " + component.ref + " lacks its result " + due.name + ": " + answer.whole());
        }
    }
}

void a_query_needs_no_binding(Stage& stage) {
    auto const& component = *stage.two_common().first;
    Guest owner{stage}, other{stage};
    owner.take(component);
    ok(other.query("component_status", only(component)));
}

void a_query_goes_to_the_lowest_that_is_ready(Stage& stage) {
    Guest guest{stage}, rival{stage};
    auto const first = ok(guest.query("component_status")).ref();
    auto const* const component = stage.catalogue().find(first);
    require(component != nullptr, "the answer names " + first + ", which is not a component");
    if (guest.component_status(first) != "READY") throw NotPlayed{"no component with component_status is READY"};
    for (auto const& other : stage.catalogue().components)
        require(other.ref >= first || other.engine != component->engine || !other.is_common ||
                    guest.component_status(other.ref) != "READY",
                other.ref + " is READY and lower than " + first);
    rival.take(*component);
    require(ok(guest.query("component_status")).ref() != first, "a query prefers a component that is BUSY");
}

void an_unknown_query_is_unsupported(Stage& stage) {
    Guest guest{stage};
    refused(guest.query(nobody), "UNSUPPORTED");
    refused(guest.query("component_status", where(kit::equal("component_ref", nobody))), "UNSUPPORTED");
}

void a_query_for_an_unknown_reference_is_refused(Stage& stage) {
    Guest guest{stage};
    refused(guest.query("component_status", where(kit::equal(nobody, "red"))), "BAD_PARAMETER");
}

void located_results_have_their_structure(Stage& stage) {
    auto const& system = stage.one_of({"systeminformation"});
    Guest guest{stage};
    auto const answer = guest.query("robot_position", only(system));
    if (answer.return_code() != "OK") throw NotPlayed{"robot_position: " + answer.reason()};
    auto const results = answer.values();
    auto const texts = results.find("position_data");
    require(texts != results.end(), "robot_position tells no position_data: " + answer.whole());
    std::size_t located = 0;
    for (auto const one : answer.root().child("results").children("located"))
        located += one.attribute("of").value() == std::string{"position_data"};
    require(located == texts->second.size(), "each of position_data should have its element `located`: " + answer.whole());
}

void positions_are_points_in_a_frame(Stage& stage) {
    auto const& system = stage.one_of({"systeminformation"});
    Guest guest{stage};
    auto const answer = guest.query("robot_position", only(system));
    if (answer.return_code() != "OK") throw NotPlayed{"robot_position: " + answer.reason()};
    static std::regex const point{" *-?[0-9.]+ *, *-?[0-9.]+ *, *-?[0-9.]+ *"};
    auto const results = answer.root().child("results");
    auto const data = results.find_child_by_attribute("result", "rois:name", "position_data");
    for (auto const value : data.children("rois:value"))
        require(std::regex_match(value.text().get(), point),
                std::string{"a position is \"x, y, th\", not "} + value.text().get());
    std::string const frame = data.child("rois:data_type_ref").attribute("rois:codebook_ref").value();
    require(!frame.empty(), "the data_type_ref of position_data should name the frame: " + answer.whole());
    for (auto const located : results.children("located")) same("the crs of `located`", frame, located.attribute("crs").value());
}

}  // namespace

Clause query_clause() {
    return {"7.4.1.4 Query interface",
            {{"every_query_of_every_component_is_answered", "figure 12; tables 4, 17, 21, 33 to 47",
              every_query_of_every_component_is_answered},
             {"a_query_needs_no_binding", "figure 12; decision 5", a_query_needs_no_binding},
             {"a_query_goes_to_the_lowest_that_is_ready", "table 4; decision 18", a_query_goes_to_the_lowest_that_is_ready},
             {"an_unknown_query_is_unsupported", "table 1; decision 18", an_unknown_query_is_unsupported},
             {"a_query_for_an_unknown_reference_is_refused", "table 1; decision 18", a_query_for_an_unknown_reference_is_refused},
             {"positions_are_points_in_a_frame", "table 34; decision 27", positions_are_points_in_a_frame},
             {"located_results_have_their_structure", "table 34; decision 27", located_results_have_their_structure}}};
}

}  // namespace rois::conformance
