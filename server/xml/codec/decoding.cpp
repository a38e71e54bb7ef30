#include "xml/codec/decoding.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <utility>

#include "types/text/texts.hpp"
#include "xml/codec/names.hpp"

namespace rois::xml {

namespace {

using Node = MessageTree::Node;

template <class Tag>
Id<Tag> child_id(Node node, std::string_view name) {
    return {node.child_text(name)};
}

Identifier component_ref(Node node) { return decode_identifier(node.child("component_ref")); }

QueryExpression condition(Node node) { return decode_condition(node.child("condition")); }

Switching switching(Node node) { return to_code<Switching>(node.attribute_text("switching")).value_or(Switching::none); }

std::optional<std::chrono::milliseconds> decode_lease(std::optional<std::string_view> text) {
    if (!text) return {};
    constexpr std::uint64_t more_than_any_lease = 1'000'000'000;
    return std::chrono::milliseconds{std::min(decode_unsigned(*text), more_than_any_lease)};
}

Operation decode_connect(Node node) {
    Connect connect{.motion_lease = decode_lease(node.attribute("motion_lease")),
                    .motion_lease_http = decode_lease(node.attribute("motion_lease_http")),
                    .motion_proof = {}};
    if (auto const proof = node.attribute("motion_proof"))
        connect.motion_proof = *proof == "request" ? MotionProof::request : MotionProof::pong;
    connect.is_engine = node.attribute_text("role") == "engine";
    connect.window = decode_lease(node.attribute("window"));
    connect.switches = decode_boolean(node.attribute("switches").value_or("false"));
    return connect;
}

Operation decode_resume(Node node) {
    return Resume{SessionId{node.attribute_text("session")}, decode_unsigned(node.attribute_text("last_sequence"))};
}

Operation decode_clear_stop(Node node) { return ClearStop{decode_unsigned(node.attribute_text("stop"))}; }

Operation decode_set_parameter(Node node) {
    return SetParameter{component_ref(node), decode_parameters(node.child("parameters")),
                        decode_boolean(node.attribute_text("check_only"))};
}

Operation decode_execute(Node node) {
    return Execute{decode_sequence(node.child("CommandUnitSequence")), decode_boolean(node.attribute_text("check_only"))};
}

Operation decode_subscribe(Node node) {
    return Subscribe{node.child_text("event_type"), condition(node), decode_boolean(node.attribute_text("inline_results"))};
}

using Decode = Operation (*)(Node);

constexpr std::array<std::pair<std::string_view, Decode>, std::variant_size_v<Operation>> operations{{
    {"connect", decode_connect},
    {"resume", decode_resume},
    {"disconnect", [](Node) -> Operation { return Disconnect{}; }},
    {"get_profile", [](Node n) -> Operation { return GetProfile{condition(n)}; }},
    {"get_error_detail",
     [](Node n) -> Operation {
         return GetErrorDetail{child_id<ErrorTag>(n, "error_id"), condition(n)};
     }},
    {"search", [](Node n) -> Operation { return Search{condition(n)}; }},
    {"bind",
     [](Node n) -> Operation {
         return Bind{component_ref(n), switching(n), decode_boolean(n.attribute("take_over").value_or("false"))};
     }},
    {"bind_any",
     [](Node n) -> Operation {
         return BindAny{condition(n), switching(n)};
     }},
    {"release", [](Node n) -> Operation { return Release{component_ref(n)}; }},
    {"get_parameter", [](Node n) -> Operation { return GetParameter{component_ref(n)}; }},
    {"set_parameter", decode_set_parameter},
    {"execute", decode_execute},
    {"get_command_result",
     [](Node n) -> Operation {
         return GetCommandResult{child_id<CommandTag>(n, "command_id"), condition(n)};
     }},
    {"query",
     [](Node n) -> Operation {
         return Query{n.child_text("query_type"), condition(n)};
     }},
    {"subscribe", decode_subscribe},
    {"unsubscribe", [](Node n) -> Operation { return Unsubscribe{child_id<SubscribeTag>(n, "subscribe_id")}; }},
    {"get_event_detail",
     [](Node n) -> Operation {
         return GetEventDetail{child_id<EventTag>(n, "event_id"), condition(n)};
     }},
    {"stop_everything", [](Node) -> Operation { return StopEverything{}; }},
    {"clear_stop", decode_clear_stop},
}};

constexpr auto names = [] {
    std::array<std::string_view, operations.size()> all;
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = operations[i].first;
    return all;
}();

// Validation has checked that the text is a whole number.
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

std::optional<Request> decode(MessageTree const& message) {
    if (message.name_space() != message_namespace) return std::nullopt;
    auto const root = message.root();
    for (auto const& [operation, decode_it] : operations) {
        if (operation == root.name()) return Request{decode_it(root), root.attribute_text("request_id")};
    }
    return std::nullopt;
}

Identifier decode_identifier(Node node) {
    return {node.attribute_text("code"), node.attribute_text("authority"), node.attribute_text("codebook_ref"),
            node.attribute_text("version")};
}

ParameterList decode_parameters(Node list, std::string_view element) {
    ParameterList parameters;
    for (auto const node : list.children()) {
        if (node.name() != element) continue;
        auto& parameter = parameters.emplace_back();
        parameter.name = node.attribute_text("name");
        for (auto const part : node.children()) {
            if (part.name() == "data_type_ref") parameter.data_type_ref = decode_identifier(part);
            if (part.name() == "value") parameter.values.emplace_back(part.text());
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
