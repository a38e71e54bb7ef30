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
    Wakes* fast_ = nullptr;
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

// The loop may be so fast that its connection has ended before `wake` returns. The connection must have ended on the loop's
// thread.
TEST_F(WokenReaders, EndOnTheirOwnThreadEvenIfTheAnswerComesOnAnother) {
    struct Connection {
        bool& serves;
        bool& ended_in_loop;
        ~Connection() { ended_in_loop = serves; }
    };
    bool serves = false, ended_in_loop = false;
    std::shared_ptr<Connection> connection{new Connection{serves, ended_in_loop}};
    std::shared_ptr<Waker> waker;
    Wakes fast{[&] {
                   serves = true;
                   for (int i = 0; i < 2; ++i) fast_->serve();
                   connection.reset();
                   waker.reset();
                   serves = false;
               },
               troubles};
    fast_ = &fast;
    int answers = 0;
    waker = std::make_shared<Waker>(fast, [&answers, of = std::weak_ptr{connection}] { answers += of.lock() != nullptr; });
    std::weak_ptr<Waker> const of_answer = waker;
    of_answer.lock()->wake();
    EXPECT_EQ(answers, 1);
    EXPECT_TRUE(ended_in_loop);
    EXPECT_TRUE(of_answer.expired());
}

}  // namespace rois
