// A notification queue without memory: a call changes it completely or not at all.
#include <gtest/gtest.h>

#include <new>

#include "engine/notifications/notification_queue.hpp"
#include "faults/faults.hpp"

namespace rois {

namespace {

// 4 sent and 20 waiting notifications: 16 events, and a command after every fourth of them.
struct Filled {
    NotificationQueue queue{SessionId{"session"}, 100, 100};

    Filled() {
        for (int i = 0; i < 4; ++i) push(ReceiveEvent{});
        queue.read(0, 4);
        for (int i = 0; i < 16; ++i) {
            push(ReceiveEvent{});
            if (i % 4 == 3) push(Completed{});
        }
    }

    void push(Notification notification) { queue.push(std::make_shared<OutgoingNotification const>(std::move(notification))); }
};

}  // namespace

TEST(NotificationQueueWithoutMemory, ChangesCompletelyOrNotAtAll) {
    bool failed = true;
    for (std::uint64_t n = 1; failed; ++n) {
        Filled filled;
        auto& queue = filled.queue;
        faults::fail_at(faults::Of::memory, n);
        bool thrown = false;
        try {
            queue.keep_last(2);
        } catch (std::bad_alloc const&) {
            thrown = true;
        }
        failed = faults::stop();
        EXPECT_EQ(thrown, failed);
        EXPECT_EQ(queue.waiting(), failed ? 20 : 6) << n;
        EXPECT_EQ(queue.lost(), failed ? 0 : 14) << n;
        auto const left = queue.read(4, 100);
        ASSERT_FALSE(left.empty());
        for (auto const& entry : left) ASSERT_NE(entry.notification, nullptr) << n << ": " << entry.sequence;
        EXPECT_EQ(left.back().sequence, 24);
        EXPECT_EQ(queue.waiting(), 0);
    }
}

}  // namespace rois
