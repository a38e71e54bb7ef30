#include "net/websocket/websocket.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include <boost/asio/co_spawn.hpp>
#include <exception>
#include <utility>

#include "net/http/event_stream.hpp"
#include "net/loop.hpp"

namespace rois::net {

namespace {

constexpr std::size_t most_answers = 64 * 1024;                  // bytes of waiting answers; with more, nothing is read
constexpr std::size_t most_at_once = 64;                         // notifications in one write
constexpr std::size_t most_pending_of_engine = 1024;             // requests that wait for components; with more, nothing is read
constexpr std::size_t most_kept = 16 * 1024;                     // bytes of memory that an empty buffer of answers may keep
constexpr std::size_t longest_negligible = 4 * 1024;             // bytes of requests that the memory budget does not count
constexpr auto proof_interval = std::chrono::milliseconds{500};  // of pings while the robot moves
constexpr auto longest_closing = std::chrono::seconds{2};        // from our close frame to the end of the connection

Steady now() { return std::chrono::steady_clock::now(); }

}  // namespace

WebSocket::WebSocket(std::shared_ptr<Wire> wire, Loop& loop, std::shared_ptr<Client> client)
    : Reader{loop.wakes()},
      wire_{std::move(wire)},
      shared_{loop.shared()},
      received_at_{now()},
      pings_{static_cast<std::uint64_t>(received_at_.time_since_epoch().count())},
      loop_{loop},
      client_{std::move(client)} {}

bool WebSocket::full() const {
    auto const unsent = answers_waiting_ + answers_in_out_;
    auto const most = shared_.settings().max_requests_in_flight;
    if (in_any_order()) return unsent >= most || pending_.size() >= most_pending_of_engine || answers_.size() > most_answers;
    return unsent + pending_.size() >= most || answers_.size() > most_answers;
}

// An engine asks for many applications at once: a slow component must not delay its requests to the others (decision 39).
bool WebSocket::in_any_order() const { return reading_ && reading_->is_of_engine(); }

Task<> WebSocket::run() {
    // Leaves the session's readers also after an exception.
    struct End {
        WebSocket& of;
        ~End() { of.break_off(); }
    } const end{*this};
    waker_ = std::make_shared<Waker>(wakes(), [of = weak_from_this()] {
        if (auto const self = of.lock()) static_cast<WebSocket&>(*self).flush();
    });
    auto outcome = Wire::Outcome::done;
    while (outcome == Wire::Outcome::done && !broken_) {
        while (!take_frames()) co_await pause();
        flush();
        if (ending_) wire_->use(wire_->received().size());
        outcome = co_await wire_->receive(Steady::max());
        has_received_ = true;
        if (wire_->received().size() > longest_negligible) shared_.gateway.memory().took(wire_->received().size());
    }
    break_off();
    while (writing_) co_await something_written();
}

void WebSocket::break_off() noexcept {
    broken_ = true;
    wire_->cut();
    reading_.reset();
    if (room_) room_->raise();
}

// Handles the complete frames that have arrived. Returns false if the rest must wait for `pause`.
bool WebSocket::take_frames() {
    while (!ending_ && !broken_) {
        if (last_answer_ || session_changes_ || full() || !long_message_.empty()) return false;
        std::size_t used = 0;
        messages_.limit(shared_.settings().document.bytes, shared_.settings().max_fragments);
        auto const received = messages_.next(wire_->received(), used);
        if (received.kind == Received::Kind::nothing) break;
        if (received.kind == Received::Kind::text) message_due_ = Steady::max();  // the next message has its own deadline
        take(received);
        wire_->use(used);
    }
    note_message();
    auto& memory = shared_.gateway.memory();
    auto const unfinished = wire_->received().size() + gathered();
    if (unfinished > memory.longest_document()) {
        memory.refuse("");
        close({CloseCode::policy_violation, "no memory for a long message: memory_budget is nearly used up; try again later"});
    }
    return true;
}

void WebSocket::take(Received const& received) {
    switch (received.kind) {
        case Received::Kind::text:
            if (shared_.settings().echo)
                return_message(received.text);
            else if (LongDocuments::is_long(received.text.size()))
                long_message_ = received.text;
            else
                take(shared_.gateway.answer(loop_.reader(), session_, received.text, Via::websocket, waker_, client_,
                                            reading_.get()));
            break;
        case Received::Kind::ping:
            note_control();
            if (!ending_) add_pong(received.text);
            break;
        case Received::Kind::pong:
            note_control();
            if (pings_.take_answer(received.text) && reading_ && reading_->wants_signs_of_life(now())) reading_->note_pong();
            break;
        case Received::Kind::close:
            close({received.code, ""});
            break;
        case Received::Kind::violation:
            close({received.code, received.text});
            break;
        case Received::Kind::fragment:
        case Received::Kind::nothing:
            break;
    }
}

void WebSocket::take(PendingAnswer&& answer) {
    bool const is_sign_of_life = in_any_order() && answer.is_about_session() && !answer.is_disconnect();
    if (is_sign_of_life) take_answers();
    if ((pending_.empty() || is_sign_of_life) && answer.has_come()) return answered(answer.take());
    session_changes_ = answer.is_about_session();
    answer.delay();
    pending_.push_back(std::move(answer));
}

// Takes the answers that have come, as far as the order of the requests counts. A disconnect is always answered last. Looks at
// the newest one first: if it has come, the ones that came before it are not overlooked.
void WebSocket::take_answers() {
    std::list<PendingAnswer> come;
    for (auto each = pending_.end(); in_any_order() && each != pending_.begin();) {
        --each;
        if (each->is_disconnect() || !each->has_come()) continue;
        auto const taken = each++;
        come.splice(come.begin(), pending_, taken);
    }
    while (!pending_.empty() && pending_.front().has_come()) come.splice(come.end(), pending_, pending_.begin());
    for (auto& answer : come) answered(answer.take());
    if (pending_.empty()) session_changes_ = false;
    if (room_) room_->raise();
}

void WebSocket::answered(Answer&& answer) {
    if (answer.turn == Answer::Turn::disconnected) {
        last_answer_ = std::make_unique<Answer>(std::move(answer));
    } else {
        add(answer);
    }
}

void WebSocket::add(Answer const& answer) {
    append_frame(answers_, Opcode::text, answer.document);
    ++answers_waiting_;
    join(answer);
    if (!answer.fault) return;
    if (is_logged(answer.fault->code)) log_fault(*answer.fault, "a message on a WebSocket", wire_->peer());
    if (answer.fault->code == FaultCode::too_many && !reading_) close({CloseCode::policy_violation, "too many sessions"});
}

void WebSocket::return_message(std::string_view text) {
    append_frame(answers_, Opcode::text, text);
    ++answers_waiting_;
}

// Pongs and answers are sent in the order of the frames that they answer. A pong counts as an answer, so the gateway stops
// reading from a peer that sends pings and reads nothing.
void WebSocket::add_pong(std::string_view payload) {
    append_frame(answers_, Opcode::pong, payload);
    ++answers_waiting_;
}

// Waits until the next frame may be handled.
Task<> WebSocket::pause() {
    if (!long_message_.empty()) co_await answer_long_message();
    while (session_changes_ && !broken_ && !close_gathered_) co_await something_written();
    if (last_answer_) co_await leave_session();
    if (full()) co_await wait_for_room();
}

Task<> WebSocket::answer_long_message() {
    auto const message = std::exchange(long_message_, {});
    take(co_await shared_.long_documents.answer(shared_.settings(), shared_.gateway, session_, message, Via::websocket, waker_,
                                                client_, wakes()));
}

// Sends the session's last notifications, waits until its other readers have received them too, and then answers the disconnect.
Task<> WebSocket::leave_session() {
    while (gather_notifications(answers_)) {
    }
    reading_.reset();
    flush();
    co_await wait_for_other_readers(shared_.gateway, session_, wire_->executor(), wakes());
    add(*std::exchange(last_answer_, nullptr));
}

// Reads the notifications of the session that an operation has opened or resumed; stops after a disconnect.
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
    auto read = shared_.gateway.read(session_, client_->rights(), LinkKind::websocket, answer.last_sequence, *this);
    if (auto* reading = std::get_if<std::unique_ptr<Reading>>(&read)) reading_ = std::move(*reading);
}

// Waits until the peer has taken enough answers.
Task<> WebSocket::wait_for_room() {
    flush();
    while (full() && !broken_ && !close_gathered_) co_await something_written();
}

Task<> WebSocket::something_written() {
    room_ = std::make_shared<WakeUp>(wire_->executor(), wakes());
    co_await room_->wait_until(Steady::max());
    room_.reset();
}

void WebSocket::note_message() {
    if (wire_->received().empty() && !messages_.in_message()) {
        message_due_ = Steady::max();
    } else if (message_due_ == Steady::max()) {
        message_due_ = now() + shared_.settings().request_timeout;
    }
}

// Limits pings and pongs: an application needs only a few, and each ping costs an answer.
void WebSocket::note_control() {
    auto const present = now();
    if (present - controls_since_ >= std::chrono::seconds{1}) {
        controls_since_ = present;
        controls_ = 0;
    }
    if (++controls_ > shared_.settings().max_control_frames)
        close({CloseCode::policy_violation, "more control frames in a second than max_control_frames allows"});
}

void WebSocket::close(Ending ending) {
    if (ending_) return;
    if (ending.code != CloseCode::normal)
        spdlog::debug("a WebSocket closes with {}: {}", static_cast<int>(ending.code), ending.reason);
    ending_ = ending;
}

void WebSocket::taken_over() { close({CloseCode::policy_violation, "another WebSocket has taken over the session"}); }

void WebSocket::sweep(Steady at) {
    if (std::exchange(has_received_, false)) {
        received_at_ = at;
        pinged_ = false;
    }
    if (at >= close_due_ || at >= received_at_ + 2 * shared_.settings().ping_interval) {
        wire_->cut();
        return;
    }
    bool const late = at >= message_due_ && !ending_;
    bool const silent = at >= received_at_ + shared_.settings().ping_interval && !std::exchange(pinged_, true);
    bool const is_revoked = client_->principal && client_->principal->is_over();  // the ends of its commands may still come
    auto const longest = reading_ ? std::chrono::milliseconds{200} : shared_.settings().connect_timeout;
    session_due_ = reading_ && !is_revoked ? Steady::max() : std::min(session_due_, at + longest);
    bool const without_session = (at >= session_due_ || (is_revoked && !reading_)) && !ending_;
    if (late) close({CloseCode::policy_violation, "the message did not arrive within request_timeout"});
    if (without_session && is_revoked) close({CloseCode::policy_violation, "the token was revoked or changed, or has expired"});
    if (without_session) close({CloseCode::policy_violation, "no session was opened or resumed within connect_timeout"});
    bool const proof_due = at >= proof_due_ && reading_ && reading_->wants_signs_of_life(at);
    if (proof_due) proof_due_ = std::max(proof_due_ + proof_interval, at + proof_interval / 2);
    if (silent || proof_due) ping_due_ = true;
    if (late || ping_due_ || without_session) flush();
}

void WebSocket::shut_down() {
    close({CloseCode::going_away, "the gateway is shutting down"});
    flush();
}

// After an exception the connection ends: notifications that were taken from the session's queue are lost here. The client
// receives them when it resumes the session.
void WebSocket::flush() {
    try {
        write();
    } catch (...) {
        writing_ = false;
        break_off();
        throw;
    }
}

// The socket usually takes all bytes at once, so all WebSockets of a thread share one buffer.
void WebSocket::write() {
    thread_local std::string out;
    while (!writing_ && !broken_) {
        out.clear();
        bool const more = gather(out);
        if (out.empty()) return;
        auto const sent = wire_->send_now(out);
        if (sent < out.size()) return keep_unsent(std::string_view{out}.substr(sent));
        written();
        if (!more) return;
    }
}

// Keeps the bytes until the peer takes more. Cuts the connection instead while memory_budget is used up.
void WebSocket::keep_unsent(std::string_view rest) {
    auto& memory = shared_.gateway.memory();
    memory.took(rest.size());
    if (memory.full() && !wire_->is_secure()) {
        spdlog::warn("the WebSocket of {} was cut: {}", wire_->peer(),
                     memory.refuse("no memory for the data that the client does not read"));
        shared_.telemetry.cut();
        return break_off();
    }
    out_.assign(rest);
    writing_ = true;
    auto const self = std::static_pointer_cast<WebSocket>(shared_from_this());
    auto const drained = [self](std::exception_ptr const& broken) {
        if (!broken) return;
        self->writing_ = false;
        self->break_off();
    };
    asio::co_spawn(
        wire_->executor(), [self] { return self->drain(); }, drained);
}

// Appends the bytes of the next write. Returns whether more notifications follow.
bool WebSocket::gather(std::string& out) {
    if (close_gathered_) return false;
    if (!pending_.empty()) take_answers();
    out.append(answers_);
    answers_.clear();
    if (answers_.capacity() > most_kept) answers_.shrink_to_fit();
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
    if (out.empty() && session_over_) reading_.reset();
    return more;
}

// Appends some of the session's notifications. Returns whether more follow.
bool WebSocket::gather_notifications(std::string& out) {
    if (!reading_) return false;
    thread_local std::vector<Numbered> taken;
    taken.clear();  // an exception may have left some
    auto const then = reading_->take(most_at_once, taken);
    for (auto const& numbered : taken) {
        NotificationDocument const document{numbered};
        append_text_head(out, document.size());
        document.append_to(out);
    }
    shared_.telemetry.delivered(taken.size());
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
        close_due_ = now() + longest_closing;
    }
    if (room_) room_->raise();
}

// Writes the bytes that the socket did not take at once, then the ones that have been added since.
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
}

}  // namespace rois::net
