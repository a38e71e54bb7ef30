// Decisions 22 and 23: consecutive numbers, holds, and the notifications that are dropped if a session does not read.
#include <gmock/gmock.h>

#include <array>
#include <random>
#include <thread>

#include "engine/notifications/notification_queue.hpp"

namespace rois {

using ForCurrent = NotificationQueue::ForCurrent;
using Pushed = NotificationQueue::Pushed;
using testing::AnyOf;
using testing::ElementsAre;
using testing::IsEmpty;

namespace {

// A queue for at most four waiting and three sent notifications. Events are "e", commands "c", as in "2 e" or "5 lost 3".
struct Queue : testing::Test {
    explicit Queue(std::size_t max_sent = 3) : queue{SessionId{"session"}, 4, max_sent} {}

    NotificationQueue queue;

    void events(int count) {
        while (count-- > 0) EXPECT_THAT(push(ReceiveEvent{}), AnyOf(Pushed::first, Pushed::behind));
    }
    void completed(int count) {
        while (count-- > 0) EXPECT_THAT(push(Completed{}), AnyOf(Pushed::first, Pushed::behind));
    }
    Pushed push(Notification notification, NotificationQueue::Hold cause = 0, ForCurrent for_current = ForCurrent::waits) {
        return queue.push(std::make_shared<OutgoingNotification const>(std::move(notification)), cause, for_current);
    }
    std::vector<std::string> read(std::uint64_t after, std::size_t most = 100) {
        std::vector<std::string> words;
        for (auto const& [sequence, notification] : queue.read(after, most)) {
            auto const* lost = std::get_if<Lost>(&notification->body);
            auto const event = std::holds_alternative<ReceiveEvent>(notification->body);
            words.push_back(std::to_string(sequence) + (lost ? " lost " + std::to_string(lost->count) : event ? " e" : " c"));
        }
        return words;
    }
};

struct LongMemory : Queue {
    LongMemory() : Queue{100} {}
};

}  // namespace

TEST_F(Queue, NumbersFromOneWithoutGaps) {
    EXPECT_EQ(queue.next(0), NotificationQueue::Next::wait);
    EXPECT_EQ(queue.last_sequence(), 0U);
    events(2);
    completed(1);
    EXPECT_EQ(queue.next(0), NotificationQueue::Next::more);
    EXPECT_THAT(read(0), ElementsAre("1 e", "2 e", "3 c"));
    EXPECT_EQ(queue.next(3), NotificationQueue::Next::wait);
    EXPECT_EQ(queue.last_sequence(), 3U);
}

TEST_F(Queue, IsReadInPiecesAndAgain) {
    events(4);
    EXPECT_THAT(read(0, 2), ElementsAre("1 e", "2 e"));
    EXPECT_THAT(read(2, 1), ElementsAre("3 e"));
    EXPECT_THAT(read(0, 3), ElementsAre("1 e", "2 e", "3 e")) << "reading does not remove entries";
    EXPECT_THAT(read(3), ElementsAre("4 e"));
    EXPECT_THAT(read(4), IsEmpty());
    EXPECT_THAT(read(77), IsEmpty());
}

TEST_F(Queue, WakesReadersOnlyForTheFirstThatWaits) {
    EXPECT_EQ(push(ReceiveEvent{}), Pushed::first);
    EXPECT_EQ(push(Completed{}), Pushed::behind);
    read(0, 1);
    EXPECT_EQ(push(ReceiveEvent{}), Pushed::behind);
    read(1);
    EXPECT_EQ(push(ReceiveEvent{}), Pushed::first);
}

TEST_F(Queue, DropsTheOldestWaitingEventsAndCountsThem) {
    events(6);
    EXPECT_THAT(read(0), ElementsAre("2 lost 2", "3 e", "4 e", "5 e", "6 e"));
    EXPECT_EQ(queue.lost(), 2U);
}

TEST_F(Queue, DropsOnlyEvents) {
    completed(1);
    EXPECT_THAT(push(ReceiveError{}), AnyOf(Pushed::first, Pushed::behind));
    events(2);
    completed(2);
    EXPECT_THAT(read(0), ElementsAre("1 c", "2 c", "4 lost 2", "5 c", "6 c"));
}

TEST_F(Queue, OverflowsWhenOtherNotificationsFillItAndKeepsThem) {
    completed(4);
    EXPECT_FALSE(queue.overflowed());
    EXPECT_EQ(push(Completed{}), Pushed::overflow);
    EXPECT_TRUE(queue.overflowed());
    EXPECT_EQ(push(ReceiveEvent{}), Pushed::dropped);
    EXPECT_EQ(push(Completed{}), Pushed::overflow);
    EXPECT_THAT(read(0), ElementsAre("1 c", "2 c", "3 c", "4 c", "5 c", "6 c")) << "an event that is not kept gets no number";
}

TEST_F(Queue, OverflowsByAnEventToo) {
    completed(4);
    EXPECT_EQ(push(ReceiveEvent{}), Pushed::dropped);
    EXPECT_THAT(read(0), ElementsAre("1 c", "2 c", "3 c", "4 c"));
}

TEST_F(Queue, CountsMissedEventsTogether) {
    events(1);
    push(Lost{1});
    push(Lost{1});
    completed(1);
    push(Lost{1});
    EXPECT_EQ(queue.waiting(), 2U);
    EXPECT_EQ(queue.lost(), 3U);
    EXPECT_THAT(read(0), ElementsAre("1 e", "3 lost 2", "4 c", "5 lost 1"));
    push(Lost{1});
    EXPECT_THAT(read(5), ElementsAre("6 lost 1")) << "entries that were read are not changed";
    EXPECT_EQ(queue.waiting(), 0U);
}

TEST_F(Queue, CountsMissedEventsThatAreHeldTogether) {
    auto const hold = queue.hold();
    EXPECT_EQ(push(Lost{1}, hold), Pushed::held);
    EXPECT_EQ(push(Lost{1}, hold), Pushed::held);
    push(Completed{}, hold);
    EXPECT_THAT(read(0), IsEmpty());
    queue.release(hold);
    EXPECT_THAT(read(0), ElementsAre("2 lost 2", "3 c"));
    EXPECT_EQ(queue.waiting(), 0U);
}

TEST_F(Queue, NeedsNoRoomForMissedEvents) {
    events(4);
    push(Lost{1});
    EXPECT_THAT(read(0), ElementsAre("1 e", "2 e", "3 e", "4 e", "5 lost 1"));
}

TEST_F(Queue, HasALostForEachGap) {
    events(1);
    completed(1);
    events(1);
    completed(1);
    events(2);
    EXPECT_THAT(read(0), ElementsAre("1 lost 1", "2 c", "3 lost 1", "4 c", "5 e", "6 e"));
}

TEST_F(Queue, CountsOnlyWaitingNotifications) {
    events(4);
    read(0);
    events(4);
    EXPECT_EQ(queue.lost(), 0U);
    EXPECT_THAT(read(4), ElementsAre("5 e", "6 e", "7 e", "8 e"));
}

TEST_F(Queue, KeepsTheLastSentNotifications) {
    events(4);
    read(0);
    EXPECT_THAT(read(0), ElementsAre("1 lost 1", "2 e", "3 e", "4 e"));
    EXPECT_THAT(read(1), ElementsAre("2 e", "3 e", "4 e"));
    events(2);
    read(4);
    EXPECT_THAT(read(1), ElementsAre("3 lost 2", "4 e", "5 e", "6 e"));
    EXPECT_THAT(read(0, 1), ElementsAre("3 lost 3"));
    EXPECT_THAT(read(3, 1), ElementsAre("4 e"));
}

TEST_F(Queue, AnswersAPositionInsideAGapWithTheRestOfIt) {
    events(8);
    EXPECT_THAT(read(0), ElementsAre("4 lost 4", "5 e", "6 e", "7 e", "8 e"));
    EXPECT_THAT(read(4), ElementsAre("5 lost 1", "6 e", "7 e", "8 e")) << "three sent ones are kept";
}

TEST_F(LongMemory, AnswersAPositionInsideAGapWithTheRestOfIt) {
    events(8);
    read(0);
    EXPECT_THAT(read(2), ElementsAre("4 lost 2", "5 e", "6 e", "7 e", "8 e"));
    EXPECT_THAT(read(3, 1), ElementsAre("4 lost 1"));
    EXPECT_THAT(read(4, 1), ElementsAre("5 e"));
}

TEST_F(Queue, AnswersAPositionBeforeAGapThatWasOnceLarger) {
    events(7);  // 3 lost 3
    read(0);    // the gap, 4 and 5 exceed the limit of sent ones
    events(6);  // 9 lost 2
    EXPECT_THAT(read(0), ElementsAre("4 lost 4", "5 e", "6 e", "7 e", "9 lost 2", "10 e", "11 e", "12 e", "13 e"));
    EXPECT_THAT(read(5), ElementsAre("10 lost 5", "11 e", "12 e", "13 e"));
}

TEST_F(Queue, CountsSkippedNotificationsAsSent) {
    events(4);
    EXPECT_THAT(read(3), ElementsAre("4 e"));
    events(4);
    EXPECT_EQ(queue.lost(), 0U);
}

// --- Holds: an answer comes before what it causes ---

TEST_F(Queue, NumbersHeldNotificationsWhenTheHoldIsReleased) {
    events(1);
    auto const hold = queue.hold();
    EXPECT_EQ(push(Completed{}), Pushed::held);
    EXPECT_EQ(push(ReceiveEvent{}), Pushed::held);
    EXPECT_EQ(queue.last_sequence(), 1U);
    EXPECT_EQ(queue.waiting(), 3U);
    EXPECT_THAT(read(0), ElementsAre("1 e"));
    queue.release(hold);
    EXPECT_THAT(read(1), ElementsAre("2 c", "3 e"));
}

TEST_F(Queue, LetsNoNotificationOvertakeOneWhoseAnswerIsBeingSent) {
    auto const answer = queue.hold();
    queue.leave(answer);
    events(1);
    EXPECT_EQ(push(Completed{}, answer), Pushed::held);
    EXPECT_EQ(push(ReceiveEvent{}), Pushed::held) << "it happened later";
    auto const second = queue.hold();
    EXPECT_EQ(push(Completed{}), Pushed::held);
    queue.leave(second);
    EXPECT_FALSE(queue.release(second));
    EXPECT_THAT(read(0), ElementsAre("1 e"));
    EXPECT_TRUE(queue.release(answer));
    EXPECT_THAT(read(1), ElementsAre("2 c", "3 e", "4 c"));
    events(1);
}

TEST_F(Queue, HoldsBackOnlyWhatTheOperationCausesWhileItsAnswerIsDelayed) {
    auto const slow = queue.hold();
    queue.leave(slow);
    EXPECT_FALSE(queue.delay(slow));
    EXPECT_EQ(push(Completed{}, slow), Pushed::held) << "by its cause";
    events(1);
    auto const second = queue.hold();
    EXPECT_EQ(push(Completed{}), Pushed::held) << "while the operation is performed";
    queue.leave(second);
    queue.release(second);
    EXPECT_THAT(read(0), ElementsAre("1 e", "2 c")) << "the slow answer keeps nothing else back";
    queue.enter(slow);
    EXPECT_EQ(push(ReceiveEvent{}), Pushed::held);
    queue.leave(slow);
    queue.resume(slow);
    EXPECT_EQ(push(ReceiveEvent{}), Pushed::held) << "the answer is being sent";
    queue.release(slow);
    EXPECT_THAT(read(2), ElementsAre("3 c", "4 e", "5 e"));
    EXPECT_THAT(push(Completed{}, slow), AnyOf(Pushed::first, Pushed::behind)) << "its answer was sent";
    events(1);
}

TEST_F(Queue, ShowsWhatWaitedForAnAnswerThatIsDelayed) {
    auto const answer = queue.hold();
    queue.leave(answer);
    push(Completed{}, answer);
    push(ReceiveEvent{});
    EXPECT_TRUE(queue.delay(answer));
    EXPECT_THAT(read(0), ElementsAre("1 e"));
    EXPECT_TRUE(queue.release(answer));
    EXPECT_THAT(read(1), ElementsAre("2 c"));
}

// A robot's events, some of which were handled beside a query that is answered later: otherwise the next ones would overtake
// them.
TEST_F(Queue, ShowsWhatHappenedBesideAnOperationWhenItsAnswerIsDelayed) {
    auto const answer = queue.hold();
    EXPECT_EQ(push(ReceiveEvent{}, 0, ForCurrent::unless_delayed), Pushed::held);
    EXPECT_EQ(push(Completed{}, 0, ForCurrent::waits), Pushed::held);
    queue.leave(answer);
    EXPECT_TRUE(queue.delay(answer));
    events(1);
    EXPECT_THAT(read(0), ElementsAre("1 e", "2 e"));
    queue.enter(answer);
    EXPECT_EQ(push(ReceiveEvent{}, 0, ForCurrent::unless_delayed), Pushed::held) << "the late answer causes it";
    queue.leave(answer);
    EXPECT_TRUE(queue.release(answer));
    EXPECT_THAT(read(2), ElementsAre("3 c", "4 e"));
}

TEST_F(Queue, MayDropHeldEvents) {
    events(1);
    auto const hold = queue.hold();
    for (int i = 0; i < 5; ++i) EXPECT_EQ(push(ReceiveEvent{}), Pushed::held);
    EXPECT_THAT(read(0), ElementsAre("1 lost 1"));
    queue.release(hold);
    EXPECT_THAT(read(1), ElementsAre("2 lost 1", "3 e", "4 e", "5 e", "6 e"));
    EXPECT_EQ(queue.lost(), 2U);
}

TEST_F(Queue, CanBeReadAfterItWasClosed) {
    completed(1);
    EXPECT_FALSE(queue.closed());
    queue.close();
    EXPECT_TRUE(queue.closed());
    EXPECT_THAT(read(0), ElementsAre("1 c"));
}

TEST_F(Queue, ShowsItsEndAfterTheLastHold) {
    auto const answer = queue.hold();
    push(Completed{});
    queue.close();
    EXPECT_FALSE(queue.closed()) << "the last entry is still unread";
    EXPECT_THAT(read(0), IsEmpty());
    queue.release(answer);
    EXPECT_TRUE(queue.closed());
    EXPECT_THAT(read(0), ElementsAre("1 c"));
}

// Two readers and holds, at random. A second queue is read from its beginning at each step, which moves its entries to the other
// store.
TEST(QueueOfAnyLength, ReadsTheSameFromBothStores) {
    for (unsigned seed = 1; seed <= 200; ++seed) {
        std::minstd_rand random{seed};
        auto const chance = [&](unsigned of) { return random() % of == 0; };
        struct Seldom : Queue {
            Seldom() : Queue{9} {}
            void TestBody() override {}
        } straight, settled;
        std::array<std::uint64_t, 2> places{};
        std::vector<NotificationQueue::Hold> holds;
        for (int step = 0; step < 300; ++step) {
            auto const both = [&](auto what) {
                auto const first = what(straight);
                EXPECT_EQ(what(settled), first) << "seed " << seed << ", step " << step;
                return first;
            };
            std::vector<Numbered> ignored;
            settled.queue.read(0, 0, ignored);
            bool const event = !chance(9);
            if (chance(2) && straight.queue.waiting() < (event ? 7U : 4U))
                both([&](Seldom& queue) { return event ? queue.push(ReceiveEvent{}) : queue.push(Completed{}); });
            if (chance(12)) holds.push_back(both([](Seldom& queue) { return queue.queue.hold(); }));
            if (!holds.empty() && chance(9)) both([&](Seldom& queue) { return queue.queue.delay(holds.front()); });
            if (!holds.empty() && chance(6)) {
                both([&](Seldom& queue) { return queue.queue.release(holds.front()); });
                holds.erase(holds.begin());
            }
            auto& place = places[step % 2];
            if (chance(20)) place = random() % (straight.queue.last_sequence() + 2);
            auto const most = 1 + random() % 10;
            both([&](Seldom& queue) { return queue.queue.next(place); });
            auto const words = both([&](Seldom& queue) { return queue.read(place, most); });
            both([](Seldom& queue) { return queue.queue.waiting(); });
            if (!words.empty()) place = std::stoull(words.back());
        }
    }
}

TEST_F(LongMemory, KeepsTheLastEventsOnly) {
    events(2);
    read(0);
    completed(1);
    events(1);
    queue.keep_last(1);
    EXPECT_THAT(read(2), ElementsAre("3 c", "4 e")) << "one waiting event is kept";
    EXPECT_THAT(read(0), ElementsAre("2 lost 2", "3 c", "4 e")) << "sent ones are forgotten";
    queue.keep_last(0);
    events(2);
    completed(1);
    events(1);
    queue.keep_last(1);
    EXPECT_EQ(queue.lost(), 2U);
    EXPECT_EQ(queue.waiting(), 2U);
    EXPECT_THAT(read(4), ElementsAre("6 lost 2", "7 c", "8 e"));
    events(1);
    EXPECT_THAT(read(8), ElementsAre("9 e"));
}

TEST(OutgoingNotification, IsEncodedOnce) {
    OutgoingNotification const notification{Completed{{"go"}, CompletedStatus::ok}};
    int encoded = 0;
    auto const encode = [&](Notification const& n) {
        ++encoded;
        return std::get<Completed>(n).command_id.text;
    };
    EXPECT_EQ(notification.text(encode), "go");
    EXPECT_EQ(notification.text(encode), "go");
    EXPECT_EQ(encoded, 1);
}

TEST_F(Queue, ReleaseReturnsWhetherTheHoldHasHiddenNotifications) {
    auto const before_nothing = queue.hold();
    EXPECT_FALSE(queue.release(before_nothing));
    auto const first = queue.hold();
    push(ReceiveEvent{});
    auto const second = queue.hold();
    EXPECT_FALSE(queue.release(second));
    EXPECT_TRUE(queue.release(first));
    auto const last = queue.hold();
    queue.close();
    EXPECT_EQ(queue.next(1), NotificationQueue::Next::wait) << "the end is hidden as well";
    EXPECT_TRUE(queue.release(last));
    EXPECT_EQ(queue.next(1), NotificationQueue::Next::ended);
}

// The engine does not wait for readers, nor readers for the engine.
TEST(QueueOnTwoThreads, IsReadWhileItIsFilled) {
    constexpr std::uint64_t count = 20'000;
    NotificationQueue queue{SessionId{"session"}, count, 10};
    std::jthread const engine{[&] {
        auto const same = std::make_shared<OutgoingNotification const>(Completed{});
        for (std::uint64_t i = 0; i < count; ++i) queue.push(same);
        queue.close();
    }};
    std::uint64_t after = 0;
    for (auto next = NotificationQueue::Next::wait; next != NotificationQueue::Next::ended; next = queue.next(after)) {
        auto const held = queue.hold();
        for (auto const& entry : queue.read(after, 64)) EXPECT_EQ(entry.sequence, ++after);
        queue.release(held);
    }
    EXPECT_EQ(after, count);
}

}  // namespace rois
