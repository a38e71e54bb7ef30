// The inside of a connection: its thread, its session, what is on the way. Facades and coroutines keep it alive.
#pragma once

#include <atomic>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "call.hpp"
#include "link.hpp"
#include "loop.hpp"
#include "rois/connection.hpp"
#include "stream.hpp"
#include "subscriptions.hpp"

namespace rois::detail {

// Lives on the client's thread; what is called from others says so. Sources: core.cpp (beginning, end, calls), core_session.cpp
// (link and session), core_life.cpp (signs of life), core_notifications.cpp, core_operations.cpp (what operations mean to it).
class Core final : public std::enable_shared_from_this<Core>, private client::Link::Listener {
public:
    Core(Settings, Observers);

    // From any thread:
    void start();
    void close();    // begins to
    void destroy();  // closes, waits for the end where it may; observers hear no more
    State state() const { return state_; }
    SessionId session() const;
    client::Loop& loop() { return loop_; }
    Settings const& settings() const { return settings_; }
    CommandId fresh_command_id();
    std::string fresh_request_id() { return "rois-cpp-" + std::to_string(++last_request_); }  // on the client's thread

    void spawn(Task<>);

    // A coroutine goes on on the client's thread, or where it is when that has ended: whoever would change something asks
    // is_closed() first. Throws nothing; all others await it first.
    auto here() { return loop_.here(); }

    // Sends it, now or when there is a session; its outcome is to be awaited.
    std::shared_ptr<client::Call> send(client::Call::Kind, std::string document, std::string request_id, client::Deadline);
    // A request with all that it means to the connection. Its id is given here.
    Task<Answer> request(Request, std::chrono::milliseconds deadline);

    Task<std::shared_ptr<Stream>> subscribe(Subscribe);  // throws Error
    void streams_changed();                              // from any thread: one may have lost its last handle

    // Executes a sequence, whose commands get ids, and watches them: one for each, in document order. Throws Error, which says
    // `what`.
    Task<std::vector<std::shared_ptr<Watch>>> begin(CommandUnitSequence, std::string what);

    // Raised when there is a session, and when the connection is closed.
    client::Flag opened;
    bool is_open() const { return phase_ == Phase::open; }
    // The application's own threads speak for it from now on (Connection::alive).
    void alive();
    std::chrono::milliseconds between_signs_of_life() const;

    bool is_closed() const { return phase_ == Phase::closing || phase_ == Phase::closed; }
    std::string const& last_reason() const { return last_reason_; }
    NoAnswer closed() const;  // what is said to whoever asks then

    // Waits so long, or until the connection closes.
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
    void give_up_misunderstood();
    std::shared_ptr<client::Call> take_largest();
    static void refuse_too_large(client::Call&, std::string const& reason);
    void leave_session();
    void open_session();
    void take_opening(xml::Heard);
    void session_gone();
    void restore();
    void take_restored(xml::Answered const&);
    void take_restored(Fault const&);
    void restored(std::string const& request_id, Outcome const&, Reply const*);
    void all_restored();
    void become_open();
    std::chrono::milliseconds pause();
    bool is_joined() const { return !settings_.session.empty(); }  // in the session of another program
    void send_on_link(client::Link::Document);

    // --- core.cpp ---
    void change(State, std::string reason = {});
    void watch_deadlines(client::Steady earliest);
    void end_late_calls();
    void take_answer(std::string_view document, std::optional<xml::Heard>&);
    void flush();
    enum class Farewell : std::uint8_t { due, said };  // the engine's session ends, too, or has ended
    void begin_close(Farewell);
    void finish();

    // --- core_life.cpp ---
    bool wants_signs_of_life() const;
    void expect_signs_of_life();
    void give_sign_of_life();
    Task<> prove_life();

    // --- core_notifications.cpp ---
    void take(xml::Told);
    void tell_held();
    void tell_first_held();
    void tell(xml::Told);
    void tell_gap(Gap const&);
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
    Task<> unsubscribe_unheard(SubscribeId);
    void note_bound(Identifier const&);
    void note_released(Identifier const&);
    void end_unheard();

    Settings const settings_;
    Observers const observers_;
    client::Target const target_;
    client::Loop loop_;
    std::atomic<State> state_ = State::connecting;
    std::atomic<bool> muted_ = false;  // observers hear no more
    std::atomic<std::uint64_t> last_command_ = 0;

    bool destroyed_ = false;
    std::uint32_t const name_;  // by chance

    // The session.
    Phase phase_ = Phase::resting;
    std::shared_ptr<client::Link> link_;
    mutable std::mutex session_mutex_;  // guards session_ for others; only this thread changes it
    SessionId session_;
    bool had_session_ = false;
    std::uint64_t last_sequence_ = 0;
    unsigned attempts_ = 0;  // in a row that have led to no session
    // Links in a row that failed, since one delivered an answer or a notification or lasted for longest_pause. A link with a
    // session leaves at most one, which stands for the attempt without a pause.
    unsigned failures_ = 0;
    client::Steady opened_at_;
    client::Loop::Ticket attempt_ = 0;
    std::string last_reason_;
    std::uint64_t dice_;
    std::vector<Identifier> bound_;
    client::Subscriptions subscriptions_;
    std::map<std::string, std::string> restoring_;  // request ids, and what is made anew
    std::optional<Gap> gap_;                        // to be told when all is restored

    // Signs of life.
    std::atomic<bool> spoken_for_ = false;  // by the application's own threads
    client::Steady pinged_at_;
    client::Steady said_at_;  // when a document went out last
    bool sent_raw_ = false;   // in this session: what it does is not known
    bool proving_ = false;    // a sign is on its way
    client::Loop::Ticket life_ = 0;

    std::vector<std::weak_ptr<client::Flag>> sleeping_;

    // What is on the way.
    xml::AnswerReader reader_;
    std::deque<std::shared_ptr<client::Call>> calls_;       // in the order in which they came
    client::Steady next_deadline_ = client::Steady::max();  // none of theirs is earlier
    client::Loop::Ticket deadlines_ = 0;
    std::atomic<std::uint64_t> last_request_ = 0;
    std::multimap<CommandId, std::shared_ptr<Watch>> watches_;  // one for each who waits, also of a name that is refused

    // While it is not known yet which events are whose, notifications wait.
    std::size_t subscribing_ = 0;
    std::deque<xml::Told> held_;
};

}  // namespace rois::detail
