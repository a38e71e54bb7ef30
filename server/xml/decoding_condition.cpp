#include <variant>

#include "types/texts.hpp"
#include "xml/decoding.hpp"
#include "xml/tree.hpp"

namespace rois::xml {

namespace {

NotUnderstood not_understood(std::string_view what) {
    return {"the condition has " + quoted(what) + ", which is not understood"};
}

std::vector<pugi::xml_node> elements_in(pugi::xml_node node) {
    std::vector<pugi::xml_node> elements;
    for (auto const each : node.children()) {
        if (each.type() == pugi::node_element) elements.push_back(each);
    }
    return elements;
}

std::variant<Expression, NotUnderstood> decode_expression(pugi::xml_node node) {
    if (local_name(node) == "ValueReference") return Expression{ValueReference{std::string{trimmed(text_of(node))}}};
    auto const inside = elements_in(node);
    if (local_name(node) == "Literal" && inside.empty()) return Expression{Literal{text_of(node)}};
    return not_understood(inside.empty() ? local_name(node) : local_name(inside.front()));
}

Condition decode_equal(pugi::xml_node node) {
    auto const operands = elements_in(node);
    auto left = decode_expression(operands.at(0));
    auto right = decode_expression(operands.at(1));
    for (auto const* side : {&left, &right}) {
        if (auto const* problem = std::get_if<NotUnderstood>(side)) return {*problem};
    }
    auto const action = attribute(node, "matchAction");
    if (action && std::string_view{action.value()} != "Any") return {not_understood("matchAction")};
    auto const match_case = attribute(node, "matchCase");
    return {PropertyIsEqualTo{std::get<Expression>(std::move(left)), std::get<Expression>(std::move(right)),
                              !match_case || decode_boolean(match_case.value())}};
}

Condition decode_predicate(pugi::xml_node node);

// What is not understood in one operand makes the whole so.
template <class Logic>
Condition decode_logic(pugi::xml_node node) {
    Logic logic;
    for (auto const operand : elements_in(node)) {
        auto decoded = decode_predicate(operand);
        if (std::holds_alternative<NotUnderstood>(decoded.predicate)) return decoded;
        logic.operands.push_back(std::move(decoded));
    }
    return {std::move(logic)};
}

Condition decode_predicate(pugi::xml_node node) {
    if (local_name(node) == "PropertyIsEqualTo") return decode_equal(node);
    if (local_name(node) == "And") return decode_logic<And>(node);
    if (local_name(node) == "Or") return decode_logic<Or>(node);
    return {not_understood(local_name(node))};
}

}  // namespace

MaybeCondition decode_condition(pugi::xml_node condition) {
    auto const wrappers = elements_in(condition);
    if (wrappers.empty()) return std::nullopt;
    auto const inside = elements_in(wrappers.front());
    if (inside.empty()) return std::nullopt;  // an empty one restricts nothing
    if (local_name(wrappers.front()) != "Filter") return Condition{not_understood(local_name(wrappers.front()))};
    return decode_predicate(inside.front());
}

}  // namespace rois::xml
