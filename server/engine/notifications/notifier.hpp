// Puts notifications into the queues of sessions.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "engine/engine.hpp"
#include "engine/session.hpp"

namespace rois {

using SharedNotification = std::shared_ptr<OutgoingNotification const>;

class Notifier {
public:
    explicit Notifier(Outbox& outbox) : outbox_{outbox} {}

    // While this exists, notifications of other causes wait for the operation that is being performed only as far as this says.
    class Meanwhile {
    public:
        Meanwhile(Notifier& notifier, NotificationQueue::ForCurrent for_current)
            : notifier_{notifier}, before_{std::exchange(notifier.for_current_, for_current)} {}
        ~Meanwhile() { notifier_.for_current_ = before_; }
        Meanwhile(Meanwhile const&) = delete;
        Meanwhile& operator=(Meanwhile const&) = delete;

    private:
        Notifier& notifier_;
        NotificationQueue::ForCurrent before_;
    };

    // `cause`: the answer that must be sent first.
    void notify(Session& session, Notification notification, NotificationQueue::Hold cause = 0) {
        notify(*session.notifications, std::make_shared<OutgoingNotification const>(std::move(notification)), cause);
    }

    void notify(Session& session, SharedNotification notification, NotificationQueue::Hold cause = 0) {
        notify(*session.notifications, std::move(notification), cause);
    }

    void notify(NotificationQueue& queue, SharedNotification notification, NotificationQueue::Hold cause = 0) {
        auto const lost = queue.lost();
        bool const known = queue.overflowed();
        auto const pushed = queue.push(std::move(notification), cause, for_current_);
        if (queue.overflowed() && !known) {
            overflowed_ = true;
            ++overflows_;
        }
        if (pushed == NotificationQueue::Pushed::dropped) return;
        ++pushed_;
        lost_ += queue.lost() - lost;
        if (pushed == NotificationQueue::Pushed::first || pushed == NotificationQueue::Pushed::overflow) outbox_.notify(queue);
    }

    // The session may have missed an event (`Lost`).
    void lose(NotificationQueue& queue, NotificationQueue::Hold cause) {
        notify(queue, std::make_shared<OutgoingNotification const>(Lost{1}), cause);
    }

    // Drops the session's sent notifications, and the oldest waiting events until `events` are left.
    void keep_last(Session& session, std::size_t events) {
        auto const lost = session.notifications->lost();
        session.notifications->keep_last(events);
        lost_ += session.notifications->lost() - lost;
    }

    // Marks the end of the session's notifications.
    void close(Session& session) {
        session.notifications->close();
        outbox_.notify(*session.notifications);
    }

    // Lets the outbox deliver the notifications. Call it before the engine's lock is released.
    void flush() { outbox_.flush(); }

    // Returns whether a queue overflowed since the last call (decision 23).
    bool take_overflowed() { return std::exchange(overflowed_, false); }

    std::uint64_t pushed() const { return pushed_; }
    std::uint64_t lost() const { return lost_; }
    std::uint64_t overflows() const { return overflows_; }  // number of sessions that had to end

private:
    Outbox& outbox_;
    NotificationQueue::ForCurrent for_current_ = NotificationQueue::ForCurrent::waits;
    bool overflowed_ = false;
    std::uint64_t pushed_ = 0;
    std::uint64_t lost_ = 0;
    std::uint64_t overflows_ = 0;
};

}  // namespace rois
