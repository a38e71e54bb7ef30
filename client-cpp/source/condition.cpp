#include "rois/condition.hpp"

#include <algorithm>

#include "xml/codec/writer.hpp"

namespace rois {

namespace {

Expression geometry_of(Box const& box) {
    Geometry geometry;
    geometry.crs = box.crs;
    geometry.low = {std::min(box.x1, box.x2).value, std::min(box.y1, box.y2).value, 0};
    geometry.high = {std::max(box.x1, box.x2).value, std::max(box.y1, box.y2).value, 0};
    return {std::move(geometry)};
}

Expression geometry_of(Pose const& pose) {
    Geometry geometry;
    geometry.crs = pose.crs;
    geometry.low = geometry.high = {pose.x.value, pose.y.value, 0};
    return {std::move(geometry)};
}

Condition near_expression(Expression reference, Expression where, millimetres away) {
    return {DistanceComparison{DistanceRelation::d_within, {std::move(reference), std::move(where)}, away.value, "mm"}};
}

// Adds the prefix of the specification's types to a name without colons.
std::string urn_of(std::string_view urn_or_name) {
    bool const urn = urn_or_name.find(':') != urn_or_name.npos;
    return (urn ? "" : "urn:x-rois:def:component:OMG::") + std::string{urn_or_name};
}

Reference const component_type{"component_type"};

Expression at(Utc time) { return {Period{time, time}}; }

}  // namespace

Expression literal(std::string_view text) { return {Literal{std::string{text}}}; }
Expression literal(double number) { return {Literal{xml::number_text(number)}}; }
Expression literal(Utc time) { return {Literal{to_text(time)}}; }
Expression literal(millimetres length) { return literal(length.value); }
Expression literal(degrees angle) { return literal(angle.value); }

Condition Reference::compared(Comparator comparator, Expression with) const {
    return {PropertyComparison{comparator, expression(), std::move(with)}};
}

Condition Reference::between_expressions(Expression lower, Expression upper) const {
    return {PropertyIsBetween{expression(), std::move(lower), std::move(upper)}};
}

Condition Reference::like(std::string_view pattern) const {
    return {PropertyIsLike{expression(), literal(pattern), "*", "?", "\\", true}};
}

Condition Reference::is_null() const { return {PropertyIsNull{expression()}}; }

Condition Reference::within(Box const& box) const {
    return {SpatialComparison{SpatialRelation::within, {expression(), geometry_of(box)}}};
}

Condition Reference::within(std::string_view place) const {
    return {SpatialComparison{SpatialRelation::within, {expression(), literal(place)}}};
}

Condition Reference::near(Pose const& pose, millimetres away) const {
    return near_expression(expression(), geometry_of(pose), away);
}

Condition Reference::near(std::string_view place, millimetres away) const {
    return near_expression(expression(), literal(place), away);
}

Condition Reference::after(Utc time) const { return {TemporalComparison{TemporalRelation::after, {expression(), at(time)}}}; }

Condition Reference::before(Utc time) const { return {TemporalComparison{TemporalRelation::before, {expression(), at(time)}}}; }

Condition Reference::during(Period period) const {
    return {TemporalComparison{TemporalRelation::during, {expression(), {period}}}};
}

Condition TypeReference::operator==(std::string_view urn_or_name) const { return component_type == urn_of(urn_or_name); }

Condition TypeReference::operator!=(std::string_view urn_or_name) const { return component_type != urn_of(urn_or_name); }

// Joins a && b && c into one And with three operands.
Condition operator&&(Condition a, Condition b) {
    if (auto* const all = std::get_if<And>(&a.predicate)) {
        all->operands.push_back(std::move(b));
        return a;
    }
    return {And{{std::move(a), std::move(b)}}};
}

Condition operator||(Condition a, Condition b) {
    if (auto* const any = std::get_if<Or>(&a.predicate)) {
        any->operands.push_back(std::move(b));
        return a;
    }
    return {Or{{std::move(a), std::move(b)}}};
}

Condition operator!(Condition condition) { return {Not{{std::move(condition)}}}; }

SortProperty nearest_to(std::string_view place) {
    return {{Function{"distance", {conditions::location.expression(), literal(place)}}}, SortOrder::ascending};
}

SortProperty ascending(Reference const& reference) { return {reference.expression(), SortOrder::ascending}; }

SortProperty descending(Reference const& reference) { return {reference.expression(), SortOrder::descending}; }

QueryExpression narrowed(QueryExpression query, Condition condition) {
    query.filter = query.filter ? std::move(condition) && *std::move(query.filter) : std::move(condition);
    return query;
}

}  // namespace rois
