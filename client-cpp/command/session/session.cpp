#include "command/session/session.hpp"

#include <algorithm>
#include <cstdio>

#include "command/http.hpp"
#include "command/output/terminal.hpp"

namespace rois::command {

namespace {

// Returns whether the command runs on after its requests, and so retries without end while no gateway answers.
bool lasts(Options const& options) {
    bool const is_shared = !options.session.empty();  // there `bind` and `subscribe` end at once
    return options.command == "watch" || options.command == "record" || options.command == "scenario" ||
           ((options.command == "bind" || options.command == "subscribe") && !is_shared) || options.span;
}

// Limits the attempts of commands that end by themselves.
Settings settings_for(Options const& options) {
    check(server_of(options));
    auto settings = settings_of(options);
    if (!lasts(options)) settings.attempts = 3;
    // On a WebSocket the engine closes the link for a text that is not UTF-8 or too long, without a document.
    if (options.command == "send") settings.way = Way::http;
    return settings;
}

// Returns how long to wait for a session. Scripts wait for `bind` in the background and for `start`, whose --for begins later.
std::chrono::milliseconds patience(Options const& options) {
    bool const is_waited_for = runs_in_background(options) || options.command == "start";
    if (!lasts(options) || is_waited_for || options.span == std::chrono::milliseconds{0}) return options.deadline;
    auto longest = options.deadline_is_given ? options.deadline : std::chrono::milliseconds::max();
    if (!options.span) return longest;
    auto const left = options.started + *options.span - std::chrono::steady_clock::now();
    return std::clamp(std::chrono::ceil<std::chrono::milliseconds>(left), std::chrono::milliseconds{1}, longest);
}

}  // namespace

Session::Session(Options const& options, std::shared_ptr<RecordingWriter> recorded, Caller const& caller)
    : life_{whose_life(options)},
      caller_{caller},
      joined_{!options.session.empty()},
      url_{options.url},
      reports_attempts_{!settings_for(options).attempts && !options.quiet},
      connection_{settings_for(options), observers(std::move(recorded))} {
    auto const none = connection_.wait(connection_.opened(patience(options)));
    if (!none) return;
    if (joined_ && id().text.empty()) throw NoSession{none->reason};
    throw Trouble{Exit::no_answer, options.url + ": " + none->reason + hint_for_url(options.url)};
}

Session::Life Session::whose_life(Options const& options) {
    if (options.session.empty()) return options.command == "bind" ? Life::of_caller : Life::own;
    return options.command == "watch" || options.command == "subscribe" ? Life::of_others : Life::own;
}

bool Session::is_alive() const { return life_ == Life::own || (life_ == Life::of_caller && caller_.is_alive()); }

std::optional<Update> Session::next_update(Until until) {
    while (true) {
        if (is_alive()) connection_.alive();
        auto const next_sign = std::chrono::steady_clock::now() + connection_.between_signs_of_life();
        auto update = inbox_.take(Until{until ? std::min(*until, next_sign) : next_sign});
        if (update || inbox_.is_over() || (until && std::chrono::steady_clock::now() >= *until)) return update;
    }
}

Observers Session::observers(std::shared_ptr<RecordingWriter> recorded) {
    Observers observers;
    observers.attempt_failed = [this](FailedAttempt const& failed) {
        if (!reports_attempts_ || failed.reason == reported_) return;
        reported_ = failed.reason;
        std::fprintf(stderr, "rois: %s: %s; trying again\n", url_.c_str(), harmless(failed.reason).c_str());
    };
    observers.state = [this](StateChange const& change) {
        reported_.clear();
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
    if (joined_ && id().text.empty()) throw NoSession{std::get<NoAnswer>(answered).reason};
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
    settings.certificate_file = options.certificate_file;
    settings.session = options.session;
    settings.switches = watches_switches(options);
    settings.deadline = options.deadline;
    settings.connect_deadline = options.deadline;
    return settings;
}

}  // namespace rois::command
