#include <array>
#include <iterator>
#include <string>
#include <utility>

#include "types/text/texts.hpp"
#include "xml/codec/decoding.hpp"

namespace rois::xml {

namespace {

using Node = MessageTree::Node;

template <class Value, std::size_t size>
using Names = std::array<std::pair<std::string_view, Value>, size>;

constexpr Names<Comparator, 6> comparators{{{"PropertyIsEqualTo", Comparator::equal},
                                            {"PropertyIsNotEqualTo", Comparator::not_equal},
                                            {"PropertyIsLessThan", Comparator::less},
                                            {"PropertyIsGreaterThan", Comparator::greater},
                                            {"PropertyIsLessThanOrEqualTo", Comparator::less_or_equal},
                                            {"PropertyIsGreaterThanOrEqualTo", Comparator::greater_or_equal}}};
constexpr Names<SpatialRelation, 9> spatial_relations{{{"BBOX", SpatialRelation::intersects},
                                                       {"Within", SpatialRelation::within},
                                                       {"Intersects", SpatialRelation::intersects},
                                                       {"Disjoint", SpatialRelation::disjoint},
                                                       {"Equals", SpatialRelation::equals},
                                                       {"Touches", SpatialRelation::touches},
                                                       {"Overlaps", SpatialRelation::overlaps},
                                                       {"Crosses", SpatialRelation::crosses},
                                                       {"Contains", SpatialRelation::contains}}};
constexpr Names<DistanceRelation, 2> distance_relations{
    {{"DWithin", DistanceRelation::d_within}, {"Beyond", DistanceRelation::beyond}}};
constexpr Names<TemporalRelation, 14> temporal_relations{{{"After", TemporalRelation::after},
                                                          {"Before", TemporalRelation::before},
                                                          {"During", TemporalRelation::during},
                                                          {"TEquals", TemporalRelation::t_equals},
                                                          {"Begins", TemporalRelation::begins},
                                                          {"BegunBy", TemporalRelation::begun_by},
                                                          {"TContains", TemporalRelation::t_contains},
                                                          {"EndedBy", TemporalRelation::ended_by},
                                                          {"Ends", TemporalRelation::ends},
                                                          {"Meets", TemporalRelation::meets},
                                                          {"MetBy", TemporalRelation::met_by},
                                                          {"TOverlaps", TemporalRelation::t_overlaps},
                                                          {"OverlappedBy", TemporalRelation::overlapped_by},
                                                          {"AnyInteracts", TemporalRelation::any_interacts}}};

template <class Value, std::size_t size>
Value const* find(Names<Value, size> const& names, std::string_view name) {
    for (auto const& [known, value] : names) {
        if (known == name) return &value;
    }
    return nullptr;
}

bool match_case(Node node) {
    auto const given = node.attribute("matchCase");
    return !given || decode_boolean(*given);
}

MatchAction match_action(Node node) {
    auto const given = node.attribute_text("matchAction");
    if (given == "All") return MatchAction::all;
    return given == "One" ? MatchAction::one : MatchAction::any;
}

std::vector<Expression> operands(Node node) {
    std::vector<Expression> expressions;
    for (auto const each : node.children()) {
        if (each.name() != "Distance") expressions.push_back(decode_expression(each));
    }
    return expressions;
}

Condition decode_comparison(Node node, Comparator comparator) {
    auto const first = node.first_child();
    return {PropertyComparison{comparator, decode_expression(first), decode_expression(first.next()), match_case(node),
                               match_action(node)}};
}

Condition decode_like(Node node) {
    auto const first = node.first_child();
    return {PropertyIsLike{decode_expression(first), decode_expression(first.next()), node.attribute_text("wildCard"),
                           node.attribute_text("singleChar"), node.attribute_text("escapeChar"), match_case(node)}};
}

Condition decode_between(Node node) {
    auto const value = node.first_child();
    auto const lower = value.next();
    auto const upper = lower.next();
    return {PropertyIsBetween{decode_expression(value), decode_expression(lower.first_child()),
                              decode_expression(upper.first_child())}};
}

Condition decode_distance(Node node, DistanceRelation relation) {
    auto const distance = node.child("Distance");
    return {DistanceComparison{relation, operands(node), to_double(distance.text()).value_or(0), distance.attribute_text("uom")}};
}

Condition decode_resource_id(Node node) {
    for (auto const* other : {"previousRid", "version", "startDate", "endDate"}) {
        if (node.attribute(other)) return {not_understood(other)};
    }
    return {ResourceId{node.attribute_text("rid")}};
}

Condition decode_predicate(Node node);

std::vector<Condition> decode_predicates(Node parent) {
    auto const children = parent.children();
    std::vector<Condition> conditions;
    conditions.reserve(static_cast<std::size_t>(std::ranges::distance(children)));
    for (auto const each : children) conditions.push_back(decode_predicate(each));
    return conditions;
}

Condition decode_predicate(Node node) {
    auto const name = node.name();
    if (auto const* comparator = find(comparators, name)) return decode_comparison(node, *comparator);
    if (auto const* relation = find(spatial_relations, name)) return {SpatialComparison{*relation, operands(node)}};
    if (auto const* relation = find(distance_relations, name)) return decode_distance(node, *relation);
    if (auto const* relation = find(temporal_relations, name)) return {TemporalComparison{*relation, operands(node)}};
    if (name == "PropertyIsLike") return decode_like(node);
    if (name == "PropertyIsNull") return {PropertyIsNull{decode_expression(node.first_child())}};
    if (name == "PropertyIsNil") return {PropertyIsNil{decode_expression(node.first_child()), node.attribute_text("nilReason")}};
    if (name == "PropertyIsBetween") return decode_between(node);
    if (name == "ResourceId") return decode_resource_id(node);
    if (name == "And") return {And{decode_predicates(node)}};
    if (name == "Or") return {Or{decode_predicates(node)}};
    if (name == "Not") return {Not{decode_predicates(node)}};
    if (name == "Function")
        return {NotUnderstood{"the condition has the function " + quoted(node.attribute_text("name")) +
                              " as a predicate: compare its value, for example in a PropertyIsLessThan"}};
    return {not_understood(name)};
}

// Decodes a Filter: one predicate, or several resource ids, any of which may match. Returns nothing if it is empty.
std::optional<Condition> decode_filter(Node filter) {
    auto predicates = decode_predicates(filter);
    if (predicates.empty()) return {};
    if (predicates.size() == 1) return std::move(predicates.front());
    return Condition{Or{std::move(predicates)}};
}

// --- The published examples' wrapper ---

Condition equal(std::string path, std::string literal) {
    return {PropertyComparison{Comparator::equal, {ValueReference{std::move(path)}}, {Literal{std::move(literal)}}}};
}

// Decodes a filter of the wrapper: a Filter element, or a bare predicate in its place.
std::optional<Condition> decode_bare_filter(Node node) {
    auto const name = node.name();
    if (name == "Filter" || name == "filter") return decode_filter(node);
    return decode_predicate(node);
}

// The published examples write `unr:` for the `urn:` of a type.
std::string component_type(std::string_view written) {
    written = trimmed(written);
    bool const misspelt = equal_ignoring_case(written.substr(0, 4), "unr:");
    return misspelt ? "urn:" + std::string{written.substr(4)} : std::string{written};
}

// Decodes a ComponentCondition: a component of this type that meets the filter. The mode `exclusive` also requires that no other
// session has bound it.
Condition decode_component(Node node) {
    And all;
    auto type = component_type(node.attribute_text("type"));
    if (!type.empty())
        all.operands.push_back({ComponentGroup{.types = {std::move(type)}, .aliases = {}, .filter = {}, .members = {}}});
    auto const mode = std::string{trimmed(node.attribute_text("mode"))};
    if (mode == "exclusive") all.operands.push_back({Not{{equal("status", "BUSY")}}});
    if (!mode.empty() && mode != "exclusive" && mode != "shared") return {not_understood("the mode " + mode)};
    for (auto const each : node.children()) {
        if (auto filter = decode_bare_filter(each)) all.operands.push_back(std::move(*filter));
    }
    return {std::move(all)};
}

std::vector<std::string> words_in(std::string_view text) {
    std::vector<std::string> words;
    for (text = trimmed(text); !text.empty();) {
        auto const word = text.substr(0, text.find_first_of(" \t\r\n"));
        words.emplace_back(word);
        text = trimmed(text.substr(word.size()));
    }
    return words;
}

Condition decode_group(Node node) {
    ComponentGroup group;
    for (auto const& type : words_in(node.attribute_text("types"))) group.types.push_back(component_type(type));
    group.aliases = words_in(node.attribute_text("aliases"));
    if (group.aliases.size() > group.types.size())
        return {NotUnderstood{"the condition has more aliases than types in a ComponentGroupCondition"}};
    for (auto const each : node.children()) {
        if (each.name() == "ComponentCondition") {
            group.members.push_back(decode_component(each));
        } else if (auto filter = decode_bare_filter(each)) {
            group.filter.push_back(std::move(*filter));
        }
    }
    return {std::move(group)};
}

// Decodes a SearchCondition: matches if any of its conditions matches.
std::optional<Condition> decode_search_condition(Node node) {
    Or any;
    for (auto const each : node.children()) {
        bool const group = each.name() == "ComponentGroupCondition";
        any.operands.push_back(group ? decode_group(each) : decode_component(each));
    }
    if (any.operands.empty()) return {};
    return Condition{std::move(any)};
}

std::vector<SortProperty> decode_sort_by(Node sort_by) {
    std::vector<SortProperty> properties;
    for (auto const each : sort_by.children()) {
        bool const descending = trimmed(each.child_text("SortOrder")) == "DESC";
        properties.push_back({decode_expression(each.first_child()), descending ? SortOrder::descending : SortOrder::ascending});
    }
    return properties;
}

}  // namespace

QueryExpression decode_condition(Node condition) {
    QueryExpression query;
    for (auto const each : condition.children()) {
        if (each.name() == "Filter") query.filter = decode_filter(each);
        if (each.name() == "SearchCondition") query.filter = decode_search_condition(each);
        if (each.name() == "SortBy") query.sort_by = decode_sort_by(each);
    }
    return query;
}

}  // namespace rois::xml
