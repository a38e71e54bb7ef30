// The details of events and errors, kept until they expire, for the sessions that were notified (decisions 21, 24).
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "types/instant.hpp"
#include "types/profiles.hpp"
#include "types/text/to_number.hpp"
#include "types/values.hpp"

namespace rois {

// Gives numbered ids ("e-17") and keeps the details of each for `kept_for`. For that time again, remembers which sessions were
// notified: they get `expired`, all others `unknown`.
class Details {
public:
    // A session that asks for details. Slots are small numbers and are reused. A session does not know ids from before it
    // connected, even if an earlier session in its slot was notified.
    struct Asker {
        std::uint32_t slot = 0;
        std::uint64_t first = 0;  // next() when it connected
    };

    enum class Found : std::uint8_t { kept, expired, unknown };
    struct Answer {
        Found found;
        std::shared_ptr<Results const> results;         // when kept
        std::shared_ptr<MessageProfile const> message;  // the message that the results belong to
    };

    Details(std::string prefix, std::chrono::milliseconds kept_for) : prefix_{std::move(prefix)}, kept_for_{kept_for} {}

    std::chrono::milliseconds kept_for() const { return kept_for_; }
    // Also of the entries that are kept already.
    void keep_for(std::chrono::milliseconds time) {
        for (auto& entry : kept_) entry.until += time - kept_for_;
        kept_for_ = time;
    }

    // The number that the next id will have.
    std::uint64_t next() const { return first_ + kept_.size(); }

    // Lets the numbers continue from here, after a restart. The ids before it count as expired.
    void begin_with(std::uint64_t next) { first_ = next; }

    // Keeps the results of a message (an event; null for an error) under a new id. No session counts as notified yet.
    std::string add(std::shared_ptr<Results const> results, std::shared_ptr<MessageProfile const> message, Instant now) {
        kept_.push_back({now.steady + kept_for_, std::move(results), std::move(message), {}});
        return prefix_ + std::to_string(next() - 1);
    }

    // Records that the session in this slot was notified of the last entry.
    void add_receiver(std::uint32_t slot) {
        auto& receivers = kept_.back().receivers;
        if (slot >= receivers.size()) receivers.resize(slot + 1);
        receivers[slot] = true;
    }

    Answer find(std::string_view id, Asker asker, Instant now) {
        forget_expired(now);
        if (!id.starts_with(prefix_)) return {Found::unknown, {}, {}};
        id.remove_prefix(prefix_.size());
        auto const number = id.starts_with('0') ? std::nullopt : to_number<std::uint64_t>(id);
        if (!number || *number >= next() || *number < asker.first) return {Found::unknown, {}, {}};
        if (*number < first_) return {Found::expired, {}, {}};
        auto const& entry = kept_[*number - first_];
        if (asker.slot >= entry.receivers.size() || !entry.receivers[asker.slot]) return {Found::unknown, {}, {}};
        if (!entry.results) return {Found::expired, {}, {}};
        return {Found::kept, entry.results, entry.message};
    }

    // Returns whether no other session was notified. Requires that `find` returns the details for this session.
    bool is_only_receiver(std::string_view id, Asker asker) const {
        auto const number = to_number<std::uint64_t>(id.substr(prefix_.size())).value();
        auto const& receivers = kept_[number - first_].receivers;
        return receivers[asker.slot] && std::count(receivers.begin(), receivers.end(), true) == 1;
    }

    void forget_expired(Instant now) {
        while (expired_ < kept_.size() && kept_[expired_].until <= now.steady) expire();
        for (; !kept_.empty() && kept_.front().until + kept_for_ <= now.steady; ++first_, --expired_) kept_.pop_front();
    }

    // Expires the oldest entries until at most `most` are kept.
    void keep_last(std::size_t most) {
        while (kept_.size() - expired_ > most) expire();
    }

private:
    void expire() {
        auto& entry = kept_[expired_++];
        entry.results.reset();
        entry.message.reset();
    }

    struct Entry {
        Steady until;
        std::shared_ptr<Results const> results;  // null: expired
        std::shared_ptr<MessageProfile const> message;
        std::vector<bool> receivers;  // by slot: whether the session was notified
    };

    std::string prefix_;
    std::chrono::milliseconds kept_for_;
    std::deque<Entry> kept_;   // by number, beginning with first_
    std::uint64_t first_ = 1;  // the number of the first entry in kept_
    std::size_t expired_ = 0;  // number of expired entries, at the front of kept_
};

}  // namespace rois
