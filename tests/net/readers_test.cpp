// How the readers of notifications are woken.
#include "gateway/readers.hpp"

#include <gtest/gtest.h>

#include "gateway/wakes.hpp"

namespace rois {

namespace {

class Listener : public Reader {
public:
    using Reader::Reader;
    int times_woken = 0;

private:
    void woken() override { ++times_woken; }
};

class WokenReaders : public testing::Test {
protected:
    // A session with one reader on the loop.
    std::shared_ptr<Listener> join(NotificationQueue& queue) {
        auto reader = std::make_shared<Listener>(loop);
        readers.join(queue, LinkKind::websocket, *reader);
        return reader;
    }

    Telemetry telemetry;
    Troubles troubles{telemetry, [] {}};
    int turns = 0;  // requested of the loop
    Wakes loop{[this] { ++turns; }, troubles};
    Readers readers;
    NotificationQueue first{{"first"}, 10, 10};
    NotificationQueue second{{"second"}, 10, 10};
};

}  // namespace

TEST_F(WokenReaders, TheirLoopIsWokenOnceAndOnlyAfterAllWereNotified) {
    auto const one = join(first);
    auto const two = join(second);
    readers.notify(first);
    readers.notify(second);
    readers.notify(first);
    EXPECT_EQ(turns, 0);
    readers.flush();
    EXPECT_EQ(turns, 1);
    loop.serve();
    EXPECT_EQ(one->times_woken, 0) << "the first turn collects the readers";
    loop.serve();
    EXPECT_EQ(one->times_woken, 1);
    EXPECT_EQ(two->times_woken, 1);
    auto const before = turns;
    readers.flush();
    EXPECT_EQ(turns, before) << "each turn is requested once";
}

TEST_F(WokenReaders, AreServedInTheSameTurnIfTheyAreWokenMeanwhile) {
    auto const one = join(first);
    auto const two = join(second);
    readers.notify(first);
    two->wake();
    EXPECT_EQ(turns, 0) << "the turn that flush requests serves it, too";
    readers.flush();
    EXPECT_EQ(turns, 1);
    two->wake();
    EXPECT_EQ(turns, 1);
}

}  // namespace rois
