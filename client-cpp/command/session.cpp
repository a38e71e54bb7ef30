#include "command/session.hpp"

namespace rois::command {

namespace {

// Commands that are over soon do not try for long.
Settings settings_for(Options const& options) {
    auto settings = settings_of(options);
    bool const lasts = options.command == "watch" || options.command == "subscribe" || options.command == "record" ||
                       options.command == "bind" || options.command == "scenario" || options.span;
    if (!lasts) settings.attempts = 3;
    // On a WebSocket the engine says nothing of what is not UTF-8 or too long: it closes the link.
    if (options.command == "send") settings.way = Way::http;
    return settings;
}

}  // namespace

Session::Session(Options const& options, std::shared_ptr<RecordingWriter> recorded)
    : joined_{!options.session.empty()}, connection_{settings_for(options), observers(std::move(recorded))} {
    auto const none = connection_.wait(connection_.opened(options.deadline));
    if (!none) return;
    if (joined_ && id().text.empty()) throw NoSession{none->reason};
    throw Trouble{Exit::no_answer, options.url + ": " + none->reason};
}

Observers Session::observers(std::shared_ptr<RecordingWriter> recorded) {
    Observers observers;
    observers.state = [this](StateChange const& change) {
        inbox_.put(change);
        if (change.state == State::closed) inbox_.close();
    };
    observers.gap = [this](Gap const& gap) { inbox_.put(gap); };
    observers.notification = [this](Notification const& notification, std::uint64_t sequence) {
        inbox_.put(News{notification, sequence});
    };
    if (recorded)
        observers.tap = [recorded = std::move(recorded)](Direction direction, std::string_view document) {
            recorded->add(direction, document);
        };
    return observers;
}

std::variant<Reply, Fault> Session::request(Operation operation) {
    auto answered = connection_.wait(connection_.request(Request{std::move(operation), {}}));
    if (auto* const reply = std::get_if<Reply>(&answered)) return std::move(*reply);
    if (auto* const fault = std::get_if<Fault>(&answered)) return std::move(*fault);
    if (interrupted()) throw Trouble{Exit::interrupted, ""};
    throw Trouble{Exit::no_answer, std::get<NoAnswer>(answered).reason};
}

std::string Session::send(std::string const& document) {
    auto sent = connection_.wait(connection_.send(document));
    if (auto* const answer = std::get_if<std::string>(&sent)) return std::move(*answer);
    if (interrupted()) throw Trouble{Exit::interrupted, ""};
    throw Trouble{Exit::no_answer, std::get<NoAnswer>(sent).reason};
}

void Session::interrupt() {
    interrupted_ = true;
    inbox_.close();
    connection_.close();
}

Settings settings_of(Options const& options) {
    Settings settings;
    settings.url = options.url;
    settings.way = options.over_http ? Way::http : Way::websocket;
    settings.token = options.token;
    settings.ca_file = options.ca_file;
    settings.session = options.session;
    settings.deadline = options.deadline;
    settings.connect_deadline = options.deadline;
    return settings;
}

}  // namespace rois::command
