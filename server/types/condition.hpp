// The parsed conditions of operations (QueryExpression of ISO 19143). docs/conditions.md describes their meaning.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "types/instant.hpp"

namespace rois {

// A valid but unsupported part. The operation fails with BAD_PARAMETER and this reason.
struct NotUnderstood {
    std::string reason;
    bool operator==(NotUnderstood const&) const = default;
};

// --- Expressions ---

struct ValueReference {
    std::string path;
    bool operator==(ValueReference const&) const = default;
};

struct Literal {
    std::string text;
    bool operator==(Literal const&) const = default;
};

// A point, an axis-aligned box, a line, a circle or a polygon; coordinates in mm. A point is a box with two equal corners. Lines,
// circles and polygons are two-dimensional.
struct Geometry {
    enum class Shape : std::uint8_t { box, line, circle, polygon };
    using Point = std::array<double, 2>;
    using Points = std::vector<Point>;

    std::string crs;  // empty: the frame of the other operand
    std::array<double, 3> low{};
    std::array<double, 3> high{};
    std::uint8_t dimensions = 2;  // 2 or 3; with 2, z is 0 and unused
    Shape shape = Shape::box;
    std::vector<Points> paths{};  // line: its points; circle: its centre; polygon: its border, then the borders of its holes,
                                  // each closed (last point equal to the first)
    double radius = 0;            // of a circle
    bool operator==(Geometry const&) const = default;

    // Sets `low` and `high` to the bounding box of a line, circle or polygon.
    void fit_corners();
};

struct Expression;

struct Function {
    std::string name;
    std::vector<Expression> arguments;
    bool operator==(Function const&) const;
};

struct Expression {
    std::variant<ValueReference, Literal, Geometry, Period, Function, NotUnderstood> value;
    bool operator==(Expression const&) const = default;
};

inline bool Function::operator==(Function const&) const = default;

// --- Predicates ---

// How many of several values must satisfy a comparison.
enum class MatchAction : std::uint8_t { any, all, one };

enum class Comparator : std::uint8_t { equal, not_equal, less, greater, less_or_equal, greater_or_equal };

struct PropertyComparison {
    Comparator comparator = Comparator::equal;
    Expression left;
    Expression right;
    bool match_case = true;
    MatchAction match_action = MatchAction::any;
    bool operator==(PropertyComparison const&) const = default;
};

struct PropertyIsLike {
    Expression left;
    Expression right;
    std::string wild_card;    // matches any text
    std::string single_char;  // matches one character
    std::string escape_char;  // makes the next character literal
    bool match_case = true;
    bool operator==(PropertyIsLike const&) const = default;
};

struct PropertyIsNull {
    Expression value;
    bool operator==(PropertyIsNull const&) const = default;
};

struct PropertyIsNil {
    Expression value;
    std::string nil_reason;  // empty: any
    bool operator==(PropertyIsNil const&) const = default;
};

struct PropertyIsBetween {
    Expression value;
    Expression lower;
    Expression upper;
    bool operator==(PropertyIsBetween const&) const = default;
};

// BBOX is decoded as `intersects`.
enum class SpatialRelation : std::uint8_t { within, intersects, disjoint, equals, touches, overlaps, crosses, contains };

struct SpatialComparison {
    SpatialRelation relation = SpatialRelation::within;
    std::vector<Expression> operands;  // two, or one to compare with the candidate's position
    bool operator==(SpatialComparison const&) const = default;
};

enum class DistanceRelation : std::uint8_t { d_within, beyond };

struct DistanceComparison {
    DistanceRelation relation = DistanceRelation::d_within;
    std::vector<Expression> operands;  // as above
    double distance = 0;
    std::string uom;
    bool operator==(DistanceComparison const&) const = default;
};

enum class TemporalRelation : std::uint8_t {
    after,
    before,
    during,
    t_equals,
    begins,
    begun_by,
    t_contains,
    ended_by,
    ends,
    meets,
    met_by,
    t_overlaps,
    overlapped_by,
    any_interacts
};

struct TemporalComparison {
    TemporalRelation relation = TemporalRelation::after;
    std::vector<Expression> operands;  // two, or one to compare with the candidate's time
    bool operator==(TemporalComparison const&) const = default;
};

struct ResourceId {
    std::string rid;
    bool operator==(ResourceId const&) const = default;
};

struct Condition;

struct And {
    std::vector<Condition> operands;
    bool operator==(And const&) const;
};

struct Or {
    std::vector<Condition> operands;
    bool operator==(Or const&) const;
};

struct Not {
    std::vector<Condition> operand;  // exactly one
    bool operator==(Not const&) const;
};

// unr:ComponentGroupCondition: components of one robot. The type of a unr:ComponentCondition is a group with only this type.
struct ComponentGroup {
    std::vector<std::string> types;
    std::vector<std::string> aliases;  // at most as many as types
    std::vector<Condition> filter;     // at most one: on the robot
    std::vector<Condition> members;    // for each, a component of the robot must match
    bool operator==(ComponentGroup const&) const;
};

struct Condition {
    std::variant<PropertyComparison, PropertyIsLike, PropertyIsNull, PropertyIsNil, PropertyIsBetween, SpatialComparison,
                 DistanceComparison, TemporalComparison, ResourceId, And, Or, Not, ComponentGroup, NotUnderstood>
        predicate;
    bool operator==(Condition const&) const = default;
};

inline bool And::operator==(And const&) const = default;
inline bool Or::operator==(Or const&) const = default;
inline bool Not::operator==(Not const&) const = default;
inline bool ComponentGroup::operator==(ComponentGroup const&) const = default;

// --- The whole ---

enum class SortOrder : std::uint8_t { ascending, descending };

struct SortProperty {
    Expression by;
    SortOrder order = SortOrder::ascending;
    bool operator==(SortProperty const&) const = default;
};

// A filter and an order. An empty one matches everything.
struct QueryExpression {
    QueryExpression() = default;
    QueryExpression(Condition condition, std::vector<SortProperty> order = {})
        : filter{std::move(condition)}, sort_by{std::move(order)} {}

    std::optional<Condition> filter;
    std::vector<SortProperty> sort_by;  // most significant first
    bool operator==(QueryExpression const&) const = default;
};

// Returns the length of a unit (`uom`) in millimetres: mm, cm, m, km, or their full names (metre, meter). Returns nothing for an
// unknown unit.
std::optional<double> millimetres_in(std::string_view unit);

}  // namespace rois
