// How much matching conditions costs, counted in steps, so that no session takes the engine's time from the others.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>

#include "types/instant.hpp"

namespace rois {

// Thrown when the conditions of a session have needed too many steps.
class TooMuchEffort final : public std::exception {};

// A step takes some nanoseconds: it looks at a character of a value, for instance. The engine has a number of steps for each
// tenth of a second. When they are used up, a session that has used more than its share of them gets no more in that tenth; the
// others still do. Not thread-safe.
class Effort {
public:
    static constexpr std::chrono::milliseconds window{100};

    // The steps that a session has used.
    struct Account {
        std::uint64_t window = 0;  // the last one in which it used some
        std::size_t used = 0;      // in that window
    };

    explicit Effort(std::size_t steps_per_second) { limit(steps_per_second); }

    void limit(std::size_t steps_per_second) { most_ = steps_per_second * window / std::chrono::seconds{1}; }

    // Whether the session may use more. `sessions`: those that share the steps.
    bool has_left(Account&, std::size_t sessions, Steady now);

    // The session uses these steps. False: it may not use more.
    bool take(Account&, std::size_t sessions, Steady now, std::size_t steps);

    // While it exists, the session pays for the steps of this thread. Turns may be nested.
    class Turn {
    public:
        Turn(Effort&, Account& payer, std::size_t sessions, Steady now);
        ~Turn() { present_ = outer_; }
        Turn(Turn const&) = delete;
        Turn& operator=(Turn const&) = delete;

    private:
        friend class Effort;
        Effort& of_;
        Account& payer_;
        std::size_t const share_;
        Turn* const outer_;
    };

    // Counts steps of the present turn, if there is one. Throws TooMuchEffort.
    static void spend(std::size_t steps);

    std::uint64_t refusals() const { return refusals_; }
    void count_refusal() { ++refusals_; }

private:
    void begin_window(Account&, Steady now);
    std::size_t share(std::size_t sessions) const { return most_ / std::max<std::size_t>(sessions, 1); }
    bool is_used_up(Account const& payer, std::size_t share) const { return used_ > most_ && payer.used > share; }

    static thread_local Turn* present_;

    std::size_t most_ = 0;  // in a window
    std::size_t used_ = 0;  // in this window
    std::uint64_t window_ = 1;
    Steady begun_{};  // this window
    std::uint64_t refusals_ = 0;
};

}  // namespace rois
