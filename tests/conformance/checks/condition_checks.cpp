// Conditions (ISO 19143; table 4 and all other arguments that are conditions; decisions 4, 18, 19). Their choice is observable
// from `search`, where they speak of components, and from the details of an event, where they speak of results.
#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>
#include <string_view>
#include <vector>

#include "conformance/stage.hpp"

namespace rois::conformance {

namespace {

using kit::compared;
using kit::contrary;
using kit::equal;
using kit::where;

using Refs = std::vector<std::string>;

Refs found(Guest& guest, kit::Xml const& condition) {
    auto refs = guest.search(condition);
    std::ranges::sort(refs);
    return refs;
}

// Of the classes of ISO 19143, a gateway needs the minimum (And, Or, Not and six comparisons). It refuses the operators of others
// that it does not have.
bool is_refused(Document const& answer) {
    return answer.return_code() == "BAD_PARAMETER" || answer.return_code() == "UNSUPPORTED";
}

// NotPlayed when a search with this condition, which has an operator of a class that is optional, is refused.
void need(Guest& guest, std::string const& operation, kit::Xml const& condition) {
    auto const answer = guest.ask("search", condition);
    if (is_refused(answer)) throw NotPlayed{"the gateway does without " + operation + ": " + answer.reason()};
}

void same_refs(std::string const& what, Refs const& expected, Refs const& found) {
    require(expected == found, what + " should find " + list(expected) + ", and finds " + list(found));
}

// The refs of all components for which this holds, in order.
template <typename Predicate>
Refs refs_of(Stage const& stage, Predicate holds) {
    Refs refs;
    for (auto const& component : stage.catalogue().components)
        if (holds(component)) refs.push_back(component.ref);
    return refs;
}

void logic_chooses_components(Stage& stage) {
    Guest guest{stage};
    auto const [one, other] = stage.two_common();
    auto const is_one = equal("component_ref", one->ref), is_other = equal("component_ref", other->ref);
    auto const but_one = refs_of(stage, [&](Component const& component) { return component.ref != one->ref; });
    same_refs("Or", {std::min(one->ref, other->ref), std::max(one->ref, other->ref)},
              found(guest, where(kit::either(is_one, is_other))));
    same_refs("And of what excludes one another", {}, found(guest, where(kit::both(is_one, is_other))));
    same_refs("Not", but_one, found(guest, where(contrary(is_one))));
    same_refs("PropertyIsNotEqualTo", but_one, found(guest, where(compared("NotEqualTo", "component_ref", one->ref))));
    same_refs("Not within And", {one->ref}, found(guest, where(kit::both(is_one, contrary(is_other)))));
}

void operands_stand_in_either_order(Stage& stage) {
    Guest guest{stage};
    auto const& ref = stage.two_common().first->ref;
    same_refs("a literal before the reference", {ref}, found(guest, where(kit::literal_first(ref, "component_ref"))));
}

std::string upper(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

void component_types_have_no_case(Stage& stage) {
    Guest guest{stage};
    auto const& one = *stage.two_common().first;
    auto const type = upper(one.type);
    auto const due = refs_of(stage, [&](Component const& component) { return component.type == one.type; });
    same_refs("component_type = " + type, due, found(guest, where(equal("component_type", type))));
}

void case_counts_unless_it_is_said_not_to(Stage& stage) {
    Guest guest{stage};
    auto const& ref = stage.two_common().first->ref;
    auto const other = upper(ref);
    if (other == ref) throw NotPlayed{ref + " has no small letters"};
    auto const same_name = refs_of(stage, [&](Component const& component) { return component.ref == other; });
    auto const same_letters = refs_of(stage, [&](Component const& component) { return upper(component.ref) == other; });
    auto const filter = equal("component_ref", other);
    same_refs("component_ref = " + other, same_name, found(guest, where(filter)));
    same_refs("component_ref = " + other + " with matchCase=\"true\"", same_name,
              found(guest, where(filter.with("matchCase", "true"))));
    same_refs("component_ref = " + other + " with matchCase=\"false\"", same_letters,
              found(guest, where(filter.with("matchCase", "false"))));
}

// A parameter is null for components that lack it, and not null for one that has just got a value.
void what_has_no_value_is_null(Stage& stage) {
    Guest guest{stage};
    auto const dial = dial_of(stage);
    guest.take(*dial.component);
    ok(guest.set_parameter(dial.component->ref, {turned(dial, 50)}));
    guest.settle(*dial.component);
    auto const is_null = kit::is_null("Property/" + dial.parameter);
    need(guest, "PropertyIsNull", where(is_null));
    auto const null = found(guest, where(is_null)), others = found(guest, where(contrary(is_null)));
    for (auto const& component : stage.catalogue().components) {
        bool const among_null = std::ranges::binary_search(null, component.ref);
        bool const among_others = std::ranges::binary_search(others, component.ref);
        auto const parameter = dial.parameter + " of " + component.ref;
        require(among_null != among_others,
                parameter + " should be found by PropertyIsNull or by its contrary, and is by " + (among_null ? "both" : "none"));
        require(among_null || component.parameter(dial.parameter), parameter + " should be null: it has no such parameter");
    }
    require(std::ranges::binary_search(others, dial.component->ref),
            dial.parameter + " of " + dial.component->ref + " has been set, and is null");
}

// Each character's bytes.
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

// A part of a pattern that stands for itself.
std::string as_letters(std::string_view text) {
    std::string pattern;
    for (char const c : text) {
        if (c == '*' || c == '?' || c == '!') pattern += '!';
        pattern += c;
    }
    return pattern;
}

void like_has_wildcards(Stage& stage) {
    Guest guest{stage};
    auto const& ref = stage.two_common().first->ref;
    auto const first_size = characters_of(ref).front().size(), last_size = characters_of(ref).back().size();
    auto const tail = ref.substr(first_size), head = ref.substr(0, ref.size() - last_size);
    auto const ends = refs_of(stage, [&](Component const& component) { return component.ref.ends_with(tail); });
    auto const begins = refs_of(stage, [&](Component const& component) { return component.ref.starts_with(head); });
    auto const one_before = refs_of(stage, [&](Component const& component) {
        bool const as_long = characters_of(component.ref).size() == characters_of(ref).size();
        return as_long && component.ref.ends_with(tail);
    });
    need(guest, "PropertyIsLike", where(kit::like("component_ref", "*")));
    auto const like = [&](std::string const& pattern) { return found(guest, where(kit::like("component_ref", pattern))); };
    same_refs("component_ref like *" + tail, ends, like("*" + as_letters(tail)));
    same_refs("component_ref like " + head + "*", begins, like(as_letters(head) + "*"));
    same_refs("component_ref like ?" + tail, one_before, like("?" + as_letters(tail)));
    auto const starred = refs_of(stage, [&](Component const& component) { return component.ref == "*" + tail; });
    same_refs("component_ref like !*" + tail, starred, like("!*" + as_letters(tail)));
}

void identifiers_choose_resources(Stage& stage) {
    Guest guest{stage};
    auto const& ref = stage.two_common().first->ref;
    auto const condition = where(kit::element("fes:ResourceId", {{"rid", ref}}));
    need(guest, "ResourceId", condition);
    same_refs("ResourceId", {ref}, found(guest, condition));
}

void what_is_found_can_be_sorted(Stage& stage) {
    Guest guest{stage};
    auto const all = refs_of(stage, [](Component const&) { return true; });
    need(guest, "SortBy", kit::ordered("", kit::sorted_by("component_ref", "ASC")));
    auto rising = guest.search(kit::ordered("", kit::sorted_by("component_ref", "ASC")));
    auto falling = guest.search(kit::ordered("", kit::sorted_by("component_ref", "DESC")));
    auto sorted = rising;
    std::ranges::sort(sorted);
    same_refs("SortBy alone", all, sorted);
    require(std::ranges::is_sorted(rising), "components sorted by their refs should rise, and are " + list(rising));
    std::ranges::reverse(falling);
    same_refs("the contrary of DESC", rising, falling);
}

void the_published_wrapper_is_read(Stage& stage) {
    Guest guest{stage};
    auto const& one = *stage.two_common().first;
    auto const due = refs_of(stage, [&](Component const& component) { return component.type == one.type; });
    same_refs("unr:SearchCondition of the type " + one.type, due, found(guest, kit::of_type(one.type)));
}

void what_is_not_understood_is_named(Stage& stage) {
    Guest guest{stage};
    auto const box = kit::box("0 0", "1 1");
    refused(guest.ask("search", where(equal(nobody, "red"))), "BAD_PARAMETER");
    refused(guest.ask("search", where(kit::undefined_function("location"))), "BAD_PARAMETER");
    refused(guest.ask("search", where(kit::related("DWithin", "location", box + kit::distance("1", nobody)))), "BAD_PARAMETER");
    refused(guest.ask("search", where(kit::related("Within", "location", kit::box("0 0", "1 1", "urn:nowhere")))),
            "BAD_PARAMETER");
}

// The details of a detection, which have a number and a time.
class Detection {
public:
    explicit Detection(Stage& stage) : owner_{stage} {
        auto const& detector = stage.detector();
        owner_.take(detector);
        auto const type = detector.detection();
        ok(owner_.subscribe(type, only(detector)));
        id_ = owner_.start_until(detector, type).text("event_id");
        auto const results = ok(owner_.get_event_detail(id_)).values();
        auto const text = value_of(results, "number");
        auto const read = std::from_chars(text.data(), text.data() + text.size(), number);
        require(read.ec == std::errc{}, "the number of a detection (tables 35, 38, 40) is " + text);
        timestamp = value_of(results, "timestamp");
    }

    void holds(kit::Xml const& filter) { expect(filter, true); }
    void does_not_hold(kit::Xml const& filter) { expect(filter, false); }
    // The gateway may do without the operator.
    void may_hold(kit::Xml const& filter) {
        if (knows(filter)) expect(filter, true);
    }
    void may_not_hold(kit::Xml const& filter) {
        if (knows(filter)) expect(filter, false);
    }

    int number = 0;
    std::string timestamp;

private:
    bool knows(kit::Xml const& filter) { return !is_refused(owner_.get_event_detail(id_, where(filter))); }

    void expect(kit::Xml const& filter, bool due) {
        bool const told = !ok(owner_.get_event_detail(id_, where(filter))).values().empty();
        require(told == due, "of a detection with the number " + std::to_string(number) + " at " + timestamp + ", this should " +
                                 (due ? "" : "not ") + "hold: " + filter.text());
    }

    Guest owner_;
    std::string id_;
};

kit::Xml number_between(int low, int high) { return kit::between("number", std::to_string(low), std::to_string(high)); }

void numbers_are_compared_as_numbers(Stage& stage) {
    Detection detection{stage};
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
    detection.may_hold(number_between(number, number));
    detection.may_not_hold(number_between(number + 1, number + 9));
    detection.may_not_hold(kit::is_null("number"));
    detection.may_hold(contrary(kit::is_null("number")));
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

void times_are_compared_as_times(Stage& stage) {
    Detection detection{stage};
    detection.may_hold(timed("After", instant("2011-05-23T00:00:00Z")));
    detection.may_not_hold(timed("Before", instant("2011-05-23T00:00:00Z")));
    detection.may_hold(timed("Before", instant("9000-01-01T00:00:00Z")));
    detection.may_hold(timed("TEquals", instant(detection.timestamp)));
    detection.may_hold(timed("During", period("2011-05-23T00:00:00Z", "9000-01-01T00:00:00Z")));
    detection.may_not_hold(timed("During", period("2011-05-23T00:00:00Z", "2011-05-24T00:00:00Z")));
    auto const here = detection.timestamp.substr(0, detection.timestamp.size() - 1);
    detection.holds(equal("timestamp", here + "+00:00"));
    detection.does_not_hold(equal("timestamp", here + "+01:00"));
}

// A box around the reported position of a robot, much larger than any measurement error.
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

Surroundings surroundings(Stage& stage, Guest& guest) {
    auto const& system = stage.one_of({"systeminformation"});
    auto const answer = guest.query("robot_position", only(system));
    for (auto const located : answer.root().child("results").children("located")) {
        std::istringstream position{located.child("position").text().get()};
        Surroundings here{&system, 0, 0};
        if (position >> here.x >> here.y) return here;
    }
    throw NotPlayed{"no robot says where it is"};
}

void space_chooses_components(Stage& stage) {
    Guest guest{stage};
    auto const here = surroundings(stage, guest);
    bool played = false;
    auto const chooses = [&](std::string const& relation, kit::Xml const& other, bool due) {
        auto const filter = kit::related(relation, "location", other);
        if (is_refused(guest.ask("search", where(filter)))) return;
        played = true;
        auto const refs = found(guest, where(filter));
        require(
            (std::ranges::find(refs, here.system->ref) != refs.end()) == due,
            here.system->ref + " should " + (due ? "" : "not ") + "be found by " + filter.text() + ", found is " + list(refs));
    };
    constexpr double far = 1e6;
    for (auto const* const relation : {"Within", "BBOX", "Intersects"}) {
        chooses(relation, here.box_at(0), true);
        chooses(relation, here.box_at(far), false);
    }
    chooses("Disjoint", here.box_at(0), false);
    chooses("Disjoint", here.box_at(far), true);
    chooses("DWithin", here.point_at(0) + kit::distance("5000"), true);
    chooses("DWithin", here.point_at(far) + kit::distance("5000"), false);
    chooses("DWithin", here.point_at(far) + kit::distance("1.1", "km"), true);
    chooses("Beyond", here.point_at(0) + kit::distance("5000"), false);
    chooses("Beyond", here.point_at(far) + kit::distance("5000"), true);
    if (!played) throw NotPlayed{"the gateway does without relations of places"};
}

}  // namespace

Clause condition_clause() {
    return {"Conditions (ISO 19143)",
            {{"logic_chooses_components", "Minimum Standard Filter", logic_chooses_components},
             {"operands_stand_in_either_order", "Minimum Standard Filter", operands_stand_in_either_order},
             {"component_types_have_no_case", "decision 25", component_types_have_no_case},
             {"numbers_are_compared_as_numbers", "Standard Filter", numbers_are_compared_as_numbers},
             {"case_counts_unless_it_is_said_not_to", "Minimum Standard Filter: matchCase", case_counts_unless_it_is_said_not_to},
             {"what_has_no_value_is_null", "Standard Filter: PropertyIsNull", what_has_no_value_is_null},
             {"like_has_wildcards", "Standard Filter", like_has_wildcards},
             {"times_are_compared_as_times", "Temporal Filter; decision 28", times_are_compared_as_times},
             {"space_chooses_components", "Spatial Filter; decision 18", space_chooses_components},
             {"identifiers_choose_resources", "Resource Identification", identifiers_choose_resources},
             {"what_is_found_can_be_sorted", "Sorting", what_is_found_can_be_sorted},
             {"the_published_wrapper_is_read", "the published examples", the_published_wrapper_is_read},
             {"what_is_not_understood_is_named", "table 1; decisions 4, 18", what_is_not_understood_is_named}}};
}

}  // namespace rois::conformance
