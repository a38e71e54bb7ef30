// Conditions built in code (their meaning: docs/conditions.md):
//
//     type == "Navigation" && status == "READY"
//     result("number") > 0
//     position.within({7500_mm, 8200_mm, 11500_mm, 10200_mm})
#pragma once

#include <concepts>
#include <string>
#include <string_view>
#include <utility>

#include "rois/units.hpp"
#include "types/condition.hpp"

namespace rois {

// A rectangle along the axes of a frame, given by two opposite corners.
struct Box {
    Box(millimetres west, millimetres south, millimetres east, millimetres north, std::string frame = {})
        : x1{west}, y1{south}, x2{east}, y2{north}, crs{std::move(frame)} {}

    millimetres x1, y1;
    millimetres x2, y2;
    std::string crs;  // the frame; empty: that of the value it is compared with
};

Expression literal(std::string_view);
Expression literal(double);
Expression literal(Utc);
Expression literal(millimetres);
Expression literal(degrees);
inline Expression literal(std::string const& text) { return literal(std::string_view{text}); }
inline Expression literal(char const* text) { return literal(std::string_view{text}); }
inline Expression literal(std::integral auto number) { return literal(std::string_view{std::to_string(number)}); }
inline Expression literal(bool truth) { return literal(std::string_view{truth ? "true" : "false"}); }

// A value that a condition compares: a value reference of docs/conditions.md.
class Reference {
public:
    explicit Reference(std::string path) : path_{std::move(path)} {}

    template <class Value>
    Condition operator==(Value const& value) const {
        return compared(Comparator::equal, literal(value));
    }
    template <class Value>
    Condition operator!=(Value const& value) const {
        return compared(Comparator::not_equal, literal(value));
    }
    template <class Value>
    Condition operator<(Value const& value) const {
        return compared(Comparator::less, literal(value));
    }
    template <class Value>
    Condition operator>(Value const& value) const {
        return compared(Comparator::greater, literal(value));
    }
    template <class Value>
    Condition operator<=(Value const& value) const {
        return compared(Comparator::less_or_equal, literal(value));
    }
    template <class Value>
    Condition operator>=(Value const& value) const {
        return compared(Comparator::greater_or_equal, literal(value));
    }

    // Both boundaries included.
    template <class Value>
    Condition between(Value const& lower, Value const& upper) const {
        return between_expressions(literal(lower), literal(upper));
    }
    Condition like(std::string_view pattern) const;  // * matches any text, ? one character; \ escapes them
    Condition is_null() const;

    Condition within(Box const&) const;
    Condition within(std::string_view place) const;
    Condition near(Pose const&, millimetres) const;
    Condition near(std::string_view place, millimetres) const;

    Condition after(Utc) const;
    Condition before(Utc) const;
    Condition during(Period) const;

    Expression expression() const { return {ValueReference{path_}}; }

private:
    Condition compared(Comparator, Expression) const;
    Condition between_expressions(Expression lower, Expression upper) const;

    std::string path_;
};

// The type of a component: its URN or, for a type of the specification, the last part of it ("Navigation").
class TypeReference {
public:
    Condition operator==(std::string_view urn_or_name) const;
    Condition operator!=(std::string_view urn_or_name) const;
};

// The values that conditions compare. The examples above need `using namespace rois::conditions;`.
namespace conditions {

inline TypeReference const type;
inline Reference const component_ref{"component_ref"};
inline Reference const engine{"engine"};
inline Reference const status{"status"};
inline Reference const bound{"bound"};
inline Reference const location{"location"};       // of the component's robot
inline Reference const position{"position_data"};  // of the person or object of an event
inline Reference const timestamp{"timestamp"};

// A result of an event, a command or an answer, or a parameter of a component.
inline Reference result(std::string_view name) { return Reference{"Result/" + std::string{name}}; }
inline Reference parameter(std::string_view name) { return Reference{"Property/" + std::string{name}}; }

}  // namespace conditions

Condition operator&&(Condition, Condition);
Condition operator||(Condition, Condition);
Condition operator!(Condition);

// Sets the order in which the engine lists components, or tries them for bind_any:
// ordered(type == "Navigation", nearest_to("desk")). The first property counts most.
template <std::same_as<SortProperty>... Order>
QueryExpression ordered(QueryExpression condition, Order... order) {
    (condition.sort_by.push_back(std::move(order)), ...);
    return condition;
}
SortProperty nearest_to(std::string_view place);
SortProperty ascending(Reference const&);
SortProperty descending(Reference const&);

// Returns the query with an additional condition: components must meet both.
QueryExpression narrowed(QueryExpression, Condition);

}  // namespace rois
