// Details of events and errors, kept until they expire, for the sessions that were told of them (decisions 21, 24).
#pragma once

#include <charconv>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "types/instant.hpp"
#include "types/profiles.hpp"
#include "types/values.hpp"

namespace rois {

// Gives numbered ids ("e-17") and keeps what they stand for, all for the same time. For as long again it knows who was told, so
// that it says of what has expired that it has, and only to them.
class Details {
public:
    // A session, as far as it may ask for details. Slots are small numbers and are used again: so an id that was given before the
    // session connected is unknown to it, whoever had its slot then.
    struct Asker {
        std::uint32_t slot = 0;
        std::uint64_t first = 0;  // what next() was when it connected
    };

    enum class Found : std::uint8_t { kept, expired, unknown };
    struct Answer {
        Found found;
        std::shared_ptr<Results const> results;         // when kept
        std::shared_ptr<MessageProfile const> message;  // to which they belong
    };

    Details(std::string prefix, std::chrono::milliseconds kept_for) : prefix_{std::move(prefix)}, kept_for_{kept_for} {}

    std::chrono::milliseconds kept_for() const { return kept_for_; }

    // The number of the next id.
    std::uint64_t next() const { return first_ + kept_.size(); }

    // Keeps the results of a message (an event; null for an error) under a new id. Nobody was told yet.
    std::string add(std::shared_ptr<Results const> results, std::shared_ptr<MessageProfile const> message, Instant now) {
        kept_.push_back({now.steady + kept_for_, std::move(results), std::move(message), {}});
        return prefix_ + std::to_string(next() - 1);
    }

    // The session in this slot is told of what was added last.
    void tell(std::uint32_t slot) {
        auto& told = kept_.back().told;
        if (slot >= told.size()) told.resize(slot + 1);
        told[slot] = true;
    }

    Answer find(std::string_view id, Asker asker, Instant now) {
        forget_expired(now);
        std::uint64_t number = 0;
        if (!id.starts_with(prefix_)) return {Found::unknown, {}, {}};
        id.remove_prefix(prefix_.size());
        auto const [end, problem] = std::from_chars(id.data(), id.data() + id.size(), number);
        bool const whole = problem == std::errc{} && end == id.data() + id.size() && !id.starts_with('0');
        if (!whole || number >= next() || number < asker.first) return {Found::unknown, {}, {}};
        if (number < first_) return {Found::expired, {}, {}};
        auto const& entry = kept_[number - first_];
        if (asker.slot >= entry.told.size() || !entry.told[asker.slot]) return {Found::unknown, {}, {}};
        if (!entry.results) return {Found::expired, {}, {}};
        return {Found::kept, entry.results, entry.message};
    }

    void forget_expired(Instant now) {
        while (expired_ < kept_.size() && kept_[expired_].until <= now.steady) expire();
        for (; !kept_.empty() && kept_.front().until + kept_for_ <= now.steady; ++first_, --expired_) kept_.pop_front();
    }

    // All but the last ones have expired.
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
        std::vector<bool> told;  // by slot
    };

    std::string prefix_;
    std::chrono::milliseconds kept_for_;
    std::deque<Entry> kept_;   // by number, from first_
    std::uint64_t first_ = 1;  // the number of the first that is kept
    std::size_t expired_ = 0;  // of these, from the first
};

}  // namespace rois
