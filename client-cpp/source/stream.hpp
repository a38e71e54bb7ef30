// What waits behind an EventStream.
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <variant>

#include "flag.hpp"
#include "loop.hpp"
#include "types/messages.hpp"

namespace rois::detail {

// Lives on the client's thread, but for its end and `gaps`. Its owner keeps it as long as a coroutine waits for it.
class Stream {
public:
    explicit Stream(std::size_t most_waiting) : most_waiting_{most_waiting} {}

    void take(ReceiveEvent const& event) {
        if (told_) {
            told_(event);
            return;
        }
        if (events_ >= most_waiting_) drop_one();
        items_.emplace_back(event);
        ++events_;
        news.raise();
    }

    // Events were missed here.
    void take_gap() {
        if (told_) {
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

    void tell(std::function<void(ReceiveEvent const&)> told) {
        while (auto const event = next()) told(*event);
        told_ = std::move(told);
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

    client::Flag news;  // raised when an event waits, or none will come

private:
    struct Gap {};

    // The oldest event becomes a gap.
    void drop_one() {
        bool const gap = std::holds_alternative<Gap>(items_.front());
        if (gap) items_.pop_front();
        items_.front() = Gap{};
        --events_;
        if (items_.size() > 1 && std::holds_alternative<Gap>(items_[1])) items_.pop_front();
    }

    std::size_t const most_waiting_;
    std::deque<std::variant<ReceiveEvent, Gap>> items_;
    std::size_t events_ = 0;  // among these
    std::function<void(ReceiveEvent const&)> told_;
    std::atomic<std::uint64_t> gaps_ = 0;
    bool ended_ = false;
};

// A command that was accepted, and how it ended.
class Watch {
public:
    explicit Watch(CommandId named) : id{std::move(named)} {}

    CommandId const id;
    std::optional<CompletedStatus> status;  // on the client's thread
    std::string reason;                     // why this side ended it
    client::Flag completed;                 // raised when there is one

    // The engine has said how it ended, and knows the reason.
    void complete(CompletedStatus how) { end(how, {}); }

    // The session or the connection has ended, and the command with it. `why` is not empty.
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
