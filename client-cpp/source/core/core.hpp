// The implementation of a connection: its thread, its session and the calls that wait for answers. Public handles and coroutines
// keep it alive.
#pragma once

#include <atomic>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "core/call.hpp"
#include "core/loop.hpp"
#include "core/stream.hpp"
#include "core/subscriptions.hpp"
#include "links/link.hpp"
#include "rois/connection.hpp"

namespace rois::detail {

// Used on the client's thread only, except where noted. Sources: core.cpp (start, end, calls), core_session.cpp (link and
// session), core_life.cpp (signs of life), core_notifications.cpp, core_operations.cpp (operations with side effects on the
// connection).
class Core final : public std::enable_shared_from_this<Core>, private client::Link::Listener {
public:
    Core(Settings, Observers);

    // From any thread:
    void start();
    void close();    // begins to close
    void destroy();  // closes, and waits for the end unless it is on the client's thread; no observer is called after this
    State state() const { return state_; }
    SessionId session() const;
    client::Loop& loop() { return loop_; }
    Settings const& settings() const { return settings_; }
    CommandId fresh_command_id();
    std::string fresh_request_id() { return "rois-cpp-" + std::to_string(++last_request_); }  // on the client's thread

    void spawn(Task<>);

    // All coroutines below await this first, to continue on the client's thread. If that thread has ended, they continue on their
    // own thread. They must check is_closed() before they change anything. Does not throw.
    auto here() { return loop_.here(); }

    // Sends a document, now or when a session is open. Await the call's outcome.
    std::shared_ptr<client::Call> send(client::Call::Kind, std::string document, std::string request_id, client::Deadline);
    // Sends a request with a new request_id, and updates the connection by its answer (bindings, subscriptions, commands).
    Task<Answer> request(Request, std::chrono::milliseconds deadline);

    Task<std::shared_ptr<Stream>> subscribe(Subscribe);  // throws Error
    void streams_changed();                              // from any thread: a stream may have lost its last handle

    // Runs a sequence and returns a Watch for each command, in document order. Fills in empty command ids. Throws Error, whose
    // text begins with `what`.
    Task<std::vector<std::shared_ptr<Watch>>> begin(CommandUnitSequence, std::string what);

    // Raised when a session is open, and when the connection is closed.
    client::Flag opened;
    bool is_open() const { return phase_ == Phase::open; }
    void alive();  // Connection::alive; from any thread
    std::chrono::milliseconds between_signs_of_life() const;

    bool is_closed() const { return phase_ == Phase::closing || phase_ == Phase::closed; }
    std::string const& last_reason() const { return last_reason_; }
    NoAnswer closed() const;  // the outcome of calls on a closed connection

    // Waits for this time, or until the connection closes.
    Task<> pass(std::chrono::milliseconds);

private:
    enum class Phase : std::uint8_t { resting, connecting, attaching, restoring, open, closing, closed };

    // --- core_session.cpp ---
    void attempt();
    void connected() override;
    void attached() override;
    void document(std::string_view) override;
    void failed(std::string const& reason, client::Failure) override;
    void pinged() override;
    void give_up_link(std::string const& reason, client::Failure);
    void give_up_misunderstood(std::string_view document);
    std::shared_ptr<client::Call> take_largest();
    static void refuse_too_large(client::Call&, std::string const& reason);
    void leave_session();
    void open_session();
    void take_opening(xml::EngineMessage);
    void session_gone();
    void restore();
    void take_restored(xml::Answered const&);
    void take_restored(Fault const&);
    void restored(std::string const& request_id, Outcome const&, Reply const*);
    void all_restored();
    void become_open();
    std::chrono::milliseconds pause();
    bool is_joined() const { return !settings_.session.empty(); }  // shares the session of another program
    void send_on_link(client::Link::Document);

    // --- core.cpp ---
    void change(State, std::string reason = {});
    void watch_deadlines(client::Steady earliest);
    void end_late_calls();
    void take_answer(std::string_view document, std::optional<xml::EngineMessage>&);
    void flush();
    enum class Farewell : std::uint8_t { due, said };  // whether `disconnect` is still to be sent
    void begin_close(Farewell);
    void finish();

    // --- core_life.cpp ---
    bool wants_signs_of_life() const;
    void expect_signs_of_life();
    void give_sign_of_life();
    Task<> prove_life();

    // --- core_notifications.cpp ---
    void take(xml::NumberedNotification);
    void deliver_held();
    void deliver_first_held();
    void deliver(xml::NumberedNotification);
    void report_gap(Gap const&);
    void complete(CommandId const&, CompletedStatus);

    // --- core_operations.cpp ---
    Task<Answer> plain(Request, std::chrono::milliseconds deadline);
    Task<Answer> execute(Execute, std::chrono::milliseconds deadline);
    void forget(std::vector<std::shared_ptr<Watch>> const&);
    Task<Answer> bind_any(BindAny, std::chrono::milliseconds deadline);
    Task<Answer> subscribe_by_request(Subscribe, std::chrono::milliseconds deadline);
    Task<Answer> unsubscribe(Unsubscribe, std::chrono::milliseconds deadline);
    Task<Answer> disconnect(std::chrono::milliseconds deadline);
    Task<Answer> subscribe_at_engine(Subscribe, std::chrono::milliseconds deadline);
    void end_subscribing();
    Task<> unsubscribe_unused(SubscribeId);
    void note_bound(Bind);
    void note_released(Identifier const&);
    void end_unused();

    Settings const settings_;
    Observers const observers_;
    client::Target const target_;
    client::Loop loop_;
    std::atomic<State> state_ = State::connecting;
    std::atomic<bool> muted_ = false;  // observers are not called any more
    std::atomic<std::uint64_t> last_command_ = 0;

    bool destroyed_ = false;
    std::uint32_t const name_;  // random

    // The session.
    Phase phase_ = Phase::resting;
    std::shared_ptr<client::Link> link_;
    mutable std::mutex
        session_mutex_;  // guards session_; the client's thread reads it without, because only that thread changes it
    SessionId session_;
    bool had_session_ = false;
    std::uint64_t last_sequence_ = 0;
    unsigned attempts_ = 0;  // failed attempts in a row
    // Failed links in a row. An answer, a notification or a link that lasted for longest_pause resets it to 0. Opening or
    // resuming a session limits it to 1, so that the next attempt has no pause.
    unsigned failures_ = 0;
    client::Steady opened_at_;
    client::Loop::Ticket attempt_ = 0;
    std::string last_reason_;
    std::uint64_t random_;
    std::vector<Bind> bound_;
    client::Subscriptions subscriptions_;
    std::map<std::string, std::string> restoring_;  // bindings and subscriptions that are being restored, by request id
    std::optional<Gap> gap_;                        // to report when all is restored

    // Signs of life.
    std::atomic<bool> application_gives_signs_ = false;  // the client's thread gives no signs of life any more
    client::Steady pinged_at_;
    client::Steady last_sent_at_;  // when the last document was sent
    bool sent_raw_ = false;        // a raw document was sent in this session; its effect is unknown
    bool proving_ = false;         // a sign is under way
    client::Loop::Ticket life_ = 0;

    std::vector<std::weak_ptr<client::Flag>> sleeping_;

    xml::AnswerReader reader_;

    // Calls and commands that are under way.
    std::deque<std::shared_ptr<client::Call>> calls_;       // in the order of sending
    client::Steady next_deadline_ = client::Steady::max();  // at or before the earliest deadline of calls_
    client::Loop::Ticket deadlines_ = 0;
    std::atomic<std::uint64_t> last_request_ = 0;
    std::multimap<CommandId, std::shared_ptr<Watch>> watches_;  // several may have one id: the engine accepts only one

    // Notifications wait in held_ while a subscribe_id is not known yet.
    std::size_t subscribing_ = 0;  // subscriptions under way
    std::deque<xml::NumberedNotification> held_;
};

// Sends an operation and returns its reply. Throws Error unless the return code is OK; its text begins with `what` and `whom`.
// `what` must have static lifetime.
template <class Op>
Task<typename Op::Reply> asked(std::shared_ptr<Core> core, Op operation, std::string_view what, std::string whom = {}) {
    Request request{std::move(operation), {}};
    auto answer = co_await core->request(std::move(request), core->settings().deadline);
    auto reply = reply_of<Op>(std::move(answer));
    if (reply.return_code != ReturnCode::ok) throw Error{reply.return_code, std::string{what} + whom + ": " + reply.reason};
    co_return std::move(reply);
}

}  // namespace rois::detail
