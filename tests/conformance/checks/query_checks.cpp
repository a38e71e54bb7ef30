// Queries (7.4.1.4, figure 12; tables 4, 21; decision 18).
#include <algorithm>
#include <regex>

#include "conformance/basic_messages.hpp"
#include "conformance/context.hpp"

namespace rois::conformance {

namespace {

using kit::where;

// Requires results with names and types from the profile. Some results are optional (tables 34 to 47).
void require_results(Message const& query, Document const& answer) {
    auto const results = answer.values();
    for (auto const& [name, values] : results) {
        auto const found = std::ranges::find(query.results, name, &TypedName::name);
        require(found != query.results.end(), "the profile lacks the result " + name + " of " + query.name);
        require(is_of_type(found->type, values),
                name + " of " + query.name + ": expected a value of type " + found->type + ", got " + list(values));
    }
}

void every_query_of_every_component_is_answered(Context& context) {
    Client client{context};
    for (auto const& component : context.catalogue().components) {
        for (auto const& query : component.queries) {
            auto const answer = client.query(query.name, only(component));
            if (answer.return_code() == "ERROR") continue;                                    // the component has failed
            if (query.name == "get_stream_status" && answer.return_code() != "OK") continue;  // no stream is connected
            require_equal("the component that answers " + query.name, component.ref, require_ok(answer).ref());
            if (query.name != "get_parameter") require_results(query, answer);
            if (query.name == "component_status")
                require(answer.values().contains("status"),
                        "component_status: expected the result status, got " + answer.whole());
            auto const* const basic = basic_message(component.basic(), query.name);
            if (!basic) continue;
            auto const reported = answer.values();
            for (auto const& expected : basic->results)
                require(reported.contains(expected.name), query.name + " of " + component.ref + ": expected the result " +
                                                              expected.name + ", got " + answer.whole());
        }
    }
}

void a_query_needs_no_binding(Context& context) {
    auto const& component = *context.two_common_components().first;
    Client owner{context}, other{context};
    owner.bind_or_skip(component);
    require_ok(other.query("component_status", only(component)));
}

void the_first_ready_component_answers_a_query(Context& context) {
    Client client{context}, competitor{context};
    auto const first = require_ok(client.query("component_status")).ref();
    auto const* const component = context.catalogue().find(first);
    require(component != nullptr, "component_status: expected a known component_ref, got " + first);
    if (client.component_status(first) != "READY") throw Skipped{"no component is READY"};
    for (auto const& other : context.catalogue().components)
        require(other.ref >= first || other.engine != component->engine || !other.is_common ||
                    client.component_status(other.ref) != "READY",
                "component_status: expected the answer of " + other.ref + ", the first READY component, got " + first);
    competitor.bind_or_skip(*component);
    require(require_ok(client.query("component_status")).ref() != first,
            "component_status: expected the answer of a READY component, got " + first + ", which is BUSY");
}

void an_unknown_query_is_unsupported(Context& context) {
    Client client{context};
    require_refusal(client.query(unknown_name), "UNSUPPORTED");
    require_refusal(client.query("component_status", where(kit::equal("component_ref", unknown_name))), "UNSUPPORTED");
}

void a_query_with_an_unknown_reference_is_refused(Context& context) {
    Client client{context};
    require_refusal(client.query("component_status", where(kit::equal(unknown_name, "red"))), "BAD_PARAMETER");
}

void positions_have_located_elements(Context& context) {
    auto const& system = context.component_of_kind({"systeminformation"});
    Client client{context};
    auto const answer = client.query("robot_position", only(system));
    if (answer.return_code() != "OK") throw Skipped{"robot_position: " + answer.reason()};
    auto const results = answer.values();
    auto const texts = results.find("position_data");
    require(texts != results.end(), "robot_position: expected the result position_data, got " + answer.whole());
    std::size_t located = 0;
    for (auto const one : answer.root().child("results").children("located"))
        located += one.attribute("of").value() == std::string{"position_data"};
    require(located == texts->second.size(),
            "robot_position: expected an element `located` for each position, got " + answer.whole());
}

void positions_are_points_in_a_frame(Context& context) {
    auto const& system = context.component_of_kind({"systeminformation"});
    Client client{context};
    auto const answer = client.query("robot_position", only(system));
    if (answer.return_code() != "OK") throw Skipped{"robot_position: " + answer.reason()};
    static std::regex const point{" *-?[0-9.]+ *, *-?[0-9.]+ *, *-?[0-9.]+ *"};
    auto const results = answer.root().child("results");
    auto const data = results.find_child_by_attribute("result", "rois:name", "position_data");
    for (auto const value : data.children("rois:value"))
        require(std::regex_match(value.text().get(), point),
                std::string{"position_data: '"} + value.text().get() + "' is not a position: expected \"x, y, th\"");
    std::string const frame = data.child("rois:data_type_ref").attribute("rois:codebook_ref").value();
    require(!frame.empty(), "position_data: expected the frame as codebook_ref of its data_type_ref, got " + answer.whole());
    for (auto const located : results.children("located"))
        require_equal("the crs of `located`", frame, located.attribute("crs").value());
}

}  // namespace

Clause query_clause() {
    return {
        "7.4.1.4 Query interface",
        {{"every_query_of_every_component_is_answered", "figure 12; tables 4, 17, 21, 33 to 47",
          every_query_of_every_component_is_answered},
         {"a_query_needs_no_binding", "figure 12; decision 5", a_query_needs_no_binding},
         {"the_first_ready_component_answers_a_query", "table 4; decision 18", the_first_ready_component_answers_a_query},
         {"an_unknown_query_is_unsupported", "table 1; decision 18", an_unknown_query_is_unsupported},
         {"a_query_with_an_unknown_reference_is_refused", "table 1; decision 18", a_query_with_an_unknown_reference_is_refused},
         {"positions_are_points_in_a_frame", "table 34; decision 27", positions_are_points_in_a_frame},
         {"positions_have_located_elements", "table 34; decision 27", positions_have_located_elements}}};
}

}  // namespace rois::conformance
