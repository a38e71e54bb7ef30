// Conditions (ISO 19143; table 4 and all other arguments that are conditions; decisions 4, 18, 19). `search` shows which
// components a condition selects, get_event_detail which results.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>
#include <string_view>
#include <vector>

#include "conformance/context.hpp"

namespace rois::conformance {

namespace {

using kit::compared;
using kit::equal;
using kit::negation;
using kit::where;

using Refs = std::vector<std::string>;

Refs found(Client& client, kit::Xml const& condition) {
    auto refs = client.search(condition);
    std::ranges::sort(refs);
    return refs;
}

// Returns whether the gateway refused the condition. A gateway must support the Minimum Standard Filter of ISO 19143 (And, Or,
// Not and six comparisons), and may refuse all other operators.
bool is_refused(Document const& answer) {
    return answer.return_code() == "BAD_PARAMETER" || answer.return_code() == "UNSUPPORTED";
}

// Throws Skipped if the gateway refuses a search with this condition, which uses an optional operator.
void skip_unless_supported(Client& client, std::string const& operation, kit::Xml const& condition) {
    auto const answer = client.ask("search", condition);
    if (is_refused(answer)) throw Skipped{"the gateway does not support " + operation + ": " + answer.reason()};
}

void same_refs(std::string const& what, Refs const& expected, Refs const& found) {
    require(expected == found, "search with " + what + ": expected " + list(expected) + ", got " + list(found));
}

// Returns the sorted refs of all components for which the predicate holds.
template <typename Predicate>
Refs refs_of(Context const& context, Predicate holds) {
    Refs refs;
    for (auto const& component : context.catalogue().components)
        if (holds(component)) refs.push_back(component.ref);
    return refs;
}

void and_or_not_select_components(Context& context) {
    Client client{context};
    auto const [one, other] = context.two_common_components();
    auto const is_one = equal("component_ref", one->ref), is_other = equal("component_ref", other->ref);
    auto const but_one = refs_of(context, [&](Component const& component) { return component.ref != one->ref; });
    same_refs("Or", {std::min(one->ref, other->ref), std::max(one->ref, other->ref)},
              found(client, where(kit::either(is_one, is_other))));
    same_refs("And of two different component_refs", {}, found(client, where(kit::both(is_one, is_other))));
    same_refs("Not", but_one, found(client, where(negation(is_one))));
    same_refs("PropertyIsNotEqualTo", but_one, found(client, where(compared("NotEqualTo", "component_ref", one->ref))));
    same_refs("Not within And", {one->ref}, found(client, where(kit::both(is_one, negation(is_other)))));
}

void operands_may_be_in_either_order(Context& context) {
    Client client{context};
    auto const& ref = context.two_common_components().first->ref;
    same_refs("a literal before the reference", {ref}, found(client, where(kit::literal_first(ref, "component_ref"))));
}

std::string upper(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

void a_condition_on_the_component_type_ignores_case(Context& context) {
    Client client{context};
    auto const& one = *context.two_common_components().first;
    auto const type = upper(one.type);
    auto const expected = refs_of(context, [&](Component const& component) { return component.type == one.type; });
    same_refs("component_type = " + type, expected, found(client, where(equal("component_type", type))));
}

void comparisons_are_case_sensitive_by_default(Context& context) {
    Client client{context};
    auto const& ref = context.two_common_components().first->ref;
    auto const other = upper(ref);
    if (other == ref) throw Skipped{ref + " has no lower-case letters"};
    auto const same_name = refs_of(context, [&](Component const& component) { return component.ref == other; });
    auto const same_letters = refs_of(context, [&](Component const& component) { return upper(component.ref) == other; });
    auto const filter = equal("component_ref", other);
    same_refs("component_ref = " + other, same_name, found(client, where(filter)));
    same_refs("component_ref = " + other + " with matchCase=\"true\"", same_name,
              found(client, where(filter.with("matchCase", "true"))));
    same_refs("component_ref = " + other + " with matchCase=\"false\"", same_letters,
              found(client, where(filter.with("matchCase", "false"))));
}

// A parameter is null for components that lack it, and not null after it has been set.
void a_parameter_without_a_value_is_null(Context& context) {
    Client client{context};
    auto const number = number_parameter_of(context);
    client.bind_or_skip(*number.component);
    require_ok(client.set_parameter(number.component->ref, {with_value(number, 50)}));
    client.flush_notifications(*number.component);
    auto const is_null = kit::is_null("Property/" + number.name);
    skip_unless_supported(client, "PropertyIsNull", where(is_null));
    auto const null = found(client, where(is_null)), others = found(client, where(negation(is_null)));
    for (auto const& component : context.catalogue().components) {
        bool const among_null = std::ranges::binary_search(null, component.ref);
        bool const among_others = std::ranges::binary_search(others, component.ref);
        auto const parameter = number.name + " of " + component.ref;
        require(among_null != among_others, parameter + ": expected to match either PropertyIsNull or its negation, matches " +
                                                (among_null ? "both" : "neither"));
        require(among_null || component.parameter(number.name),
                parameter + ": expected null, because the component lacks this parameter");
    }
    require(std::ranges::binary_search(others, number.component->ref),
            number.name + " of " + number.component->ref + ": expected not null after set_parameter");
}

// Splits a UTF-8 text into its characters.
std::vector<std::string_view> characters_of(std::string_view text) {
    std::vector<std::string_view> characters;
    for (std::size_t begin = 0; begin < text.size();) {
        auto end = begin + 1;
        while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) ++end;
        characters.push_back(text.substr(begin, end - begin));
        begin = end;
    }
    return characters;
}

// Escapes the wildcards of a pattern.
std::string escaped(std::string_view text) {
    std::string pattern;
    for (char const c : text) {
        if (c == '*' || c == '?' || c == '!') pattern += '!';
        pattern += c;
    }
    return pattern;
}

void like_supports_wildcards(Context& context) {
    Client client{context};
    auto const& ref = context.two_common_components().first->ref;
    auto const first_size = characters_of(ref).front().size(), last_size = characters_of(ref).back().size();
    auto const tail = ref.substr(first_size), head = ref.substr(0, ref.size() - last_size);
    auto const ends = refs_of(context, [&](Component const& component) { return component.ref.ends_with(tail); });
    auto const begins = refs_of(context, [&](Component const& component) { return component.ref.starts_with(head); });
    auto const one_before = refs_of(context, [&](Component const& component) {
        bool const as_long = characters_of(component.ref).size() == characters_of(ref).size();
        return as_long && component.ref.ends_with(tail);
    });
    skip_unless_supported(client, "PropertyIsLike", where(kit::like("component_ref", "*")));
    auto const like = [&](std::string const& pattern) { return found(client, where(kit::like("component_ref", pattern))); };
    same_refs("component_ref like *" + tail, ends, like("*" + escaped(tail)));
    same_refs("component_ref like " + head + "*", begins, like(escaped(head) + "*"));
    same_refs("component_ref like ?" + tail, one_before, like("?" + escaped(tail)));
    auto const starred = refs_of(context, [&](Component const& component) { return component.ref == "*" + tail; });
    same_refs("component_ref like !*" + tail, starred, like("!*" + escaped(tail)));
}

void a_resource_id_selects_a_component(Context& context) {
    Client client{context};
    auto const& ref = context.two_common_components().first->ref;
    auto const condition = where(kit::element("fes:ResourceId", {{"rid", ref}}));
    skip_unless_supported(client, "ResourceId", condition);
    same_refs("ResourceId", {ref}, found(client, condition));
}

void search_results_can_be_sorted(Context& context) {
    Client client{context};
    auto const all = refs_of(context, [](Component const&) { return true; });
    skip_unless_supported(client, "SortBy", kit::ordered("", kit::sorted_by("component_ref", "ASC")));
    auto rising = client.search(kit::ordered("", kit::sorted_by("component_ref", "ASC")));
    auto falling = client.search(kit::ordered("", kit::sorted_by("component_ref", "DESC")));
    auto sorted = rising;
    std::ranges::sort(sorted);
    same_refs("SortBy alone", all, sorted);
    require(std::ranges::is_sorted(rising), "SortBy component_ref: expected ascending order, got " + list(rising));
    std::ranges::reverse(falling);
    same_refs("SortBy DESC, reversed,", rising, falling);
}

void the_published_search_condition_is_accepted(Context& context) {
    Client client{context};
    auto const& one = *context.two_common_components().first;
    auto const expected = refs_of(context, [&](Component const& component) { return component.type == one.type; });
    same_refs("unr:SearchCondition of the type " + one.type, expected, found(client, kit::of_type(one.type)));
}

void unknown_names_in_conditions_are_refused(Context& context) {
    Client client{context};
    auto const box = kit::box("0 0", "1 1");
    require_refusal(client.ask("search", where(equal(unknown_name, "red"))), "BAD_PARAMETER");
    require_refusal(client.ask("search", where(kit::undefined_function("location"))), "BAD_PARAMETER");
    require_refusal(client.ask("search", where(kit::related("DWithin", "location", box + kit::distance("1", unknown_name)))),
                    "BAD_PARAMETER");
    require_refusal(client.ask("search", where(kit::related("Within", "location", kit::box("0 0", "1 1", "urn:nowhere")))),
                    "BAD_PARAMETER");
}

// The details of a detection: a number and a time.
class Detection {
public:
    explicit Detection(Context& context) : owner_{context} {
        auto const& detector = context.detector();
        owner_.bind_or_skip(detector);
        auto const type = detector.detection_event();
        require_ok(owner_.subscribe(type, only(detector)));
        id_ = owner_.start_and_receive(detector, type).text("event_id");
        auto const results = require_ok(owner_.get_event_detail(id_)).values();
        auto const text = value_of(results, "number");
        auto const read = std::from_chars(text.data(), text.data() + text.size(), number);
        require(read.ec == std::errc{},
                "the number of a detection (tables 35, 38, 40): expected a whole number, got '" + text + "'");
        timestamp = value_of(results, "timestamp");
    }

    void holds(kit::Xml const& filter) { expect(filter, true); }
    void does_not_hold(kit::Xml const& filter) { expect(filter, false); }
    // Both functions check nothing if the gateway refuses the operator.
    void holds_if_supported(kit::Xml const& filter) {
        if (supports(filter)) expect(filter, true);
    }
    void does_not_hold_if_supported(kit::Xml const& filter) {
        if (supports(filter)) expect(filter, false);
    }

    int number = 0;
    std::string timestamp;

private:
    bool supports(kit::Xml const& filter) { return !is_refused(owner_.get_event_detail(id_, where(filter))); }

    void expect(kit::Xml const& filter, bool expected) {
        bool const has_results = !require_ok(owner_.get_event_detail(id_, where(filter))).values().empty();
        require(has_results == expected, "for a detection with number " + std::to_string(number) + " and timestamp " + timestamp +
                                             ", expected this condition " + (expected ? "" : "not ") +
                                             "to hold: " + filter.text());
    }

    Client owner_;
    std::string id_;
};

kit::Xml number_between(int low, int high) { return kit::between("number", std::to_string(low), std::to_string(high)); }

void numbers_are_compared_by_value(Context& context) {
    Detection detection{context};
    auto const number = detection.number;
    auto const than = [](int value) { return std::to_string(value); };
    detection.holds(equal("number", than(number) + ".0"));
    detection.holds(equal("number", "00" + than(number)));
    detection.does_not_hold(equal("number", than(number + 1)));
    detection.holds(compared("LessThan", "number", "1" + than(number) + "0"));
    detection.does_not_hold(compared("LessThan", "number", than(number)));
    detection.holds(compared("LessThanOrEqualTo", "number", than(number)));
    detection.holds(compared("GreaterThan", "number", "-5"));
    detection.does_not_hold(compared("GreaterThan", "number", than(number)));
    detection.holds(compared("GreaterThanOrEqualTo", "number", than(number)));
    detection.holds_if_supported(number_between(number, number));
    detection.does_not_hold_if_supported(number_between(number + 1, number + 9));
    detection.does_not_hold_if_supported(kit::is_null("number"));
    detection.holds_if_supported(negation(kit::is_null("number")));
}

kit::Xml instant(std::string const& time) {
    return kit::element("gml:TimeInstant", {{"gml:id", "t"}}, kit::text_element("gml:timePosition", time));
}

kit::Xml period(std::string const& begin, std::string const& end) {
    return kit::element("gml:TimePeriod", {{"gml:id", "p"}},
                        kit::text_element("gml:beginPosition", begin) + kit::text_element("gml:endPosition", end));
}

kit::Xml timed(std::string const& relation, kit::Xml const& time) {
    return kit::related(relation, "timestamp", time).with("xmlns:gml", "http://www.opengis.net/gml/3.2");
}

void times_are_compared_by_value(Context& context) {
    Detection detection{context};
    detection.holds_if_supported(timed("After", instant("2011-05-23T00:00:00Z")));
    detection.does_not_hold_if_supported(timed("Before", instant("2011-05-23T00:00:00Z")));
    detection.holds_if_supported(timed("Before", instant("9000-01-01T00:00:00Z")));
    detection.holds_if_supported(timed("TEquals", instant(detection.timestamp)));
    detection.holds_if_supported(timed("During", period("2011-05-23T00:00:00Z", "9000-01-01T00:00:00Z")));
    detection.does_not_hold_if_supported(timed("During", period("2011-05-23T00:00:00Z", "2011-05-24T00:00:00Z")));
    auto const without_zone = detection.timestamp.substr(0, detection.timestamp.size() - 1);
    detection.holds(equal("timestamp", without_zone + "+00:00"));
    detection.does_not_hold(equal("timestamp", without_zone + "+01:00"));
}

// Boxes and points at the reported position of a robot, or `dx` millimetres away. The boxes are much larger than any measurement
// error.
struct Surroundings {
    Component const* system;
    double x, y;

    kit::Xml box_at(double dx) const {
        return kit::box(std::to_string(x + dx - 5'000) + " " + std::to_string(y - 5'000),
                        std::to_string(x + dx + 5'000) + " " + std::to_string(y + 5'000));
    }
    kit::Xml point_at(double dx) const {
        return kit::element("gml:Point", {{"xmlns:gml", "http://www.opengis.net/gml/3.2"}},
                            kit::text_element("gml:pos", std::to_string(x + dx) + " " + std::to_string(y)));
    }
};

Surroundings surroundings_of_a_robot(Context& context, Client& client) {
    auto const& system = context.component_of_kind({"systeminformation"});
    auto const answer = client.query("robot_position", only(system));
    for (auto const located : answer.root().child("results").children("located")) {
        std::istringstream position{located.child("position").text().get()};
        Surroundings surroundings{&system, 0, 0};
        if (position >> surroundings.x >> surroundings.y) return surroundings;
    }
    throw Skipped{"no robot reports its position"};
}

void spatial_operators_select_components(Context& context) {
    Client client{context};
    auto const surroundings = surroundings_of_a_robot(context, client);
    bool ran = false;
    auto const require_selection = [&](std::string const& relation, kit::Xml const& other, bool expected) {
        auto const filter = kit::related(relation, "location", other);
        if (is_refused(client.ask("search", where(filter)))) return;
        ran = true;
        auto const refs = found(client, where(filter));
        require((std::ranges::find(refs, surroundings.system->ref) != refs.end()) == expected,
                "search: expected the result " + std::string{expected ? "with " : "without "} + surroundings.system->ref +
                    ", got " + list(refs) + " for " + filter.text());
    };
    constexpr double far = 1e6;
    for (auto const* const relation : {"Within", "BBOX", "Intersects"}) {
        require_selection(relation, surroundings.box_at(0), true);
        require_selection(relation, surroundings.box_at(far), false);
    }
    require_selection("Disjoint", surroundings.box_at(0), false);
    require_selection("Disjoint", surroundings.box_at(far), true);
    require_selection("DWithin", surroundings.point_at(0) + kit::distance("5000"), true);
    require_selection("DWithin", surroundings.point_at(far) + kit::distance("5000"), false);
    require_selection("DWithin", surroundings.point_at(far) + kit::distance("1.1", "km"), true);
    require_selection("Beyond", surroundings.point_at(0) + kit::distance("5000"), false);
    require_selection("Beyond", surroundings.point_at(far) + kit::distance("5000"), true);
    if (!ran) throw Skipped{"the gateway does not support spatial operators"};
}

}  // namespace

Clause condition_clause() {
    return {"Conditions (ISO 19143)",
            {{"and_or_not_select_components", "Minimum Standard Filter", and_or_not_select_components},
             {"operands_may_be_in_either_order", "Minimum Standard Filter", operands_may_be_in_either_order},
             {"a_condition_on_the_component_type_ignores_case", "decision 25", a_condition_on_the_component_type_ignores_case},
             {"numbers_are_compared_by_value", "Standard Filter", numbers_are_compared_by_value},
             {"comparisons_are_case_sensitive_by_default", "Minimum Standard Filter: matchCase",
              comparisons_are_case_sensitive_by_default},
             {"a_parameter_without_a_value_is_null", "Standard Filter: PropertyIsNull", a_parameter_without_a_value_is_null},
             {"like_supports_wildcards", "Standard Filter", like_supports_wildcards},
             {"times_are_compared_by_value", "Temporal Filter; decision 28", times_are_compared_by_value},
             {"spatial_operators_select_components", "Spatial Filter; decision 18", spatial_operators_select_components},
             {"a_resource_id_selects_a_component", "Resource Identification", a_resource_id_selects_a_component},
             {"search_results_can_be_sorted", "Sorting", search_results_can_be_sorted},
             {"the_published_search_condition_is_accepted", "the published examples", the_published_search_condition_is_accepted},
             {"unknown_names_in_conditions_are_refused", "table 1; decisions 4, 18", unknown_names_in_conditions_are_refused}}};
}

}  // namespace rois::conformance
