// The connection to an engine: sends requests, receives notifications, and resumes its session after the link broke. Client
// (client.hpp) adds a function for each operation.
//
// Threads: each connection has one thread of its own, the client's thread. Any thread may call the functions. Coroutines continue
// on the client's thread after they awaited an operation, and observers are called there. Code that blocks there blocks the
// connection.
#pragma once

#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "rois/error.hpp"
#include "rois/settings.hpp"
#include "rois/task.hpp"
#include "types/messages.hpp"

namespace rois {

namespace detail {
class Core;  // NOLINT(cppcoreguidelines-virtual-class-destructor): it is final
}

enum class State : std::uint8_t {
    connecting,  // no session yet
    open,        // a session was opened
    lost,        // the link is broken; the connection retries, and calls wait
    resumed,     // the same session continues; missed notifications were reported as a gap
    closed,      // for good
};

std::string_view to_text(State);

struct StateChange {
    State state = State::connecting;
    std::string reason;  // why the link is lost or the connection closed
};

// Notifications were missed.
struct Gap {
    enum class Why : std::uint8_t {
        dropped,      // the engine dropped them, or no longer keeps them
        new_session,  // the session ended with the link; the connection opened another one, subscribed and bound again, and
                      // ended the commands with ABORT
    };
    Why why = Why::dropped;
    std::optional<std::uint64_t> count;  // how many; empty: unknown
    // In a new session: failed bindings and subscriptions, as "bind navigation: the reason".
    std::vector<std::string> not_restored{};
};

// A failed attempt to open or resume a session. The connection then retries.
struct FailedAttempt {
    unsigned count = 0;  // failed attempts in a row, this one included
    std::string reason;
    std::chrono::milliseconds retry_in{};  // pause before the next attempt
};

// The direction of a document, seen from the application.
enum class Direction : std::uint8_t { out, in };

// Called on the client's thread, in order, and never after the connection is destroyed. They must not throw.
struct Observers {
    std::function<void(StateChange const&)> state{};
    // Called for each failed attempt. If the connection closes after an attempt, that attempt is reported as the state `closed`
    // instead.
    std::function<void(FailedAttempt const&)> attempt_failed{};
    std::function<void(Gap const&)> gap{};
    // Called once for each notification. The engine's `lost` is reported here and as a gap.
    std::function<void(Notification const&, std::uint64_t sequence)> notification{};
    // Called for each document sent or received, byte for byte, also for the documents that the connection itself sends.
    std::function<void(Direction, std::string_view document)> tap{};
};

// Owns a session and its link. The constructor begins to connect.
//
// After a broken link, the connection resumes the session and repeats the requests that have no answer. An `execute` never runs
// twice: each command has an id (given here if it is empty), and the engine accepts an id only once in a session. After a
// `bind_any` without an answer, the connection looks for a component that the session has bound meanwhile.
class Connection {
public:
    // Throws std::invalid_argument if the URL is invalid.
    explicit Connection(Settings = {}, Observers = {});
    // Ends the session if the link works, and waits until the client's thread has ended (not if it is called on that thread).
    // Operations that are under way end with NoAnswer::closed.
    ~Connection();
    Connection(Connection const&) = delete;
    Connection& operator=(Connection const&) = delete;

    State state() const;        // `closed` as soon as calls fail; the observers are notified last
    SessionId session() const;  // empty before the first session

    // Waits until a session is open, for `within` at most (default: Settings::connect_deadline). Returns nothing if it is open,
    // else the reason.
    Task<std::optional<NoAnswer>> opened(std::optional<std::chrono::milliseconds> within = {});

    // Sends an operation and returns the answer. Replaces the request_id. Rejects `Resume`: the connection resumes by itself.
    // Default deadline: Settings::deadline.
    Task<Answer> request(Request, std::optional<std::chrono::milliseconds> deadline = {});

    // Sends an operation and returns its reply. A fault or a missing answer becomes a return code (see Error::code) and a reason.
    template <class Op>
    Task<typename Op::Reply> call(Op operation, std::optional<std::chrono::milliseconds> deadline = {});

    // Sends any text once, unchanged, and returns the document that answers it, whatever its request_id.
    Task<std::variant<std::string, NoAnswer>> send(std::string document, std::optional<std::chrono::milliseconds> deadline = {});

    // Waits for this time, or until the connection closes.
    Task<> sleep(std::chrono::milliseconds);

    // Gives a sign of life. A robot that this session has set in motion stops if the application gives no sign of life for the
    // motion lease (docs/safety.md). Until the first call of `wait` or `alive`, the client's thread gives the signs itself, while
    // it is not blocked. From then on only `wait` and `alive` count: `wait` gives signs as long as it waits. A program that
    // neither waits nor calls operations for longer than half a lease while a robot moves must call `alive`. From any thread;
    // costs little, and sends nothing while nothing moves.
    void alive();

    // The longest time between two calls of `alive`: a fifth of the lease.
    std::chrono::milliseconds between_signs_of_life() const;

    // Ends the session, then the connection. Operations that are under way end with NoAnswer::closed.
    void close();

    // Runs a coroutine on the client's thread. An exception that leaves the coroutine ends the program, as in a std::thread.
    void spawn(Task<>);

    // Runs a coroutine on the client's thread, and waits for it. Throws std::logic_error if it is called on that thread.
    template <class T>
    T wait(Task<T>);

protected:
    std::shared_ptr<detail::Core> const& core() const { return core_; }

private:
    void check_not_own_thread() const;

    std::shared_ptr<detail::Core> core_;
};

// Returns the answer as a reply of this operation: a fault or a missing answer becomes a return code and a reason.
template <class Op>
typename Op::Reply reply_of(Answer&& answer) {
    using R = typename Op::Reply;
    if (auto* const reply = std::get_if<Reply>(&answer)) {
        if (auto* const expected = std::get_if<R>(reply)) return std::move(*expected);
        R other;
        other.return_code = ReturnCode::error;
        other.reason = "the answer is that of another operation";
        return other;
    }
    R failed;
    failed.return_code = ReturnCode::error;
    if (auto const* const fault = std::get_if<Fault>(&answer)) {
        failed.reason = std::string{to_text(fault->code)} + ": " + fault->reason;
    } else {
        auto const& none = std::get<NoAnswer>(answer);
        if (none.why == NoAnswer::Why::deadline) failed.return_code = ReturnCode::timeout;
        failed.reason = none.reason;
    }
    return failed;
}

template <class Op>
Task<typename Op::Reply> Connection::call(Op operation, std::optional<std::chrono::milliseconds> deadline) {
    Request asked{std::move(operation), {}};
    auto answer = co_await request(std::move(asked), deadline);
    co_return reply_of<Op>(std::move(answer));
}

namespace detail {

template <class T>
Task<> deliver(Task<T> task, std::promise<T>& promise) {
    try {
        if constexpr (std::is_void_v<T>) {
            co_await task;
            promise.set_value();
        } else {
            auto value = co_await task;
            promise.set_value(std::move(value));
        }
    } catch (...) {
        promise.set_exception(std::current_exception());
    }
}

}  // namespace detail

template <class T>
T Connection::wait(Task<T> task) {
    check_not_own_thread();
    std::promise<T> promise;
    auto given = promise.get_future();
    spawn(detail::deliver(std::move(task), promise));
    do alive();
    while (given.wait_for(between_signs_of_life()) == std::future_status::timeout);
    return given.get();
}

}  // namespace rois
