// The connection to an engine: sends requests, hears notifications, and goes on where it was when the link breaks. The facades of
// client.hpp stand on it.
//
// Threads: each connection has one thread of its own, the client's thread. Its functions may be called from any thread;
// coroutines go on on the client's thread after they awaited one of its operations, and observers are called there. Who blocks
// there blocks the connection.
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

// connecting: there was no session yet. open: a session was opened. lost: the link is broken, it is tried to go on; calls wait.
// resumed: the same session goes on, nothing was missed that was not told as a gap. closed: for good.
enum class State : std::uint8_t { connecting, open, lost, resumed, closed };

std::string_view to_text(State);

struct StateChange {
    State state = State::connecting;
    std::string reason;  // why it was lost or closed
};

// Notifications were missed.
struct Gap {
    enum class Why : std::uint8_t {
        dropped,      // the engine dropped them, or keeps them no longer
        new_session,  // the session ended with the link; subscriptions and bindings were made anew, commands have ended with
                      // ABORT
    };
    Why why = Why::dropped;
    std::optional<std::uint64_t> count;  // nothing: not known
    // In a new session: what could not be made anew, as "bind navigation: the reason".
    std::vector<std::string> not_restored{};
};

// An attempt to open a session, or to resume one, failed. The connection keeps trying.
struct FailedAttempt {
    unsigned count = 0;  // failed attempts in a row, this one included
    std::string reason;
    std::chrono::milliseconds retry_in{};  // pause before the next attempt
};

// In which direction a document goes, seen from the application.
enum class Direction : std::uint8_t { out, in };

// Called on the client's thread, in the order of what happens, and not after the connection is destroyed. They must not throw.
struct Observers {
    std::function<void(StateChange const&)> state{};
    // Each failed attempt, at once. The last one, after which the connection closes, is reported as the state `closed` instead.
    std::function<void(FailedAttempt const&)> attempt_failed{};
    std::function<void(Gap const&)> gap{};
    // Each notification once. `lost` of the engine comes here, too, beside the gap.
    std::function<void(Notification const&, std::uint64_t sequence)> notification{};
    // Each document as it stands, also those that the connection sends and hears on its own.
    std::function<void(Direction, std::string_view document)> tap{};
};

// Owns a session and the link below it. Begins to connect when it is made.
//
// What is sent while the link breaks is sent again when the session goes on. An `execute` is never run twice: each command gets
// an id here unless it has one, and the engine is asked for it before the sequence is sent again. A `bind_any` that may have been
// answered is looked for among what is bound.
class Connection {
public:
    // Throws std::invalid_argument for a URL that is none.
    explicit Connection(Settings = {}, Observers = {});
    // Ends the session when the link is there, and waits until its thread has ended; what is awaited ends with NoAnswer::closed.
    // On the client's thread it does not wait.
    ~Connection();
    Connection(Connection const&) = delete;
    Connection& operator=(Connection const&) = delete;

    State state() const;        // closed as soon as calls fail; observers hear that last
    SessionId session() const;  // empty before the first one

    // Waits until there is a session, as long as `within` (the settings' connect_deadline when left out). What happened else is
    // the reason; nothing when it is open.
    Task<std::optional<NoAnswer>> opened(std::optional<std::chrono::milliseconds> within = {});

    // Sends an operation and awaits its answer. The request's own request_id is replaced on the way. `Resume` is refused: the
    // connection resumes by itself. The deadline is the settings' when left out.
    Task<Answer> request(Request, std::optional<std::chrono::milliseconds> deadline = {});

    // The same with the type of the operation: a fault and a missing answer become return codes (see Error::code), with the
    // reason.
    template <class Op>
    Task<typename Op::Reply> call(Op operation, std::optional<std::chrono::milliseconds> deadline = {});

    // Sends any document as it stands, once, and gives the document that answers it, whatever request_id it has.
    Task<std::variant<std::string, NoAnswer>> send(std::string document, std::optional<std::chrono::milliseconds> deadline = {});

    // Goes on after this time, or at once when the connection closes.
    Task<> sleep(std::chrono::milliseconds);

    // The application is alive. A robot that this session has set in motion stops within the motion lease (docs/safety.md) when
    // the application gives no more signs of life. A program that never calls `wait` lives on the client's thread and gives them
    // while that thread is not blocked. With the first `wait` or `alive`, its own threads speak for it: one that waits gives
    // signs as long as it waits, and each `wait` and `alive` is one. Threads that do something else for longer than half a lease
    // while a robot moves call this meanwhile. From any thread; costs little, and sends nothing while nothing moves.
    void alive();

    // How often `alive` is to be called at least: a fifth of the lease.
    std::chrono::milliseconds between_signs_of_life() const;

    // Ends the session, then the connection. What is awaited ends with NoAnswer::closed.
    void close();

    // Runs a coroutine on the client's thread. What it throws ends the program, as in a std::thread.
    void spawn(Task<>);

    // Runs a coroutine and waits for it: not on the client's thread, where it throws std::logic_error.
    template <class T>
    T wait(Task<T>);

protected:
    std::shared_ptr<detail::Core> const& core() const { return core_; }

private:
    void check_not_own_thread() const;

    std::shared_ptr<detail::Core> core_;
};

// A reply of this operation, whatever the answer was.
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
