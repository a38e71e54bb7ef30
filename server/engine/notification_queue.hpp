// What an engine has to tell one session: numbered, bounded, readable again for a while (decisions 22, 23).
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "types/ids.hpp"
#include "types/messages.hpp"

namespace rois {

// A notification on its way to one or many sessions. But for its sequence its text is the same for all of them; it is made
// once, by whoever writes it first, on any thread.
class OutgoingNotification {
public:
    explicit OutgoingNotification(Notification n) : body{std::move(n)} {}

    Notification const body;

    template <class Encode>  // std::string(Notification const&)
    std::string const& text(Encode encode) const {
        std::call_once(once_, [&] { text_ = encode(body); });
        return text_;
    }

private:
    mutable std::once_flag once_;
    mutable std::string text_;
};

// One entry of a session's history.
struct Numbered {
    std::uint64_t sequence = 0;
    std::shared_ptr<OutgoingNotification const> notification;
};

// Those who read a session's notifications, as the outbox knows them.
struct Audience;

// Holds the notifications of a session: those that wait (never read) and those that were read, for reading them again. Any number
// of readers, each with its own position; reading discards nothing but marks as sent. Only the engine pushes and closes, and asks
// what it has done; readers and holders come from any thread, and wait for nothing but each other: not for the engine's turn.
class NotificationQueue {
public:
    NotificationQueue(SessionId session, std::size_t max_waiting, std::size_t max_sent)
        : max_waiting_{max_waiting}, max_sent_{max_sent}, session_{std::move(session)} {}

    SessionId const& session() const { return session_; }

    enum class Pushed : std::uint8_t { ok, overflow };

    // Numbers and keeps it. When too many wait, the oldest waiting event makes room and a `Lost` takes its place; `overflow`
    // when there is no event to drop: then the session must end. From then on it keeps what must not be lost, and no event.
    Pushed push(std::shared_ptr<OutgoingNotification const>);

    // Drops the sent notifications, and the oldest waiting events until only `events` are left. `Lost` replaces the latter.
    void keep_last(std::size_t events);

    // No more will come: the session has ended. As what is told, it shows when nothing is held.
    void close();

    std::uint64_t last_sequence() const { return last_sequence_; }

    // How many were dropped so far.
    std::uint64_t lost() const { return lost_; }

    // How many nobody has read.
    std::size_t waiting() const;

    // Whether the session had to end because too many waited.
    bool overflowed() const { return overflowed_; }

    // What comes behind a position: ended: nothing, ever; overflowed: as well, because too many waited.
    enum class Next : std::uint8_t { more, wait, ended, overflowed };
    Next next(std::uint64_t after) const;

    // At most `most` visible entries with a sequence above `after`, oldest first, which count as sent from now on. A position
    // that is older than what is kept begins with a `Lost`. They are appended to `into`; what is said is what comes behind them.
    Next read(std::uint64_t after, std::size_t most, std::vector<Numbered>& into);
    std::vector<Numbered> read(std::uint64_t after, std::size_t most);
    bool has_after(std::uint64_t after) const { return next(after) == Next::more; }

    // While held, what is pushed from now on stays invisible: an answer that must come first is still on its way (decision 22).
    // Holds may overlap; each is released once.
    using Hold = std::uint64_t;  // the sequence behind which it hides
    Hold hold();
    // Whether it has hidden something.
    bool release(Hold);

    bool closed() const;

    // Until then the engine wants signs of life from the application (decision 33), so WebSockets send pings.
    void want_signs_of_life(Steady until) { signs_of_life_until_.store(until, std::memory_order_relaxed); }
    bool wants_signs_of_life(Steady now) const { return now < signs_of_life_until_.load(std::memory_order_relaxed); }

    // For the outbox, which finds them here without a search; guarded as the engine is.
    std::shared_ptr<Audience> const& audience() const { return audience_; }
    void set_audience(std::shared_ptr<Audience> audience) { audience_ = std::move(audience); }

private:
    std::uint64_t visible_until() const { return holds_.empty() ? last_sequence_ : holds_.front(); }
    bool make_room();
    bool shows_closed() const { return closed_ && holds_.empty(); }
    bool is_recent(std::uint64_t after) const { return recent_count_ > 0 && after + 1 >= recent_.front().sequence; }
    Next read_recent(std::uint64_t after, std::size_t most, std::vector<Numbered>& into);
    void settle_recent();
    std::vector<Numbered>::const_iterator first_after(std::uint64_t sequence) const;
    std::uint64_t sequence_after(std::uint64_t sequence) const;
    Next after_locked(std::uint64_t sequence) const;
    Numbered const& at(std::size_t place) const;
    void mark_sent(std::uint64_t until);
    void forget();

    // In the order of use: an event to a thousand sessions finds each of them far away in memory.
    std::shared_ptr<Audience> audience_;
    mutable std::mutex mutex_;  // guards what follows; what only the engine changes it may read without
    // In the order of their sequence; a `Lost` stands for several; first those that were forgotten, then those that were sent.
    // Nothing is allocated for a session that has heard nothing. The last ones are kept in the queue itself, without a `Lost` and
    // without gaps, until they are too many: what was allocated is on another page of memory, for each session on its own.
    std::vector<Numbered> entries_;
    std::size_t forgotten_ = 0;  // how many were forgotten and are still there
    std::size_t sent_ = 0;       // how many were forgotten or sent, of all
    std::size_t recent_count_ = 0;
    std::array<Numbered, 8> recent_;
    std::size_t waiting_ = 0;          // the others, without `Lost`
    std::uint64_t last_sequence_ = 0;  // given last
    std::uint64_t lost_ = 0;
    std::vector<Hold> holds_;  // ascending, since sequences are
    bool closed_ = false;
    bool overflowed_ = false;

    std::atomic<Steady> signs_of_life_until_{Steady::min()};

    std::size_t max_waiting_;  // what follows never changes
    std::size_t max_sent_;
    SessionId session_;
};

}  // namespace rois
