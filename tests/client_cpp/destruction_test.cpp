// A connection may be destroyed at any time: no thread or coroutine waits forever, and no memory leaks (checked by the
// sanitizers).
#include <thread>

#include "client_cpp/rig.hpp"
#include "client_cpp/slow_name.hpp"

namespace rois::test {
namespace {

class Destruction : public BothWays {
public:
    struct Handles {
        std::optional<EventStream> stream{};
        std::optional<Component> component{};
        std::optional<Command> command{};
    };

    static Handles handles_of(Blocking& robot) {
        Handles handles;
        handles.stream = robot(robot.client().subscribe("person_detected"));
        auto const follow = robot.bind<Follow>("follow");
        handles.component = follow;
        handles.command =
            robot(follow.begin_following(FollowParameters().with_target_object_ref("nobody").with_distance(500_mm)));
        return handles;
    }
};
ROIS_BOTH_WAYS(Destruction);

TEST_P(Destruction, IsPossibleAtOnce) {
    for (int i = 0; i < 20; ++i) Client robot{settings()};
}

TEST_P(Destruction, IsPossibleWhileItConnects) {
    for (int i = 0; i < 20; ++i) {
        Client robot{settings()};
        std::this_thread::sleep_for(i * 150us);
    }
}

TEST_P(Destruction, IsPossibleWhileItRetries) {
    Proxy proxy{shared_gateway().port()};
    proxy.refuse(true);
    Client robot{settings(proxy.url())};
    while (proxy.connections() < 3) std::this_thread::sleep_for(1ms);
}

TEST_P(Destruction, IsPossibleWhileACallHasNoAnswer) {
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

// Waits for everything at once, and records how each wait ends.
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
    auto const status = co_await follow.follow(FollowParameters().with_target_object_ref("nobody").with_distance(500_mm));
    if (status == CompletedStatus::abort) ++ends.count;
}

Task<> wait_for_time(Client& robot, Ends& ends) {
    co_await robot.sleep(1h);
    auto const problem = co_await robot.opened();
    if (problem && problem->why == NoAnswer::Why::closed) ++ends.count;
}

TEST_P(Destruction, EndsPendingOperations) {
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

TEST_P(Destruction, IsPossibleOnItsOwnThread) {
    auto robot = std::make_unique<Client>(settings());
    std::promise<void> gone;
    robot->spawn([](std::unique_ptr<Client>& client, std::promise<void>& over) -> Task<> {
        co_await client->opened();
        client.reset();
        over.set_value();
    }(robot, gone));
    EXPECT_EQ(gone.get_future().wait_for(5s), std::future_status::ready);
}

TEST_P(Destruction, DoesNotWaitForAHostNameLookup) {
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

TEST_P(Destruction, KeepsObserversUntilTheLastHandleIsGone) {
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
    EXPECT_TRUE(inside.expired()) << "the last handle was the last owner";
}

// Uses the handles of a destroyed client in a coroutine of another client.
Task<> ask_when_it_is_over(Destruction::Handles& handles, std::promise<std::vector<std::string>>& outcome) {
    std::vector<std::string> said;
    auto const event = co_await handles.stream->next_event(1h);
    said.emplace_back(event ? "event" : "no event");
    auto const status = co_await handles.command->completed();
    said.emplace_back(to_text(status));
    try {
        co_await handles.component->component_status();
    } catch (Error const& refused) {
        said.emplace_back(refused.what());
    }
    try {
        co_await handles.component->subscribe("person_detected");
    } catch (Error const& refused) {
        said.emplace_back(refused.what());
    }
    try {
        co_await handles.component->run("start");
    } catch (Error const& refused) {
        said.emplace_back(refused.what());
    }
    outcome.set_value(std::move(said));
}

TEST_P(Destruction, LeavesHandlesThatAnotherClientCanUse) {
    Blocking other{settings()};
    other.open();
    Handles handles;
    {
        Blocking robot{settings()};
        handles = handles_of(robot);
    }
    std::promise<std::vector<std::string>> outcome;
    other.client().spawn(ask_when_it_is_over(handles, outcome));
    auto said = outcome.get_future();
    ASSERT_EQ(said.wait_for(5s), std::future_status::ready);
    auto const closed = testing::HasSubstr("the connection is closed");
    EXPECT_THAT(said.get(), testing::ElementsAre("no event", "ABORT: the connection is closed", closed, closed, closed));
    handles.stream->each_event([](ReceiveEvent const&) { ADD_FAILURE(); });
    handles.stream->skip();
}

// The connection's state owns the observers: they show whether it was destroyed.
TEST_P(Destruction, LeavesNoReferencesToObservers) {
    auto const inside = std::make_shared<int>();
    for (int i = 0; i < 10; ++i) {
        Handles handles;
        {
            Observers observers;
            observers.state = [inside](StateChange const&) {};
            Blocking robot{settings(), std::move(observers)};
            handles = handles_of(robot);
        }
    }
    EXPECT_EQ(inside.use_count(), 1);
}

}  // namespace
}  // namespace rois::test
