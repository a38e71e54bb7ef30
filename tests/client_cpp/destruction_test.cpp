// A connection may go at any time, whatever it is doing: nobody waits for ever, and nothing is left (the sanitizers look).
#include <thread>

#include "client_cpp/rig.hpp"
#include "client_cpp/slow_name.hpp"

namespace rois::test {
namespace {

class Destruction : public BothWays {};
ROIS_BOTH_WAYS(Destruction);

TEST_P(Destruction, AtOnce) {
    for (int i = 0; i < 20; ++i) Client robot{settings()};
}

TEST_P(Destruction, AtAnyMomentOfTheBeginning) {
    for (int i = 0; i < 20; ++i) {
        Client robot{settings()};
        std::this_thread::sleep_for(i * 150us);
    }
}

TEST_P(Destruction, WhileItTriesInVain) {
    Proxy proxy{shared_gateway().port()};
    proxy.refuse(true);
    Client robot{settings(proxy.url())};
    while (proxy.connections() < 3) std::this_thread::sleep_for(1ms);
}

TEST_P(Destruction, WhileNothingIsAnswered) {
    Proxy proxy{shared_gateway().port()};
    History history;
    Client robot{settings(proxy.url()), history.observers()};
    history.await_state("open");
    proxy.half_open();
    robot.spawn([](Client& client) -> Task<> {
        Search const all;
        co_await client.call(all);
    }(robot));
}

// What a coroutine that waits for everything at once hears in the end.
struct Ends {
    std::atomic<int> count = 0;
};

Task<> wait_for_event(Client& robot, Ends& ends) {
    auto stream = co_await robot.events<PersonDetected>();
    while (true) {
        auto const event = co_await stream.next();
        if (!event) break;
    }
    ++ends.count;
}

Task<> wait_for_command(Client& robot, Ends& ends) {
    auto const follow = co_await robot.bind<Follow>("follow");
    FollowParameters const whom{.target_object_ref = Identifier{"nobody", {}, {}, {}}, .distance = 500_mm};
    auto const status = co_await follow.follow(whom);
    if (status == CompletedStatus::abort) ++ends.count;
}

Task<> wait_for_time(Client& robot, Ends& ends) {
    co_await robot.sleep(1h);
    auto const problem = co_await robot.opened();
    if (problem && problem->why == NoAnswer::Why::closed) ++ends.count;
}

TEST_P(Destruction, EndsWhatIsAwaited) {
    Ends ends;
    {
        Client robot{settings()};
        EXPECT_FALSE(robot.wait(robot.opened()));
        robot.spawn(wait_for_event(robot, ends));
        robot.spawn(wait_for_command(robot, ends));
        robot.spawn(wait_for_time(robot, ends));
        robot.wait(robot.sleep(50ms));
    }
    EXPECT_EQ(ends.count, 3);
}

TEST_P(Destruction, OnItsOwnThread) {
    auto robot = std::make_unique<Client>(settings());
    std::promise<void> gone;
    robot->spawn([](std::unique_ptr<Client>& client, std::promise<void>& over) -> Task<> {
        co_await client->opened();
        client.reset();
        over.set_value();
    }(robot, gone));
    EXPECT_EQ(gone.get_future().wait_for(5s), std::future_status::ready);
}

TEST_P(Destruction, WaitsForNoNameThatIsStillLookedUp) {
    SlowName name;
    std::promise<void> gone;
    std::thread user{[&] {
        {
            Client const robot{settings("http://robot.slow")};
            name.await_lookup();
        }
        gone.set_value();
    }};
    EXPECT_EQ(gone.get_future().wait_for(5s), std::future_status::ready);
    name.end_lookup();
    user.join();
}

TEST_P(Destruction, LeavesHandlesThatSayThatItIsOver) {
    std::optional<EventStream> stream;
    std::optional<Component> component;
    std::weak_ptr<int> inside;
    {
        auto const kept = std::make_shared<int>();
        inside = kept;
        Observers observers;
        observers.gap = [kept](Gap const&) {};
        Blocking robot{settings(), observers};
        stream.emplace(robot(robot.client().subscribe("person_detected")));
        component.emplace(robot.client().component("navigation"));
    }
    EXPECT_EQ(stream->gaps(), 0U);
    EXPECT_EQ(component->ref().code, "navigation");
    EXPECT_FALSE(inside.expired());
    stream.reset();
    component.reset();
    EXPECT_TRUE(inside.expired()) << "nothing is left with the last handle";
}

}  // namespace
}  // namespace rois::test
