#include "net/websocket.hpp"

#include <spdlog/spdlog.h>

#include <boost/asio/co_spawn.hpp>
#include <exception>
#include <utility>

#include "net/event_stream.hpp"

namespace rois::net {

namespace {

constexpr std::size_t most_at_once = 64;                                // notifications of one write
constexpr std::size_t most_answers_kept = 16 * 1024;                    // bytes of memory for answers, while there are none
constexpr std::size_t longest_negligible = 4 * 1024;                    // bytes of requests
constexpr unsigned most_controls = 50;                                  // control frames a second
constexpr auto between_signs_of_life = std::chrono::milliseconds{500};  // that are asked for while the robot moves
constexpr auto longest_farewell = std::chrono::seconds{2};              // from our close frame to the end of the connection

template <class... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};

Steady now() { return std::chrono::steady_clock::now(); }

}  // namespace

WebSocket::WebSocket(std::shared_ptr<Wire> wire, Gateway& gateway, Telemetry& telemetry, xml::RequestReader& reader,
                     LongDocuments& long_documents, Wakes& wakes, Settings const& settings, std::shared_ptr<Opener> opener)
    : Reader{wakes},
      wire_{std::move(wire)},
      telemetry_{telemetry},
      heard_{now()},
      pings_{static_cast<std::uint64_t>(heard_.time_since_epoch().count())},
      settings_{settings},
      gateway_{gateway},
      reader_{reader},
      long_documents_{long_documents},
      messages_{settings.document.bytes, settings.max_fragments},
      opener_{std::move(opener)} {}

// However it ends, nobody finds it among the session's readers any more when it has.
Task<> WebSocket::run() {
    struct End {
        WebSocket& of;
        ~End() { of.break_off(); }
    } const end{*this};
    auto outcome = Wire::Outcome::done;
    while (outcome == Wire::Outcome::done && !broken_) {
        while (!take_frames()) co_await pause();
        flush();
        if (ending_) wire_->use(wire_->received().size());
        outcome = co_await wire_->receive(Steady::max());
        heard_something_ = true;
        if (wire_->received().size() > longest_negligible) gateway_.memory().took(wire_->received().size());
    }
    break_off();
    while (writing_) co_await something_written();
}

void WebSocket::break_off() noexcept {
    broken_ = true;
    wire_->cut();
    reading_.reset();
}

// Takes the whole frames that have arrived. False: some may be left, to be taken after a pause.
bool WebSocket::take_frames() {
    while (!ending_ && !broken_) {
        if (farewell_ || full() || !long_message_.empty()) return false;
        std::size_t used = 0;
        auto const heard = messages_.next(wire_->received(), used);
        bool const incomplete = std::holds_alternative<MessageReader::Incomplete>(heard);
        if (std::holds_alternative<MessageReader::Text>(heard)) message_due_ = Steady::max();  // the next one has its own time
        if (!incomplete) take(heard);
        wire_->use(used);
        if (incomplete) break;
    }
    note_message();
    auto& memory = gateway_.memory();
    auto const unfinished = wire_->received().size() + gathered();
    if (unfinished > memory.longest_document()) {
        memory.refuse("");
        close({CloseCode::policy_violation, "no memory for a long message: memory_budget is nearly used up; try again later"});
    }
    return true;
}

void WebSocket::take(MessageReader::Heard const& heard) {
    std::visit(
        Overloaded{[&](MessageReader::Text message) {
                       if (LongDocuments::is_long(message.text.size()))
                           long_message_ = message.text;
                       else
                           answered(gateway_.answer(reader_, session_, message.text, Via::websocket, opener_, reading_.get()));
                   },
                   [&](MessageReader::Ping ping) {
                       note_control();
                       if (!ending_) say_pong(ping.payload);
                   },
                   [&](MessageReader::Pong pong) {
                       note_control();
                       if (pings_.take_answer(pong.payload) && reading_ && reading_->wants_signs_of_life(now()))
                           reading_->heard_pong();
                   },
                   [&](MessageReader::Closed closed) {
                       close({closed.code, ""});
                   },
                   [&](MessageReader::Violation wrong) {
                       close({wrong.code, wrong.reason});
                   },
                   [](auto) {}},
        heard);
}

void WebSocket::answered(Answer&& answer) {
    if (answer.turn == Answer::Turn::disconnected) {
        farewell_ = std::make_unique<Answer>(std::move(answer));
    } else {
        say(answer);
    }
}

void WebSocket::say(Answer const& answer) {
    append_frame(answers_, Opcode::text, answer.document);
    ++answers_waiting_;
    join(answer);
    if (!answer.fault) return;
    if (is_logged(answer.fault->code)) log_fault(*answer.fault, "a message on a WebSocket", wire_->peer());
    if (answer.fault->code == FaultCode::too_many && !reading_) close({CloseCode::policy_violation, "too many sessions"});
}

// Pongs wait among the answers, in the order of what they answer, and count as answers: a peer that sends pings and reads nothing
// is not read any more.
void WebSocket::say_pong(std::string_view payload) {
    append_frame(answers_, Opcode::pong, payload);
    ++answers_waiting_;
}

// Until the next frame may be taken.
Task<> WebSocket::pause() {
    if (!long_message_.empty()) co_await answer_long_message();
    if (farewell_) co_await say_farewell();
    if (full()) co_await wait_for_room();
}

Task<> WebSocket::answer_long_message() {
    auto const message = std::exchange(long_message_, {});
    answered(co_await long_documents_.answer(gateway_, session_, message, Via::websocket, opener_));
}

Task<> WebSocket::say_farewell() {
    while (gather_notifications(answers_)) {
    }
    reading_.reset();
    flush();
    co_await others_heard(gateway_, session_, wire_->executor(), wakes());
    say(*std::exchange(farewell_, nullptr));
}

// Follows the answer to the session that it opened, took over or left.
void WebSocket::join(Answer const& answer) {
    if (answer.turn == Answer::Turn::stays) return;
    if (answer.session_number != 0) {
        bool const resumed = answer.turn == Answer::Turn::resumed;
        log_joined(answer.session_number, resumed ? "resumed over a WebSocket" : "opened over a WebSocket", wire_->peer());
    }
    bool const same = answer.session == session_ && reading_;
    session_ = answer.session;
    if (answer.turn == Answer::Turn::disconnected) return;
    if (same && answer.turn == Answer::Turn::connected) return;
    reading_.reset();
    session_over_ = false;
    auto read = gateway_.read(session_, Link::websocket, answer.last_sequence, *this);
    if (auto* reading = std::get_if<std::unique_ptr<Reading>>(&read)) reading_ = std::move(*reading);
}

// Reading stops while as many answers wait as may be in flight.
Task<> WebSocket::wait_for_room() {
    flush();
    auto const is_full = [this] { return full() || answers_waiting_ + answers_in_out_ >= settings_.max_requests_in_flight; };
    while (is_full() && !broken_ && !close_gathered_) co_await something_written();
}

Task<> WebSocket::something_written() {
    room_ = std::make_shared<Signal>(wire_->executor(), wakes());
    co_await room_->wait_until(Steady::max());
    room_.reset();
}

void WebSocket::note_message() {
    if (wire_->received().empty() && !messages_.in_message()) {
        message_due_ = Steady::max();
    } else if (message_due_ == Steady::max()) {
        message_due_ = now() + settings_.request_timeout;
    }
}

// A ping or a pong. Few are ever needed, and each ping costs an answer.
void WebSocket::note_control() {
    auto const present = now();
    if (present - controls_since_ >= std::chrono::seconds{1}) {
        controls_since_ = present;
        controls_ = 0;
    }
    if (++controls_ > most_controls) close({CloseCode::policy_violation, "more than 50 control frames a second"});
}

void WebSocket::close(Ending ending) {
    if (ending_) return;
    if (ending.code != CloseCode::normal)
        spdlog::debug("a WebSocket closes with {}: {}", static_cast<int>(ending.code), ending.reason);
    ending_ = ending;
}

void WebSocket::taken_over() { close({CloseCode::policy_violation, "the session goes on elsewhere"}); }

void WebSocket::sweep(Steady at) {
    if (std::exchange(heard_something_, false)) {
        heard_ = at;
        pinged_ = false;
    }
    if (at >= close_due_ || at >= heard_ + 2 * settings_.ping_interval) {
        wire_->cut();
        return;
    }
    bool const late = at >= message_due_ && !ending_;
    bool const silent = at >= heard_ + settings_.ping_interval && !std::exchange(pinged_, true);
    if (reading_) session_due_ = Steady::max();
    if (!reading_ && session_due_ == Steady::max()) session_due_ = at + settings_.connect_timeout;
    bool const without_session = at >= session_due_ && !ending_;
    if (late) close({CloseCode::policy_violation, "the message did not arrive in time"});
    if (without_session) close({CloseCode::policy_violation, "no session was opened or resumed in time"});
    bool const proof_due = at >= proof_due_ && reading_ && reading_->wants_signs_of_life(at);
    if (proof_due) proof_due_ = at + between_signs_of_life;
    if (silent || proof_due) ping_due_ = true;
    if (late || ping_due_ || without_session) flush();
}

void WebSocket::shut_down() {
    close({CloseCode::going_away, "the gateway is shutting down"});
    flush();
}

// What fails in the middle may have taken notifications from the session's queue: the client finds them there when it resumes.
void WebSocket::flush() {
    try {
        write();
    } catch (...) {
        writing_ = false;
        break_off();
        throw;
    }
}

// Most writes are taken whole: those are put together where the last one was, of whatever connection, since that memory is near.
void WebSocket::write() {
    thread_local std::string near;
    while (!writing_ && !broken_) {
        near.clear();
        bool const more = gather(near);
        if (near.empty()) return;
        auto const sent = wire_->send_now(near);
        if (sent < near.size()) return keep_unsent(std::string_view{near}.substr(sent));
        written();
        if (!more) return;
    }
}

// Writes it when the peer takes more: not while memory_budget is used up.
void WebSocket::keep_unsent(std::string_view rest) {
    auto& memory = gateway_.memory();
    memory.took(rest.size());
    if (memory.full()) {
        spdlog::warn("the WebSocket of {} was cut: {}", wire_->peer(),
                     memory.refuse("there is no memory for what it does not read"));
        telemetry_.cut();
        broken_ = true;
        wire_->cut();
        if (room_) room_->raise();
        return;
    }
    out_.assign(rest);
    writing_ = true;
    auto const self = std::static_pointer_cast<WebSocket>(shared_from_this());
    auto const drained = [self](std::exception_ptr const& broken) {
        if (!broken) return;
        self->writing_ = false;
        self->break_off();
        if (self->room_) self->room_->raise();
    };
    asio::co_spawn(
        wire_->executor(), [self] { return self->drain(); }, drained);
}

// Appends what waits, as much as goes out at once; true when there is more.
bool WebSocket::gather(std::string& out) {
    if (close_gathered_) return false;
    out.append(answers_);
    answers_.clear();
    if (answers_.capacity() > most_answers_kept) answers_.shrink_to_fit();
    answers_in_out_ = std::exchange(answers_waiting_, 0);
    if (std::exchange(ping_due_, false)) {
        auto const payload = pings_.next();
        append_frame(out, Opcode::ping, {payload.data(), payload.size()});
    }
    bool const more = (!ending_ || ending_->code == CloseCode::going_away) && gather_notifications(out);
    if (ending_ && !more) {
        append_close(out, ending_->code, ending_->reason);
        close_gathered_ = true;
    }
    if (out.empty() && session_over_) reading_.reset();  // it had nothing left to say
    return more;
}

// Appends some of the session's notifications; true when there are more. The link ends with the session's last.
bool WebSocket::gather_notifications(std::string& out) {
    if (!reading_) return false;
    thread_local std::vector<Numbered> taken;
    taken.clear();  // of what an exception has left there
    auto const then = reading_->take(most_at_once, taken);
    for (auto const& numbered : taken) {
        NotificationDocument const document{numbered};
        append_text_head(out, document.size());
        document.append_to(out);
    }
    telemetry_.delivered(taken.size());
    taken.clear();
    session_over_ = then == Reading::Then::ended || then == Reading::Then::overflowed;
    if (then == Reading::Then::overflowed) close({CloseCode::policy_violation, "too many notifications waited"});
    return then == Reading::Then::more;
}

void WebSocket::written() {
    answers_in_out_ = 0;
    if (session_over_) reading_.reset();
    if (close_gathered_ && close_due_ == Steady::max()) {
        reading_.reset();
        wire_->finish();
        close_due_ = now() + longest_farewell;
    }
    if (room_) room_->raise();
}

// Writes what the socket did not take at once, then goes on with what has come since.
Task<> WebSocket::drain() {
    auto const outcome = co_await wire_->send(out_);
    std::string{}.swap(out_);
    writing_ = false;
    if (outcome == Wire::Outcome::done) {
        written();
        flush();
    } else {
        break_off();
    }
    if (room_) room_->raise();
}

}  // namespace rois::net
