#include "engine/matching.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "engine/registry.hpp"
#include "types/texts.hpp"

namespace rois {

namespace {

Referred expression_value(Expression const& expression, Resolve const& resolve) {
    if (auto const* literal = std::get_if<Literal>(&expression)) return {.values = {{std::string{trimmed(literal->text)}}}};
    return resolve(trimmed(std::get<ValueReference>(expression).path));
}

Match match(PropertyIsEqualTo const& equal, Resolve const& resolve) {
    auto const left = expression_value(equal.left, resolve);
    auto const right = expression_value(equal.right, resolve);
    if (!left.values || !right.values) return Match::maybe;
    bool const ignore_case = !equal.match_case || left.ignore_case || right.ignore_case;
    for (auto const& a : *left.values)
        for (auto const& b : *right.values)
            if (ignore_case ? equal_ignoring_case(a, b) : a == b) return Match::yes;
    return Match::no;
}

Match match(And const& both, Resolve const& resolve) {
    auto worst = Match::yes;
    for (auto const& operand : both.operands) worst = std::min(worst, match(operand, resolve));
    return worst;
}

Match match(Or const& either, Resolve const& resolve) {
    auto best = Match::no;
    for (auto const& operand : either.operands) best = std::max(best, match(operand, resolve));
    return best;
}

Match match(NotUnderstood const&, Resolve const&) { return Match::no; }

using Problem = std::optional<std::string>;

Problem why_unusable(Condition const&, std::vector<std::string> const& known);

Problem why_unusable(Expression const& expression, std::vector<std::string> const& known) {
    auto const* reference = std::get_if<ValueReference>(&expression);
    if (reference == nullptr) return {};
    auto const name = trimmed(reference->path);
    if (std::ranges::any_of(known, [&](auto const& k) { return equal_ignoring_case(k, name); })) return {};
    std::string all;
    for (auto const& k : known) all += (all.empty() ? "" : ", ") + k;
    return "the condition refers to " + quoted(name) + ", which is not known here; known are " + all;
}

Problem why_unusable(PropertyIsEqualTo const& equal, std::vector<std::string> const& known) {
    if (auto problem = why_unusable(equal.left, known)) return problem;
    return why_unusable(equal.right, known);
}

Problem first_problem(std::vector<Condition> const& operands, std::vector<std::string> const& known) {
    for (auto const& operand : operands)
        if (auto problem = why_unusable(operand, known)) return problem;
    return {};
}

Problem why_unusable(And const& both, std::vector<std::string> const& known) { return first_problem(both.operands, known); }
Problem why_unusable(Or const& either, std::vector<std::string> const& known) { return first_problem(either.operands, known); }
Problem why_unusable(NotUnderstood const& what, std::vector<std::string> const&) { return what.reason; }

Problem why_unusable(Condition const& condition, std::vector<std::string> const& known) {
    return std::visit([&](auto const& predicate) { return why_unusable(predicate, known); }, condition.predicate);
}

Referred one(std::string value, bool ignore_case = false) { return {.values = {{std::move(value)}}, .ignore_case = ignore_case}; }

// What never changes of a component; nothing for what is no such reference.
std::optional<Referred> fixed(RegisteredComponent const& component, std::string_view reference) {
    if (equal_ignoring_case(reference, "component_ref") || equal_ignoring_case(reference, "name"))
        return one(component.entry().ref);
    if (equal_ignoring_case(reference, "component_type")) return one(component.entry().type, true);
    if (equal_ignoring_case(reference, "engine")) return one(component.entry().engine);
    return {};
}

std::optional<Referred> changing(RegisteredComponent const& component, std::string_view reference, Session const* asker) {
    if (equal_ignoring_case(reference, "status")) return one(std::string{to_text(component.status_for(asker))});
    if (equal_ignoring_case(reference, "bound")) return one(component.bound_to != nullptr ? "true" : "false");
    return {};
}

Referred result_of(Results const& results, std::string_view reference) {
    auto const* parameter = find(results.parameters, reference);
    if (parameter == nullptr) return {.values = std::vector<std::string>{}};
    return {.values = parameter->values};
}

// The texts of predicates, alike for those that mean the same.
std::string canonical(Condition const&);

std::string canonical(Expression const& expression, bool match_case) {
    if (auto const* literal = std::get_if<Literal>(&expression)) {
        auto const text = trimmed(literal->text);
        return "L" + std::to_string(text.size()) + ":" + (match_case ? std::string{text} : lower_case(text));
    }
    auto const path = lower_case(trimmed(std::get<ValueReference>(expression).path));
    return "R" + std::to_string(path.size()) + ":" + path;
}

std::string canonical(PropertyIsEqualTo const& equal) {
    auto first = canonical(equal.left, equal.match_case);
    auto second = canonical(equal.right, equal.match_case);
    if (second < first) std::swap(first, second);
    return std::string{equal.match_case ? "=" : "~"} + "(" + first + "," + second + ")";
}

template <class Operator>
void flatten(Operator const& many, std::set<std::string>& parts) {
    for (auto const& operand : many.operands) {
        if (auto const* same = std::get_if<Operator>(&operand.predicate)) {
            flatten(*same, parts);
        } else {
            parts.insert(canonical(operand));
        }
    }
}

template <class Operator>
std::string joined(char name, Operator const& many) {
    std::set<std::string> parts;
    flatten(many, parts);
    if (parts.size() == 1) return *parts.begin();
    std::string text{name};
    for (auto const& part : parts) text += "(" + part + ")";
    return text;
}

std::string canonical(And const& both) { return joined('&', both); }
std::string canonical(Or const& either) { return joined('|', either); }
std::string canonical(NotUnderstood const& what) { return what.reason; }

std::string canonical(Condition const& condition) {
    return std::visit([](auto const& predicate) { return canonical(predicate); }, condition.predicate);
}

}  // namespace

Match match(Condition const& condition, Resolve const& resolve) {
    return std::visit([&](auto const& predicate) { return match(predicate, resolve); }, condition.predicate);
}

std::optional<std::string> why_unusable(MaybeCondition const& condition, std::vector<std::string> const& known) {
    return condition ? why_unusable(*condition, known) : std::nullopt;
}

std::vector<std::string> component_references() {
    return {"component_ref", "component_type", "name", "engine", "status", "bound"};
}

bool matches(MaybeCondition const& condition, RegisteredComponent const& component, Session const* asker) {
    if (!condition) return true;
    return match(*condition, [&](std::string_view reference) {
               if (auto value = fixed(component, reference)) return *value;
               return changing(component, reference, asker).value_or(Referred{});
           }) == Match::yes;
}

bool could_match(MaybeCondition const& condition, RegisteredComponent const& component) {
    if (!condition) return true;
    return match(*condition, [&](std::string_view reference) { return fixed(component, reference).value_or(Referred{}); }) !=
           Match::no;
}

bool matches(MaybeCondition const& condition, RegisteredComponent const& component, Results const& event, Session const* asker) {
    if (!condition) return true;
    return match(*condition, [&](std::string_view reference) {
               if (auto value = fixed(component, reference)) return *value;
               if (auto value = changing(component, reference, asker)) return *value;
               return result_of(event, reference);
           }) == Match::yes;
}

bool depends_on_asker(MaybeCondition const& condition) {
    if (!condition) return false;
    bool asks = false;
    match(*condition, [&](std::string_view reference) {
        asks = asks || equal_ignoring_case(reference, "status");
        return Referred{};
    });
    return asks;
}

bool matches(MaybeCondition const& condition, Results const& results) {
    return !condition ||
           match(*condition, [&](std::string_view reference) { return result_of(results, reference); }) == Match::yes;
}

std::string canonical(MaybeCondition const& condition) { return condition ? canonical(*condition) : std::string{}; }

}  // namespace rois
