// Details of events and errors, kept until they expire (decisions 21, 24).
#pragma once

#include <charconv>
#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>

#include "types/instant.hpp"
#include "types/profiles.hpp"
#include "types/values.hpp"

namespace rois {

// Gives numbered ids ("e-17") and keeps what they stand for, all for the same time.
class Details {
public:
    enum class Found : std::uint8_t { kept, expired, unknown };
    struct Answer {
        Found found;
        std::shared_ptr<Results const> results;         // when kept
        std::shared_ptr<MessageProfile const> message;  // to which they belong
    };

    Details(std::string prefix, std::chrono::milliseconds kept_for) : prefix_{std::move(prefix)}, kept_for_{kept_for} {}

    std::chrono::milliseconds kept_for() const { return kept_for_; }

    // Keeps the results of a message (an event; null for an error) under a new id.
    std::string add(std::shared_ptr<Results const> results, std::shared_ptr<MessageProfile const> message, Instant now) {
        kept_.push_back({now.steady + kept_for_, std::move(results), std::move(message)});
        return prefix_ + std::to_string(first_ + kept_.size() - 1);
    }

    Answer find(std::string_view id, Instant now) {
        forget_expired(now);
        std::uint64_t number = 0;
        if (!id.starts_with(prefix_)) return {Found::unknown, {}, {}};
        id.remove_prefix(prefix_.size());
        auto const [end, problem] = std::from_chars(id.data(), id.data() + id.size(), number);
        bool const whole = problem == std::errc{} && end == id.data() + id.size() && !id.starts_with('0');
        if (!whole || number >= first_ + kept_.size()) return {Found::unknown, {}, {}};
        if (number < first_) return {Found::expired, {}, {}};
        return {Found::kept, kept_[number - first_].results, kept_[number - first_].message};
    }

    void forget_expired(Instant now) {
        for (; !kept_.empty() && kept_.front().until <= now.steady; ++first_) kept_.pop_front();
    }

private:
    struct Entry {
        Steady until;
        std::shared_ptr<Results const> results;
        std::shared_ptr<MessageProfile const> message;
    };

    std::string prefix_;
    std::chrono::milliseconds kept_for_;
    std::deque<Entry> kept_;   // by number, from first_
    std::uint64_t first_ = 1;  // the number of the first that is kept
};

}  // namespace rois
