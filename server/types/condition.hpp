// Conditions (ISO 19143 QueryExpression): the parsed form of the fes:Filter that many operations take.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace rois {

struct ValueReference {
    std::string path;
    bool operator==(ValueReference const&) const = default;
};

struct Literal {
    std::string text;
    bool operator==(Literal const&) const = default;
};

using Expression = std::variant<ValueReference, Literal>;

struct PropertyIsEqualTo {
    Expression left;
    Expression right;
    bool match_case = true;
    bool operator==(PropertyIsEqualTo const&) const = default;
};

struct Condition;

struct And {
    std::vector<Condition> operands;  // two or more
    bool operator==(And const&) const;
};

struct Or {
    std::vector<Condition> operands;  // two or more
    bool operator==(Or const&) const;
};

// Well-formed and valid, but not understood: what it says goes back to the application as BAD_PARAMETER.
struct NotUnderstood {
    std::string reason;
    bool operator==(NotUnderstood const&) const = default;
};

struct Condition {
    std::variant<PropertyIsEqualTo, And, Or, NotUnderstood> predicate;
    bool operator==(Condition const&) const = default;
};

inline bool And::operator==(And const&) const = default;
inline bool Or::operator==(Or const&) const = default;

}  // namespace rois
