#include <algorithm>
#include <array>
#include <cmath>

#include "types/text/texts.hpp"
#include "xml/codec/decoding.hpp"
#include "xml/codec/names.hpp"

namespace rois::xml {

namespace {

using Node = MessageTree::Node;

// Reads the children of a successful reply. Returns false if a mandatory one is missing. One overload for each kind of content.
bool read(Node, Outcome&) { return true; }

template <class R>
concept HasResults = requires(R reply) {
    reply.results;
};
template <class R>
concept HasRef = requires(R reply) {
    reply.component_ref;
};

bool read_ref(Node node, Identifier& ref) {
    ref = decode_identifier(node.child("component_ref"));
    return !ref.code.empty();
}

template <class R>
requires HasResults<R> || HasRef<R>
bool read(Node node, R& reply) {
    bool complete = true;
    if constexpr (HasResults<R>) {
        complete = static_cast<bool>(node.child("results"));
        reply.results = decode_results(node.child("results"));
    }
    if constexpr (HasRef<R>) complete = read_ref(node, reply.component_ref) && complete;
    return complete;
}

bool read(Node node, Query::Reply& reply) {
    std::vector<Results> rows;
    for (auto const child : node.children())
        if (child.name() == "results") rows.push_back(decode_results(child));
    if (rows.empty() || !read_ref(node, reply.component_ref)) return false;
    reply.results = std::move(rows.front());
    rows.erase(rows.begin());
    reply.other_rows = std::move(rows);
    return true;
}

bool read(Node node, Connect::Reply& reply) {
    reply.session.text = node.child_text("session");
    if (auto const window = node.attribute("window")) reply.window = std::chrono::milliseconds{decode_unsigned(*window)};
    return !reply.session.text.empty();
}

bool read(Node node, StopEverything::Reply& reply) {
    if (auto const stop = node.attribute("stop")) reply.stop = decode_unsigned(*stop);
    for (auto const child : node.children())
        if (child.name() == "not_halted") reply.not_halted.emplace_back(child.text());
    return true;
}

// Null if the entry has none.
std::shared_ptr<ComponentTraits const> decode_traits(Node entry) {
    auto const moves = entry.attribute("moves");
    auto const when_stopped = to_code<CompletedStatus>(entry.attribute("when_stopped").value_or(""));
    if (!moves || !when_stopped) return {};
    ComponentTraits traits{
        .positions = {}, .codebooks = {}, .alternatives = {}, .status_when_stopped = *when_stopped, .moves = *moves == "true"};
    for (auto const part : entry.children()) {
        if (part.name() == "position") {
            traits.positions.emplace_back(part.text());
        } else if (part.name() == "codebook") {
            auto parameter = part.attribute_text("parameter");
            if (traits.codebooks.empty() || traits.codebooks.back().parameter != parameter)
                traits.codebooks.push_back({std::move(parameter), {}});
            traits.codebooks.back().known.emplace_back(part.text());
        } else if (part.name() == "alternatives") {
            auto& group = traits.alternatives.emplace_back();
            for (auto const parameter : part.children()) group.emplace_back(parameter.text());
        }
    }
    return std::make_shared<ComponentTraits const>(std::move(traits));
}

// NaN if the text is not three numbers.
std::array<double, 3> decode_three_numbers(std::string_view text) {
    auto const numbers = to_doubles(text);
    std::array<double, 3> three{};
    three.fill(std::nan(""));
    if (numbers.size() == three.size()) std::ranges::copy(numbers, three.begin());
    return three;
}

// A box whose corners are not two or three numbers each has no dimensions.
Geometry decode_box(Node node) {
    auto const low = to_doubles(node.child_text("low")), high = to_doubles(node.child_text("high"));
    Geometry box;
    box.crs = node.attribute_text("crs");
    box.dimensions = 0;
    if (low.size() != high.size() || low.size() < 2 || low.size() > 3) return box;
    box.dimensions = static_cast<std::uint8_t>(low.size());
    std::ranges::copy(low, box.low.begin());
    std::ranges::copy(high, box.high.begin());
    return box;
}

// Keeps invalid numbers: the engine reports the frame or place, and leaves it out.
Space decode_space(Node node) {
    Space space;
    for (auto const each : node.children()) {
        if (each.name() == "frame")
            space.frames.push_back({.crs = each.attribute_text("crs"),
                                    .base = each.attribute_text("base"),
                                    .position = decode_three_numbers(each.child_text("position")),
                                    .orientation = decode_three_numbers(each.child_text("orientation")),
                                    .covariance = to_doubles(each.child_text("covariance"))});
        else if (each.name() == "place")
            space.places.push_back({each.attribute_text("name"), decode_box(each)});
    }
    return space;
}

bool read(Node node, GetProfile::Reply& reply) {
    reply.space = decode_space(node.child("space"));
    for (auto const entry : node.child("components").children())
        reply.components.push_back({entry.attribute_text("ref"),
                                    entry.attribute_text("type"),
                                    entry.attribute_text("engine"),
                                    {},
                                    decode_traits(entry)});
    return static_cast<bool>(node.child("components"));
}

bool read(Node node, Search::Reply& reply) {
    for (auto const ref : node.child("component_ref_list").children()) reply.component_ref_list.push_back(decode_identifier(ref));
    return static_cast<bool>(node.child("component_ref_list"));
}

bool read(Node node, GetParameter::Reply& reply) {
    reply.parameters = decode_parameters(node.child("parameters"));
    return static_cast<bool>(node.child("parameters"));
}

bool read(Node node, SetParameter::Reply& reply) {
    reply.command_id.text = node.child_text("command_id");
    return static_cast<bool>(node.child("command_id"));
}

bool read(Node node, Execute::Reply& reply) {
    reply.command_unit_list = decode_sequence(node.child("CommandUnitSequence"));
    return static_cast<bool>(node.child("CommandUnitSequence"));
}

bool read(Node node, Subscribe::Reply& reply) {
    reply.subscribe_id.text = node.child_text("subscribe_id");
    return !reply.subscribe_id.text.empty();
}

template <class R>
std::optional<EngineMessage> read_reply(Node root) {
    std::optional<EngineMessage> message;
    auto const code = to_code<ReturnCode>(root.attribute("return_code").value_or(""));
    if (!code) return message;
    auto& answered = std::get<Answered>(message.emplace());
    answered.request_id = root.attribute_text("request_id");
    auto& reply = answered.reply.emplace<R>();
    reply.return_code = *code;
    if (*code != ReturnCode::ok) {
        reply.reason = root.child_text("reason");
    } else if (!read(root, reply)) {
        message.reset();
    }
    return message;
}

using ReadReply = std::optional<EngineMessage> (*)(Node);

template <class... Replies>
constexpr std::array<ReadReply, sizeof...(Replies)> readers_of(std::variant<Replies...> const*) {
    return {read_reply<Replies>...};
}
constexpr auto reply_readers = readers_of(static_cast<Reply const*>(nullptr));  // in the order of operation_names()

// --- Notifications ---

std::optional<Notification> read_event(Node root) {
    auto const expire = to_utc(root.child_text("expire"));
    ReceiveEvent event{.event_id = {root.child_text("event_id")},
                       .event_type = root.child_text("event_type"),
                       .subscribe_id = {root.child_text("subscribe_id")},
                       .expire = expire.value_or(Utc{}),
                       .component_ref = decode_identifier(root.child("component_ref")),
                       .results = {}};
    if (auto const results = root.child("results")) event.results = std::make_shared<Results const>(decode_results(results));
    if (!expire || event.event_id.text.empty() || event.event_type.empty()) return std::nullopt;
    return event;
}

std::optional<Notification> read_error(Node root) {
    auto const type = to_code<ErrorType>(root.child("error_type").text());
    if (!type) return std::nullopt;
    ReceiveError error{{root.child_text("error_id")}, *type, {}};
    if (auto const text = root.child("text")) error.text = std::string{text.text()};
    if (auto const ref = root.child("component_ref")) error.component_ref = decode_identifier(ref);
    return error;
}

std::optional<Notification> read_completed(Node root) {
    auto const status = to_code<CompletedStatus>(root.child("status").text());
    if (!status) return std::nullopt;
    Completed completed{{root.child_text("command_id")}, *status};
    if (auto const results = root.child("results")) completed.results = std::make_shared<Results const>(decode_results(results));
    completed.reason = root.child_text("reason");
    if (auto const active = root.attribute("active")) completed.active = decode_boolean(*active);
    return completed;
}

std::optional<Notification> read_change(Node root) {
    auto const status = to_code<ComponentStatus>(root.child("status").text());
    if (!status) return std::nullopt;
    return ComponentChanged{decode_identifier(root.child("component_ref")), *status, decode_results(root.child("results"))};
}

std::optional<Notification> read_notification(Node root) {
    auto const name = root.name();
    if (name == "receive_event") return read_event(root);
    if (name == "receive_error") return read_error(root);
    if (name == "completed") return read_completed(root);
    if (name == "component_changed") return read_change(root);
    if (name == "switched")
        return Switched{decode_identifier(root.child("component_ref")), root.child_text("from"), root.child_text("to"),
                        root.child_text("reason")};
    if (name == "lost") return Lost{decode_unsigned(root.attribute("count").value_or(""))};
    if (name == "profile_changed") return ProfileChanged{};
    return std::nullopt;
}

std::optional<EngineMessage> read_fault(Node root) {
    auto const code = to_code<FaultCode>(root.attribute("code").value_or(""));
    if (!code) return std::nullopt;
    Fault fault{*code, root.child_text("reason"), {}, root.attribute_text("request_id")};
    auto const line = root.attribute("line");
    if (line) fault.place = Place{decode_unsigned(*line), decode_unsigned(root.attribute("column").value_or("1"))};
    return fault;
}

// --- Results ---

Located read_located(Node node) {
    Located located{.of = node.attribute_text("of"),
                    .ref = node.attribute_text("ref"),
                    .crs = node.attribute_text("crs"),
                    .position = {},
                    .orientation = {},
                    .certainty = {}};
    auto const position = to_doubles(node.child("position").text());
    if (position.size() == located.position.size()) std::ranges::copy(position, located.position.begin());
    located.orientation = to_doubles(node.child("orientation").text());
    if (auto const reliability = node.child("reliability")) {
        auto const numbers = to_doubles(reliability.text());
        located.certainty = Located::Reliability{numbers.empty() ? 0 : numbers.front()};
    }
    if (auto const covariance = node.child("covariance")) located.certainty = Located::Covariance{to_doubles(covariance.text())};
    return located;
}

}  // namespace

Results decode_results(Node results) {
    Results read{decode_parameters(results, "result"), {}};
    for (auto const node : results.children()) {
        if (node.name() == "located") read.located.push_back(read_located(node));
    }
    return read;
}

std::optional<EngineMessage> decode_engine_message(MessageTree const& message) {
    constexpr std::string_view ending = "_response";
    auto const root = message.root();
    if (!root || message.name_space() != message_namespace) return std::nullopt;
    if (root.name() == "fault") return read_fault(root);
    if (root.name().ends_with(ending)) {
        auto const operation = root.name().substr(0, root.name().size() - ending.size());
        auto const names = operation_names();
        auto const found = std::ranges::find(names, operation);
        if (found == names.end()) return std::nullopt;
        return reply_readers.at(static_cast<std::size_t>(found - names.begin()))(root);
    }
    auto const sequence = root.attribute("sequence");
    auto notification = read_notification(root);
    if (!sequence || !notification) return std::nullopt;
    return NumberedNotification{decode_unsigned(*sequence), *std::move(notification)};
}

std::optional<std::vector<EngineState>> decode_engines(MessageTree const& message) {
    auto const root = message.root();
    if (!root || message.name_space() != message_namespace || root.name() != "engines") return std::nullopt;
    std::vector<EngineState> engines;
    for (auto const node : root.children()) {
        auto const is = to_code<EngineState::Is>(node.attribute("state").value_or(""));
        if (node.name() != "engine" || !is) return std::nullopt;
        EngineState engine{.name = std::string{node.attribute("name").value_or("")},
                           .is = *is,
                           .link = std::string{node.attribute("link").value_or("")},
                           .round_trip = {},
                           .components = decode_unsigned(node.attribute("components").value_or("0")),
                           .losses = decode_unsigned(node.attribute("losses").value_or("0")),
                           .last_error = std::string{node.child("last_error").text()}};
        constexpr double most = 1e9;  // ms; NaN is not below it
        if (auto const round_trip = to_double(node.attribute("round_trip").value_or(""));
            round_trip && std::abs(*round_trip) < most)
            engine.round_trip = std::chrono::nanoseconds{static_cast<std::int64_t>(*round_trip * 1e6)};
        engines.push_back(std::move(engine));
    }
    return engines;
}

std::optional<StopState> decode_stop_state(MessageTree const& message) {
    auto const root = message.root();
    if (!root || message.name_space() != message_namespace || root.name() != "stop_state") return std::nullopt;
    auto const stopped = root.child("stopped");
    if (!stopped) return std::nullopt;
    StopState state{decode_boolean(stopped.text()), {}};
    for (auto const node : root.children())
        if (node.name() == "not_halted") state.not_halted.emplace_back(node.text());
    return state;
}

}  // namespace rois::xml
