#include "journal/records.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "types/text/texts.hpp"
#include "types/text/to_number.hpp"
#include "xml/codec/codec.hpp"

namespace rois::journal {

namespace {

using nlohmann::json;
using Milliseconds = std::chrono::milliseconds;

// A number as a key: texts of equal length have the order of their numbers.
std::string key_of(std::uint64_t number) {
    auto digits = std::to_string(number);
    return std::string(20 - digits.size(), '0') + digits;
}

// The reason of a component may have bytes that are not UTF-8.
std::string text_of(json const& value) { return value.dump(-1, ' ', false, json::error_handler_t::replace); }

std::string document_of(Operation operation) { return xml::encode(Request{std::move(operation), {}}); }

std::string document_of(Results const& results) {
    GetCommandResult::Reply reply;
    reply.results = results;
    return xml::encode(Reply{std::move(reply)}, {});
}

std::string document_of(Numbered const& numbered) {
    auto const& notification = *numbered.notification;
    return std::string{xml::notification_head(notification.body)} + std::to_string(numbered.sequence) +
           notification.text(xml::notification_tail);
}

std::string value_of(StoredEngine const& engine) {
    return text_of(json{{"last_session", engine.last_session},
                        {"last_subscription", engine.last_subscription},
                        {"last_command", engine.last_command},
                        {"last_handle", engine.last_handle},
                        {"next_event", engine.next_event},
                        {"next_error", engine.next_error},
                        {"is_stopped", engine.is_stopped},
                        {"last_stop", engine.last_stop},
                        {"ended_owners", engine.ended_owners},
                        {"sessions_there", engine.sessions_there},
                        {"stops_there", engine.stops_there}});
}

std::string value_of(StoredSession const& session) {
    json bindings = json::array();
    for (auto const& each : session.bindings) {
        json binding{{"ref", each.ref}, {"switching", to_text(each.switching)}};
        if (each.preference) binding["preference"] = document_of(BindAny{*each.preference});
        if (!each.parameters.empty()) binding["parameters"] = document_of(SetParameter{{.code = each.ref}, each.parameters});
        bindings.push_back(std::move(binding));
    }
    return text_of(json{{"id", session.id.text},
                        {"rights", session.rights},
                        {"window", session.window.count()},
                        {"lease", session.lease.count()},
                        {"lease_http", session.lease_http.count()},
                        {"links_count", session.links_count},
                        {"is_engine", session.is_engine},
                        {"receives_switches", session.receives_switches},
                        {"last_stop", session.last_stop},
                        {"owns_stop", session.owns_stop},
                        {"bindings", std::move(bindings)}});
}

std::string value_of(StoredCommand const& command) {
    json value{{"type", command.type}, {"ref", command.ref}, {"provider", command.provider}, {"handle", command.handle}};
    if (auto const& end = command.end)
        value["end"] = {{"status", to_text(end->status)},
                        {"reason", end->reason},
                        {"results", document_of(end->results)},
                        {"at", std::chrono::duration_cast<Milliseconds>(end->at.time_since_epoch()).count()},
                        {"notified", end->notified}};
    return text_of(value);
}

// The largest values of the keys max_body, max_depth and so on: each document that the gateway has accepted must be read.
constexpr xml::DocumentLimits largest{.bytes = std::size_t{1} << 30,
                                      .depth = 1'024,
                                      .attributes = 1'024,
                                      .name_length = 4'096,
                                      .elements = 1'000'000,
                                      .namespaces = 1'024};

// Reads the values. A value of another type than expected is an exception of the JSON library.
class Reader {
public:
    explicit Reader(std::shared_ptr<xml::Schemas const> const& schemas) : requests_{schemas, largest} {}

    static StoredEngine engine(json const& value) {
        return {.last_session = value.at("last_session"),
                .last_subscription = value.at("last_subscription"),
                .last_command = value.at("last_command"),
                .last_handle = value.at("last_handle"),
                .next_event = value.at("next_event"),
                .next_error = value.at("next_error"),
                .is_stopped = value.at("is_stopped"),
                .last_stop = value.at("last_stop"),
                .ended_owners = value.value("ended_owners", std::vector<std::string>{}),
                .sessions_there = value.at("sessions_there"),
                .stops_there = value.value("stops_there", std::map<std::string, std::uint64_t>{})};
    }

    StoredSession session(Record const& record, json const& value) {
        StoredSession session{.session = record.key.session,
                              .id = {value.at("id").get<std::string>()},
                              .rights = value.at("rights"),
                              .window = milliseconds(value.at("window"), longest),
                              .lease = milliseconds(value.at("lease"), longest),
                              .lease_http = milliseconds(value.at("lease_http"), longest),
                              .links_count = value.at("links_count"),
                              .is_engine = value.at("is_engine"),
                              .receives_switches = value.at("receives_switches"),
                              .last_stop = value.at("last_stop"),
                              .owns_stop = value.at("owns_stop"),
                              .bindings = {}};
        for (auto const& each : value.at("bindings")) {
            auto& binding = session.bindings.emplace_back();
            binding.ref = each.at("ref");
            binding.switching = code<Switching>(each.at("switching"));
            if (auto const preference = each.find("preference"); preference != each.end())
                binding.preference = std::make_shared<QueryExpression const>(operation<BindAny>(*preference).condition);
            if (auto const parameters = each.find("parameters"); parameters != each.end())
                binding.parameters = operation<SetParameter>(*parameters).parameters;
        }
        return session;
    }

    StoredSubscription subscription(Record const& record) {
        return {record.key.session, {record.key.key}, operation<Subscribe>(record.value)};
    }

    StoredCommand command(Record const& record, json const& value) {
        StoredCommand command{.session = record.key.session,
                              .id = {record.key.key},
                              .type = value.at("type"),
                              .ref = value.at("ref"),
                              .provider = value.at("provider"),
                              .handle = value.at("handle"),
                              .end = {}};
        if (auto const end = value.find("end"); end != value.end())
            command.end = {.status = code<CompletedStatus>(end->at("status")),
                           .reason = end->at("reason"),
                           .results = results(end->at("results")),
                           .at = Utc{milliseconds(end->at("at"), latest)},
                           .notified = end->at("notified")};
        return command;
    }

    StoredNotification notification(Record const& record) {
        auto message = answers_.read(record.value);
        auto* numbered = message ? std::get_if<xml::NumberedNotification>(&*message) : nullptr;
        if (numbered == nullptr) throw std::invalid_argument("it is not a notification");
        if (key_of(numbered->sequence) != record.key.key) throw std::invalid_argument("its sequence is not that of its key");
        return {record.key.session,
                {numbered->sequence, std::make_shared<OutgoingNotification const>(std::move(numbered->notification))}};
    }

private:
    // Longer durations and later times would overflow in calculations.
    static constexpr std::int64_t longest = 10'000'000'000;    // 115 days
    static constexpr std::int64_t latest = 9'000'000'000'000;  // since 1970: in the year 2255
    static Milliseconds milliseconds(json const& value, std::int64_t most) {
        auto const number = value.get<std::int64_t>();
        if (number < 0 || number > most) throw std::invalid_argument(value.dump() + " is not from 0 to " + std::to_string(most));
        return Milliseconds{number};
    }

    template <class Code>
    static Code code(json const& value) {
        auto const& text = value.get_ref<std::string const&>();
        auto const known = to_code<Code>(text);
        if (!known) throw std::invalid_argument("unknown value " + rois::quoted(text));
        return *known;
    }

    template <class Known>
    Known operation(std::string const& document) {
        auto read = requests_.read(document);
        if (auto const* fault = std::get_if<Fault>(&read)) throw std::invalid_argument(fault->reason);
        auto* known = std::get_if<Known>(&std::get<Request>(read).operation);
        if (known == nullptr) throw std::invalid_argument("it is another operation");
        return std::move(*known);
    }

    Results results(std::string const& document) {
        auto message = answers_.read(document);
        auto* answered = message ? std::get_if<xml::Answered>(&*message) : nullptr;
        auto* reply = answered ? std::get_if<GetCommandResult::Reply>(&answered->reply) : nullptr;
        if (reply == nullptr) throw std::invalid_argument("its results cannot be read");
        return std::move(reply->results);
    }

    xml::RequestReader requests_;
    xml::AnswerReader answers_;
};

// The library reads an integer of more than 64 bits as a fraction, whose conversion to an integer would be undefined.
json parsed(std::string const& text) {
    return json::parse(text, [](int, json::parse_event_t event, json const& value) {
        if (event == json::parse_event_t::value && value.is_number_float())
            throw std::invalid_argument(value.dump() + " is not an integer of 64 bits");
        return true;
    });
}

void add(StoredState& state, Record const& record, Reader& reader) {
    auto const& kind = record.key.kind;
    if (kind == kind::command)
        state.commands.push_back(reader.command(record, parsed(record.value)));
    else if (kind == kind::engine)
        state.engine = Reader::engine(parsed(record.value));
    else if (kind == kind::notification)
        state.notifications.push_back(reader.notification(record));
    else if (kind == kind::session)
        state.sessions.push_back(reader.session(record, parsed(record.value)));
    else if (kind == kind::subscription)
        state.subscriptions.push_back(reader.subscription(record));
    else
        throw std::invalid_argument("unknown kind");
}

}  // namespace

RecordChanges records_of(Changes const& changes) {
    RecordChanges records;
    for (auto const& each : changes.unsubscribed) records.gone.push_back({kind::subscription, each.session, each.id});
    for (auto const& each : changes.forgotten_commands) records.gone.push_back({kind::command, each.session, each.id});
    for (auto const& each : changes.forgotten_notifications)
        records.forgotten.push_back({{kind::notification, each.session, key_of(each.from)}, key_of(each.until)});
    auto const set = [&](Key key, std::string value) { records.set.push_back({std::move(key), std::move(value)}); };
    set({kind::engine, 0, ""}, value_of(changes.engine));
    for (auto const& each : changes.sessions) set({kind::session, each.session, ""}, value_of(each));
    for (auto const& each : changes.subscriptions) set({kind::subscription, each.session, each.id.text}, document_of(each.asked));
    for (auto const& each : changes.commands) set({kind::command, each.session, each.id.text}, value_of(each));
    for (auto const& each : changes.notifications)
        set({kind::notification, each.session, key_of(each.numbered.sequence)}, document_of(each.numbered));
    records.ended = changes.ended;
    return records;
}

StoredState state_of(std::vector<Record> const& records, std::shared_ptr<xml::Schemas const> const& schemas) {
    StoredState state;
    Reader reader{schemas};
    for (auto const& record : records) {
        try {
            add(state, record, reader);
        } catch (std::exception const& problem) {
            auto why = "the " + rois::quoted(record.key.kind) + " " + rois::quoted(record.key.key) + " of session " +
                       std::to_string(record.key.session) + " cannot be read: " + problem.what();
            std::ranges::replace(why, '\n', ' ');
            throw BadRecord{why};
        }
    }
    return state;
}

}  // namespace rois::journal
