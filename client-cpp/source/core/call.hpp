// A request that is under way, and the coroutine that awaits its answer.
#pragma once

#include <coroutine>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "core/loop.hpp"
#include "rois/error.hpp"
#include "xml/codec/codec.hpp"

namespace rois::client {

// The link broke after the request was sent, and the session was resumed: the engine may or may not have performed the
// operation.
struct Interrupted {};

// The deadline of a call: its length and its end.
struct Deadline {
    Deadline(std::chrono::milliseconds time) : whole{bounded(time)} {}

    std::chrono::milliseconds left() const {
        auto const now = std::chrono::steady_clock::now();
        return bounded(std::chrono::duration_cast<std::chrono::milliseconds>(due - now));
    }

    std::chrono::milliseconds whole;
    Steady due = from_now(whole);
};

// Used on the client's thread only. The outcome can be awaited once.
class Call {
public:
    enum class Kind : std::uint8_t {
        again,       // idempotent: sent again after the link broke
        in_session,  // sent again only in the same session, whose ids it contains
        once,        // not sent again: the outcome is Interrupted
        raw,         // any text; not sent again: the outcome is NoAnswer::link_lost
    };
    using Outcome = std::variant<Answer, std::string, Interrupted>;  // a text for `raw`

    Call(Kind how, std::string document, std::string request_id, Deadline within)
        : kind{how}, text{std::move(document)}, id{std::move(request_id)}, deadline{within} {}

    Call(Call const&) = delete;
    Call& operator=(Call const&) = delete;

    // Sets the outcome, constructed from these arguments, and resumes the waiting coroutine.
    template <class... Parts>
    void give(Parts&&... parts) {
        outcome_.emplace(std::forward<Parts>(parts)...);
        if (auto const waiter = std::exchange(waiter_, {})) waiter.resume();
    }

    // Whether the call has an outcome. A call whose deadline has passed stays in the queue until its answer arrives.
    bool is_over() const { return outcome_.has_value(); }

    struct Awaiter {
        Call* call;
        bool await_ready() const { return call->is_over(); }
        void await_suspend(std::coroutine_handle<> waiter) const { call->waiter_ = waiter; }
        Outcome& await_resume() const { return *call->outcome_; }
    };
    Awaiter outcome() { return {this}; }  // returns a reference; the call owns the outcome

    Kind const kind;
    std::string const text;
    std::string const id;  // empty for `raw`
    Deadline const deadline;
    bool sent = false;  // on this link

private:
    std::optional<Outcome> outcome_;
    std::coroutine_handle<> waiter_;
};

}  // namespace rois::client
