// The notifications of one session: numbered, bounded, and readable again for a while (decisions 22, 23).
#pragma once

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "types/ids.hpp"
#include "types/messages.hpp"

namespace rois {

// A notification for one or many sessions. Its text is the same for all of them, except the sequence. The first thread that needs
// the text makes it.
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

// An entry of a session's queue.
struct Numbered {
    std::uint64_t sequence = 0;
    std::shared_ptr<OutgoingNotification const> notification;
};

// Holds a session's notifications: those that are waiting (never read), and those that were sent (read once), for reading again.
// Any number of readers, each with its own position. Reading marks notifications as sent.
//
// `session`, `last_sequence`, `read`, `next`, `release`, `delay`, `resume`, `closed`, `waiting` and `wants_signs_of_life` are
// thread-safe: the queue's own mutex guards them, so readers never wait for a call to the engine. All other functions need the
// lock that serializes the calls to the engine.
class NotificationQueue {
public:
    NotificationQueue(SessionId session, std::size_t max_waiting, std::size_t max_sent)
        : max_waiting_{max_waiting}, max_sent_{max_sent}, session_{std::move(session)} {}

    SessionId const& session() const { return session_; }

    // The number of an answer that must be sent before the notifications that its operation causes (decision 22). 0: none.
    using Hold = std::uint64_t;

    // `behind`: a visible notification waits before it, so the readers need not be woken again. `held`: the notification is
    // numbered and visible when its hold is released. `overflow`, `dropped`: too many wait, so the session must end.
    enum class Pushed : std::uint8_t { first, behind, held, overflow, dropped };

    // Whether a notification whose cause is released, or that has none, waits for the current hold. `unless_delayed`: what
    // happens beside an operation, and was perhaps caused by it. It must not wait long, because what happens later does not wait.
    enum class ForCurrent : std::uint8_t { waits, unless_delayed, does_not_wait };

    // Numbers and stores the notification, or holds it if `cause`, or else the current hold, is not released yet, or if it would
    // overtake a held one whose answer is being sent (decision 22: notifications are numbered as things happen). If too many
    // wait, replaces the oldest waiting event by a `Lost`. If there is no event to replace, the queue overflows, and events are
    // dropped from then on. A `Lost` of 1 says that an event has perhaps been missed; it never waits for room.
    Pushed push(std::shared_ptr<OutgoingNotification const>, Hold cause = 0, ForCurrent = ForCurrent::waits);

    // Drops the sent notifications. Replaces the oldest waiting events by `Lost` until `events` are left.
    void keep_last(std::size_t events);

    // Marks the end: the session has ended. Holds hide the end, too.
    void close();

    std::uint64_t last_sequence() const;

    // The number of notifications that were dropped.
    std::uint64_t lost() const { return lost_; }

    // The number of notifications that were never read.
    std::size_t waiting() const;
    bool is_full() const { return waiting() >= max_waiting_; }

    // Another engine has restarted. It reads from the beginning, but passes no events on. So the events that are unread now stay
    // unread for `unread_events`, until a later notification is read.
    void keep_unread();

    // Returns the events that were never read.
    std::vector<std::shared_ptr<OutgoingNotification const>> unread_events() const;

    // Returns whether the session had to end because too many notifications waited.
    bool overflowed() const { return overflowed_; }

    // The state after a position. `ended`, `overflowed`: no more will come; `overflowed`: because too many waited.
    enum class Next : std::uint8_t { more, wait, ended, overflowed };
    Next next(std::uint64_t after) const;

    // Appends up to `most` visible entries after `after`, and marks them as sent. Begins with a `Lost` if entries were dropped
    // there. Returns the state after the last entry.
    Next read(std::uint64_t after, std::size_t most, std::vector<Numbered>& into);
    std::vector<Numbered> read(std::uint64_t after, std::size_t most);

    // Begins a hold, and makes it the current one. Holds may overlap. Release each one once.
    Hold hold();
    // From now on, only notifications that name the hold as their cause are held. `enter` makes the hold current again.
    void leave(Hold hold) {
        if (current_ == hold) current_ = 0;
    }
    void enter(Hold hold) { current_ = hold; }
    Hold current() const { return current_; }
    // The answer cannot be sent yet: other notifications do not wait for it. `resume`: it is being sent now. Cannot fail. `delay`
    // returns whether notifications became visible.
    bool delay(Hold) noexcept;
    void resume(Hold) noexcept;
    // Makes notifications visible that nothing holds back any more. Cannot fail. Returns whether there are some, or the hold has
    // hidden the end.
    bool release(Hold) noexcept;

    bool closed() const;

    // --- With a journal (docs/journal.md): readers see a notification when it is stored. ---
    void show_when_stored();
    bool shows_when_stored() const;
    // The notifications that were not given to the journal yet, and the sequences of stored ones that cannot be read any more,
    // because they were forgotten, or replaced by a `Lost`.
    struct Unstored {
        struct Gone {
            std::uint64_t from;
            std::uint64_t until;
        };
        std::vector<Numbered> notifications;
        std::vector<Gone> gone;
    };
    Unstored unstored() const;
    // The notifications until this one were given to the journal. Cannot fail.
    void being_stored(std::uint64_t until) noexcept;
    // They are stored; returns whether notifications became visible. Or they could not be stored. Neither can fail.
    bool show(std::uint64_t until) noexcept;
    void not_stored() noexcept;
    // Sets the notifications from before a restart. Call it before the first `push`.
    void restore(std::vector<Numbered>);

    // Until this time the engine needs signs of life from the application (decision 33), so WebSockets send pings.
    void want_signs_of_life(Steady until) { signs_of_life_until_.store(until, std::memory_order_relaxed); }
    bool wants_signs_of_life(Steady now) const { return now < signs_of_life_until_.load(std::memory_order_relaxed); }

private:
    bool make_room();
    bool make_room_among_held();
    bool is_held(Hold) const;
    bool is_being_sent(Hold) const;
    bool publish() noexcept;
    void reserve_for_held(std::size_t more);
    bool shows_closed() const { return closed_ && holds_.empty(); }
    std::vector<Numbered>::const_iterator first_after(std::uint64_t sequence) const;
    std::vector<Numbered>::const_iterator end_of_shown() const;
    Next after_locked(std::uint64_t sequence) const;
    void mark_sent(std::uint64_t until);
    void forget();

    Hold current_ = 0;
    // Guards the members below. lost_ and overflowed_ change only under the engine's lock as well, so its holder may read them
    // without this mutex.
    mutable std::mutex mutex_;
    // Ordered by sequence: forgotten entries, then sent ones, then waiting ones. A `Lost` counts for several.
    std::vector<Numbered> entries_;
    std::size_t forgotten_ = 0;        // forgotten entries that are still in entries_
    std::size_t sent_ = 0;             // entries that were forgotten or sent
    std::size_t waiting_ = 0;          // waiting and held entries, without `Lost`
    std::uint64_t last_sequence_ = 0;  // of the newest entry
    std::uint64_t lost_ = 0;
    static constexpr std::uint64_t all = std::numeric_limits<std::uint64_t>::max();
    std::uint64_t shown_ = all;      // readers see the notifications until this one
    std::uint64_t given_ = 0;        // to the journal
    std::uint64_t gaps_from_ = all;  // the journal does not know the `Lost` from this sequence on
    std::uint64_t read_ = 0;         // the last one that was ever read
    struct {
        std::uint64_t after = 0;
        std::uint64_t until = 0;  // 0: none
    } kept_unread_;
    struct Held {
        Hold by;  // 0, or released: it only waits for those before it
        bool unless_delayed;
        std::shared_ptr<OutgoingNotification const> notification;
    };
    std::vector<Held> held_;  // oldest first; entries_ has room for them
    struct OpenHold {
        Hold number = 0;
        bool is_delayed = false;
    };
    std::vector<OpenHold> holds_;  // ascending
    Hold last_hold_ = 0;
    bool closed_ = false;
    bool overflowed_ = false;

    std::atomic<Steady> signs_of_life_until_{Steady::min()};

    std::size_t max_waiting_;  // constant from here on
    std::size_t max_sent_;
    SessionId session_;
};

}  // namespace rois
