#include <array>
#include <string>
#include <utility>

#include "types/texts.hpp"
#include "xml/decoding.hpp"
#include "xml/decoding_expression.hpp"
#include "xml/tree.hpp"

namespace rois::xml {

namespace {

template <class Value, std::size_t size>
using Names = std::array<std::pair<std::string_view, Value>, size>;

constexpr Names<Comparator, 6> comparators{{{"PropertyIsEqualTo", Comparator::equal},
                                            {"PropertyIsNotEqualTo", Comparator::not_equal},
                                            {"PropertyIsLessThan", Comparator::less},
                                            {"PropertyIsGreaterThan", Comparator::greater},
                                            {"PropertyIsLessThanOrEqualTo", Comparator::less_or_equal},
                                            {"PropertyIsGreaterThanOrEqualTo", Comparator::greater_or_equal}}};
constexpr Names<SpatialRelation, 4> spatial_relations{{{"BBOX", SpatialRelation::intersects},
                                                       {"Within", SpatialRelation::within},
                                                       {"Intersects", SpatialRelation::intersects},
                                                       {"Disjoint", SpatialRelation::disjoint}}};
constexpr Names<DistanceRelation, 2> distance_relations{
    {{"DWithin", DistanceRelation::d_within}, {"Beyond", DistanceRelation::beyond}}};
constexpr Names<TemporalRelation, 4> temporal_relations{{{"After", TemporalRelation::after},
                                                         {"Before", TemporalRelation::before},
                                                         {"During", TemporalRelation::during},
                                                         {"TEquals", TemporalRelation::t_equals}}};

template <class Value, std::size_t size>
Value const* find(Names<Value, size> const& names, std::string_view name) {
    for (auto const& [known, value] : names) {
        if (known == name) return &value;
    }
    return nullptr;
}

bool match_case(pugi::xml_node node) {
    auto const given = attribute(node, "matchCase");
    return !given || decode_boolean(given.value());
}

MatchAction match_action(pugi::xml_node node) {
    auto const given = attribute_text(node, "matchAction");
    if (given == "All") return MatchAction::all;
    return given == "One" ? MatchAction::one : MatchAction::any;
}

std::vector<Expression> operands(pugi::xml_node node) {
    std::vector<Expression> expressions;
    for (auto const each : elements_in(node)) {
        if (local_name(each) != "Distance") expressions.push_back(decode_expression(each));
    }
    return expressions;
}

Condition decode_comparison(pugi::xml_node node, Comparator comparator) {
    auto const sides = elements_in(node);
    return {PropertyComparison{comparator, decode_expression(sides.at(0)), decode_expression(sides.at(1)), match_case(node),
                               match_action(node)}};
}

Condition decode_like(pugi::xml_node node) {
    auto const sides = elements_in(node);
    return {PropertyIsLike{decode_expression(sides.at(0)), decode_expression(sides.at(1)), attribute_text(node, "wildCard"),
                           attribute_text(node, "singleChar"), attribute_text(node, "escapeChar"), match_case(node)}};
}

Condition decode_between(pugi::xml_node node) {
    auto const parts = elements_in(node);
    auto const boundary = [](pugi::xml_node side) { return decode_expression(elements_in(side).front()); };
    return {PropertyIsBetween{decode_expression(parts.at(0)), boundary(parts.at(1)), boundary(parts.at(2))}};
}

Condition decode_distance(pugi::xml_node node, DistanceRelation relation) {
    auto const distance = child(node, "Distance");
    return {
        DistanceComparison{relation, operands(node), to_double(text_of(distance)).value_or(0), attribute_text(distance, "uom")}};
}

Condition decode_resource_id(pugi::xml_node node) {
    for (auto const* other : {"previousRid", "version", "startDate", "endDate"}) {
        if (attribute(node, other)) return {not_understood(other)};
    }
    return {ResourceId{attribute_text(node, "rid")}};
}

Condition decode_predicate(pugi::xml_node node);

std::vector<Condition> decode_predicates(std::vector<pugi::xml_node> const& nodes) {
    std::vector<Condition> conditions;
    conditions.reserve(nodes.size());
    for (auto const node : nodes) conditions.push_back(decode_predicate(node));
    return conditions;
}

Condition decode_predicate(pugi::xml_node node) {
    auto const name = local_name(node);
    if (auto const* comparator = find(comparators, name)) return decode_comparison(node, *comparator);
    if (auto const* relation = find(spatial_relations, name)) return {SpatialComparison{*relation, operands(node)}};
    if (auto const* relation = find(distance_relations, name)) return decode_distance(node, *relation);
    if (auto const* relation = find(temporal_relations, name)) return {TemporalComparison{*relation, operands(node)}};
    if (name == "PropertyIsLike") return decode_like(node);
    if (name == "PropertyIsNull") return {PropertyIsNull{decode_expression(elements_in(node).front())}};
    if (name == "PropertyIsNil")
        return {PropertyIsNil{decode_expression(elements_in(node).front()), attribute_text(node, "nilReason")}};
    if (name == "PropertyIsBetween") return decode_between(node);
    if (name == "ResourceId") return decode_resource_id(node);
    if (name == "And") return {And{decode_predicates(elements_in(node))}};
    if (name == "Or") return {Or{decode_predicates(elements_in(node))}};
    if (name == "Not") return {Not{decode_predicates(elements_in(node))}};
    return {not_understood(name)};
}

// A Filter: one predicate, or several names of resources, any of which is meant. Nothing when it is empty.
std::optional<Condition> decode_filter(pugi::xml_node filter) {
    auto predicates = decode_predicates(elements_in(filter));
    if (predicates.empty()) return {};
    if (predicates.size() == 1) return std::move(predicates.front());
    return Condition{Or{std::move(predicates)}};
}

// --- The published examples' wrapper ---

Condition equal(std::string path, std::string literal) {
    return {PropertyComparison{Comparator::equal, {ValueReference{std::move(path)}}, {Literal{std::move(literal)}}}};
}

// A filter of the wrapper, with or without an element around it; what has the place of one.
std::optional<Condition> decode_bare_filter(pugi::xml_node node) {
    auto const name = local_name(node);
    if (name == "Filter" || name == "filter") return decode_filter(node);
    return decode_predicate(node);
}

// The published examples write `unr:` for the `urn:` of a type.
std::string component_type(std::string_view written) {
    written = trimmed(written);
    bool const misspelt = equal_ignoring_case(written.substr(0, 4), "unr:");
    return misspelt ? "urn:" + std::string{written.substr(4)} : std::string{written};
}

// A component of the type, in any of the ways to write one, that meets the filter; `exclusive`: one that nobody else has bound.
Condition decode_component(pugi::xml_node node) {
    And all;
    auto type = component_type(attribute_text(node, "type"));
    if (!type.empty())
        all.operands.push_back({ComponentGroup{.types = {std::move(type)}, .aliases = {}, .filter = {}, .members = {}}});
    auto const mode = std::string{trimmed(attribute_text(node, "mode"))};
    if (mode == "exclusive") all.operands.push_back({Not{{equal("status", "BUSY")}}});
    if (!mode.empty() && mode != "exclusive" && mode != "shared") return {not_understood("the mode " + mode)};
    for (auto const each : elements_in(node)) {
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

Condition decode_group(pugi::xml_node node) {
    ComponentGroup group;
    for (auto const& type : words_in(attribute_text(node, "types"))) group.types.push_back(component_type(type));
    group.aliases = words_in(attribute_text(node, "aliases"));
    if (group.aliases.size() > group.types.size())
        return {NotUnderstood{"the condition has more aliases than types in a ComponentGroupCondition"}};
    for (auto const each : elements_in(node)) {
        if (local_name(each) == "ComponentCondition") {
            group.members.push_back(decode_component(each));
        } else if (auto filter = decode_bare_filter(each)) {
            group.filter.push_back(std::move(*filter));
        }
    }
    return {std::move(group)};
}

// What any of its conditions looks for is found.
std::optional<Condition> decode_search_condition(pugi::xml_node node) {
    Or any;
    for (auto const each : elements_in(node)) {
        bool const group = local_name(each) == "ComponentGroupCondition";
        any.operands.push_back(group ? decode_group(each) : decode_component(each));
    }
    if (any.operands.empty()) return {};
    return Condition{std::move(any)};
}

std::vector<SortProperty> decode_sort_by(pugi::xml_node sort_by) {
    std::vector<SortProperty> properties;
    for (auto const each : elements_in(sort_by)) {
        bool const descending = trimmed(text_of(child(each, "SortOrder"))) == "DESC";
        properties.push_back(
            {decode_expression(elements_in(each).front()), descending ? SortOrder::descending : SortOrder::ascending});
    }
    return properties;
}

}  // namespace

QueryExpression decode_condition(pugi::xml_node condition) {
    QueryExpression query;
    for (auto const each : elements_in(condition)) {
        if (local_name(each) == "Filter") query.filter = decode_filter(each);
        if (local_name(each) == "SearchCondition") query.filter = decode_search_condition(each);
        if (local_name(each) == "SortBy") query.sort_by = decode_sort_by(each);
    }
    return query;
}

}  // namespace rois::xml
