#include "xml/decoding.hpp"

#include <array>
#include <charconv>
#include <limits>
#include <utility>

#include "types/texts.hpp"
#include "xml/names.hpp"
#include "xml/tree.hpp"

namespace rois::xml {

namespace {

std::string child_text(pugi::xml_node node, std::string_view name) { return text_of(child(node, name)); }

template <class Tag>
Id<Tag> child_id(pugi::xml_node node, std::string_view name) {
    return {child_text(node, name)};
}

Identifier component_ref(pugi::xml_node node) { return decode_identifier(child(node, "component_ref")); }

QueryExpression condition(pugi::xml_node node) { return decode_condition(child(node, "condition")); }

Operation decode_resume(pugi::xml_node node) {
    return Resume{SessionId{attribute_text(node, "session")}, decode_unsigned(attribute(node, "last_sequence").value())};
}

Operation decode_set_parameter(pugi::xml_node node) {
    return SetParameter{component_ref(node), decode_parameters(child(node, "parameters"))};
}

Operation decode_execute(pugi::xml_node node) { return Execute{decode_sequence(child(node, "CommandUnitSequence"))}; }

Operation decode_subscribe(pugi::xml_node node) {
    return Subscribe{child_text(node, "event_type"), condition(node), decode_boolean(attribute(node, "inline_results").value())};
}

using Decode = Operation (*)(pugi::xml_node);

constexpr std::array<std::pair<std::string_view, Decode>, std::variant_size_v<Operation>> operations{{
    {"connect", [](pugi::xml_node) -> Operation { return Connect{}; }},
    {"resume", decode_resume},
    {"disconnect", [](pugi::xml_node) -> Operation { return Disconnect{}; }},
    {"get_profile", [](pugi::xml_node n) -> Operation { return GetProfile{condition(n)}; }},
    {"get_error_detail",
     [](pugi::xml_node n) -> Operation {
         return GetErrorDetail{child_id<ErrorTag>(n, "error_id"), condition(n)};
     }},
    {"search", [](pugi::xml_node n) -> Operation { return Search{condition(n)}; }},
    {"bind", [](pugi::xml_node n) -> Operation { return Bind{component_ref(n)}; }},
    {"bind_any", [](pugi::xml_node n) -> Operation { return BindAny{condition(n)}; }},
    {"release", [](pugi::xml_node n) -> Operation { return Release{component_ref(n)}; }},
    {"get_parameter", [](pugi::xml_node n) -> Operation { return GetParameter{component_ref(n)}; }},
    {"set_parameter", decode_set_parameter},
    {"execute", decode_execute},
    {"get_command_result",
     [](pugi::xml_node n) -> Operation {
         return GetCommandResult{child_id<CommandTag>(n, "command_id"), condition(n)};
     }},
    {"query",
     [](pugi::xml_node n) -> Operation {
         return Query{child_text(n, "query_type"), condition(n)};
     }},
    {"subscribe", decode_subscribe},
    {"unsubscribe", [](pugi::xml_node n) -> Operation { return Unsubscribe{child_id<SubscribeTag>(n, "subscribe_id")}; }},
    {"get_event_detail",
     [](pugi::xml_node n) -> Operation {
         return GetEventDetail{child_id<EventTag>(n, "event_id"), condition(n)};
     }},
}};

constexpr auto names = [] {
    std::array<std::string_view, operations.size()> all;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = operations[i].first;
    return all;
}();

// A text that validation knows to be a whole number.
template <class Number>
Number whole_number(std::string_view text) {
    text = trimmed(text);
    bool const negative = text.starts_with('-');
    if (text.starts_with('+')) text.remove_prefix(1);
    Number number = 0;
    if (std::from_chars(text.data(), text.data() + text.size(), number).ec != std::errc::result_out_of_range) return number;
    return negative ? std::numeric_limits<Number>::min() : std::numeric_limits<Number>::max();
}

}  // namespace

std::span<std::string_view const> operation_names() { return names; }

std::optional<Request> decode(pugi::xml_node root) {
    if (namespace_of(root, prefix_of(root.name())) != message_namespace) return std::nullopt;
    auto const name = local_name(root);
    for (auto const& [operation, decode_it] : operations) {
        if (operation == name) return Request{decode_it(root), attribute_text(root, "request_id")};
    }
    return std::nullopt;
}

Identifier decode_identifier(pugi::xml_node node) {
    return {attribute_text(node, "code"), attribute_text(node, "authority"), attribute_text(node, "codebook_ref"),
            attribute_text(node, "version")};
}

ParameterList decode_parameters(pugi::xml_node list) {
    ParameterList parameters;
    for (auto const node : list.children()) {
        if (local_name(node) != "parameter") continue;
        auto& parameter = parameters.emplace_back();
        parameter.name = attribute_text(node, "name");
        for (auto const part : node.children()) {
            if (local_name(part) == "data_type_ref") parameter.data_type_ref = decode_identifier(part);
            if (local_name(part) == "value") parameter.values.push_back(text_of(part));
        }
    }
    return parameters;
}

bool decode_boolean(std::string_view text) {
    text = trimmed(text);
    return text == "true" || text == "1";
}

std::int64_t decode_integer(std::string_view text) { return whole_number<std::int64_t>(text); }

std::uint64_t decode_unsigned(std::string_view text) { return whole_number<std::uint64_t>(text); }

}  // namespace rois::xml
