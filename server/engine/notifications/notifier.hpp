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

    // While this exists, notifications do not wait for the operation that is being performed: it has not caused them.
    class Meanwhile {
    public:
        explicit Meanwhile(Notifier& notifier) : notifier_{notifier} { notifier_.only_causes_ = true; }
        ~Meanwhile() { notifier_.only_causes_ = false; }
        Meanwhile(Meanwhile const&) = delete;
        Meanwhile& operator=(Meanwhile const&) = delete;

    private:
        Notifier& notifier_;
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
        auto const pushed = queue.push(std::move(notification), cause, only_causes_);
        if (queue.overflowed() && !known) {
            overflowed_ = true;
            ++overflows_;
        }
        if (pushed == NotificationQueue::Pushed::dropped) return;
        ++pushed_;
        lost_ += queue.lost() - lost;
        if (pushed == NotificationQueue::Pushed::first || pushed == NotificationQueue::Pushed::overflow) outbox_.notify(queue);
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
    bool only_causes_ = false;
    bool overflowed_ = false;
    std::uint64_t pushed_ = 0;
    std::uint64_t lost_ = 0;
    std::uint64_t overflows_ = 0;
};

}  // namespace rois
