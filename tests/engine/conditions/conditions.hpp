// Short functions that make conditions: `less("count", "10")`, `within("location", box(0, 0, 5, 5))`.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "types/condition.hpp"

namespace rois {

inline Expression reference(std::string path) { return {ValueReference{std::move(path)}}; }
inline Expression literal(std::string text) { return {Literal{std::move(text)}}; }

inline Condition compared(std::string path, Comparator comparator, std::string text, MatchAction action = MatchAction::any) {
    return {PropertyComparison{comparator, reference(std::move(path)), literal(std::move(text)), true, action}};
}
inline Condition less(std::string path, std::string text) { return compared(std::move(path), Comparator::less, std::move(text)); }
inline Condition greater(std::string path, std::string text) {
    return compared(std::move(path), Comparator::greater, std::move(text));
}
inline Condition not_equal(std::string path, std::string text) {
    return compared(std::move(path), Comparator::not_equal, std::move(text));
}

enum class Letters { matched, ignored };
inline Condition like(std::string path, std::string pattern, Letters letters = Letters::matched) {
    return {PropertyIsLike{reference(std::move(path)), literal(std::move(pattern)), "*", "?", "!", letters == Letters::matched}};
}

inline Condition is_null(std::string path) { return {PropertyIsNull{reference(std::move(path))}}; }
inline Condition is_nil(std::string path, std::string reason) {
    return {PropertyIsNil{reference(std::move(path)), std::move(reason)}};
}
inline Condition between(std::string path, std::string lower, std::string upper) {
    return {PropertyIsBetween{reference(std::move(path)), literal(std::move(lower)), literal(std::move(upper))}};
}
inline Condition contrary(Condition operand) { return {Not{{std::move(operand)}}}; }

inline Geometry box(double x, double y, double to_x, double to_y, std::string crs = "") {
    return {.crs = std::move(crs), .low = {x, y, 0}, .high = {to_x, to_y, 0}, .dimensions = 2};
}
inline Geometry spot(double x, double y, std::string crs = "") { return box(x, y, x, y, std::move(crs)); }

inline Condition spatial(SpatialRelation relation, std::vector<Expression> operands) {
    return {SpatialComparison{relation, std::move(operands)}};
}
inline Condition within(std::string path, Expression where) {
    return spatial(SpatialRelation::within, {reference(std::move(path)), std::move(where)});
}
inline Condition near(std::string path, Expression where, double distance, std::string uom = "mm") {
    return {
        DistanceComparison{DistanceRelation::d_within, {reference(std::move(path)), std::move(where)}, distance, std::move(uom)}};
}
inline Condition beyond(std::string path, Expression where, double distance) {
    return {DistanceComparison{DistanceRelation::beyond, {reference(std::move(path)), std::move(where)}, distance, "mm"}};
}

inline Condition temporal(TemporalRelation relation, std::vector<Expression> operands) {
    return {TemporalComparison{relation, std::move(operands)}};
}

inline Expression distance(std::string path, Expression where) {
    return {Function{"distance", {reference(std::move(path)), std::move(where)}}};
}

inline QueryExpression sorted(Expression by, SortOrder order = SortOrder::ascending) {
    QueryExpression query;
    query.sort_by.push_back({std::move(by), order});
    return query;
}

inline Condition group(ComponentGroup what) { return {std::move(what)}; }

}  // namespace rois
