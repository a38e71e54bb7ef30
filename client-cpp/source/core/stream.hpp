// The queue of an EventStream, and the state of a command.
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <optional>
#include <variant>

#include "core/flag.hpp"
#include "core/loop.hpp"
#include "types/messages.hpp"

namespace rois::detail {

// Used on the client's thread only, except the destructor and `gaps`. A coroutine that awaits `news` must keep the stream alive.
class Stream {
public:
    explicit Stream(std::size_t most_waiting) : most_waiting_{most_waiting} {}

    void take(ReceiveEvent const& event) {
        if (handler_) {
            handler_(event);
            return;
        }
        if (events_ >= most_waiting_) drop_one();
        items_.emplace_back(event);
        ++events_;
        news.raise();
    }

    // Notes that events were missed at this place.
    void take_gap() {
        if (handler_) {
            ++gaps_;
        } else if (items_.empty() || !std::holds_alternative<Gap>(items_.back())) {
            items_.emplace_back(Gap{});
        }
    }

    std::optional<ReceiveEvent> next() {
        std::optional<ReceiveEvent> event;
        while (!event && !items_.empty()) {
            if (auto* const waiting = std::get_if<ReceiveEvent>(&items_.front())) {
                event = std::move(*waiting);
                --events_;
            } else {
                ++gaps_;
            }
            items_.pop_front();
        }
        return event;
    }

    void deliver_to(std::function<void(ReceiveEvent const&)> handler) {
        while (auto const event = next()) handler(*event);
        handler_ = std::move(handler);
    }

    void skip() {
        while (next()) {
        }
    }

    void end() {
        ended_ = true;
        news.raise();
    }
    bool ended() const { return ended_; }

    std::uint64_t gaps() const { return gaps_; }

    client::Flag news;  // raised when an event waits, and when the stream has ended

private:
    struct Gap {};

    // Replaces the oldest event by a gap.
    void drop_one() {
        bool const gap = std::holds_alternative<Gap>(items_.front());
        if (gap) items_.pop_front();
        items_.front() = Gap{};
        --events_;
        if (items_.size() > 1 && std::holds_alternative<Gap>(items_[1])) items_.pop_front();
    }

    std::size_t const most_waiting_;
    std::deque<std::variant<ReceiveEvent, Gap>> items_;
    std::size_t events_ = 0;  // number of events in items_
    std::function<void(ReceiveEvent const&)> handler_;
    std::atomic<std::uint64_t> gaps_ = 0;
    bool ended_ = false;
};

// The end of a command, for the coroutines that await it. Used on the client's thread only.
class Watch {
public:
    explicit Watch(CommandId named) : id{std::move(named)} {}

    CommandId const id;
    std::optional<CompletedStatus> status;
    std::string reason;      // why `abort` was called; empty if the engine has reported the end
    client::Flag completed;  // raised when `status` is set

    // The engine has reported the end of the command. The reason can be requested from the engine.
    void complete(CompletedStatus how) { end(how, {}); }

    // The session or the connection has ended before the command. `why` is not empty.
    void abort(std::string why) { end(CompletedStatus::abort, std::move(why)); }

private:
    void end(CompletedStatus how, std::string why) {
        if (status) return;
        status = how;
        reason = std::move(why);
        completed.raise();
    }
};

}  // namespace rois::detail
