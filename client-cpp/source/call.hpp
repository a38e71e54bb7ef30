// One request on its way, and who waits for its answer.
#pragma once

#include <coroutine>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "loop.hpp"
#include "rois/error.hpp"
#include "xml/codec.hpp"

namespace rois::client {

// The link broke after the request was sent, and the same session has been resumed: whether it was done is not known.
struct Interrupted {};

// Until when there must be an answer, and how long that was in the beginning.
struct Deadline {
    Deadline(std::chrono::milliseconds time) : whole{bounded(time)} {}

    std::chrono::milliseconds left() const {
        auto const now = std::chrono::steady_clock::now();
        return bounded(std::chrono::duration_cast<std::chrono::milliseconds>(due - now));
    }

    std::chrono::milliseconds whole;
    Steady due = from_now(whole);
};

// Lives on the client's thread. Awaited once.
class Call {
public:
    enum class Kind : std::uint8_t {
        again,       // sent again when the link breaks: doing it twice is as good as once
        in_session,  // the same, in its session alone: it names what only this session knows
        once,        // not sent again: who waits hears of it
        raw,         // a document as it stands
    };
    using Outcome = std::variant<Answer, std::string, Interrupted>;  // a text for a raw one

    Call(Kind how, std::string document, std::string request_id, Deadline within)
        : kind{how}, text{std::move(document)}, id{std::move(request_id)}, deadline{within} {}

    Call(Call const&) = delete;
    Call& operator=(Call const&) = delete;

    // What the outcome is made of. Who waits goes on.
    template <class... Parts>
    void give(Parts&&... parts) {
        outcome_.emplace(std::forward<Parts>(parts)...);
        if (auto const waiter = std::exchange(waiter_, {})) waiter.resume();
    }

    // Whether it was given an outcome. One whose deadline has passed stays in the row until its answer comes.
    bool is_over() const { return outcome_.has_value(); }

    struct Awaiter {
        Call* call;
        bool await_ready() const { return call->is_over(); }
        void await_suspend(std::coroutine_handle<> waiter) const { call->waiter_ = waiter; }
        Outcome& await_resume() const { return *call->outcome_; }
    };
    Awaiter outcome() { return {this}; }  // stays here

    Kind const kind;
    std::string const text;
    std::string const id;  // empty for a raw one
    Deadline const deadline;
    bool sent = false;  // on this link

private:
    std::optional<Outcome> outcome_;
    std::coroutine_handle<> waiter_;
};

}  // namespace rois::client
