// Motion leases (docs/safety.md): a robot moves on while the application's thread lives, and is held when that thread hangs.
#include "client_cpp/rig.hpp"

namespace rois::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr auto lease = 1000ms;
constexpr auto longer = 2500ms;  // than the lease, with time for a busy machine

// Blocks the thread without using the client.
void hang(std::chrono::milliseconds time) { std::this_thread::sleep_for(time); }

Task<Command> set_out(Client& robot) {
    auto const navigation = co_await robot.bind("navigation");
    ParameterList way{texts("target_position", {"14000, 6000", "1000, 6000", "14000, 6000", "1000, 6000"})};
    auto command = co_await navigation.begin("start", std::move(way));
    co_return command;
}

class TheApplication : public BothWays {
protected:
    Settings moving() const {
        auto settings = BothWays::settings(gateway.url());
        settings.motion_lease = lease;
        return settings;
    }
    std::vector<ErrorType> errors() const {
        std::vector<ErrorType> all;
        for (auto const& [sequence, notification] : history.notifications())
            if (auto const* const error = std::get_if<ReceiveError>(&notification)) all.push_back(error->error_type);
        return all;
    }
    void await_hold() {
        history.await_notifications(1);
        EXPECT_THAT(errors(), ElementsAre(ErrorType::user_defined_error));
    }

    GatewayProcess gateway{{"--sim-speed", "1", "--scenario", ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml"}};
    History history;
};
ROIS_BOTH_WAYS(TheApplication);

TEST_P(TheApplication, MovesOnWhileItsThreadWaits) {
    Blocking robot{moving(), history.observers()};
    robot(set_out(robot.client()));
    robot(robot.client().sleep(longer));
    EXPECT_THAT(history.notifications(), IsEmpty());
}

TEST_P(TheApplication, MovesOnWhileItsThreadWaitsForShortTimes) {
    Blocking robot{moving(), history.observers()};
    robot(set_out(robot.client()));
    for (int i = 0; i < 25; ++i) robot(robot.client().sleep(100ms));
    EXPECT_THAT(history.notifications(), IsEmpty());
}

TEST_P(TheApplication, MovesOnWhileItsThreadCallsAlive) {
    Blocking robot{moving(), history.observers()};
    robot(set_out(robot.client()));
    for (auto time = 0ms; time < longer; time += robot.client().between_signs_of_life()) {
        robot.client().alive();
        hang(robot.client().between_signs_of_life());
    }
    EXPECT_THAT(history.notifications(), IsEmpty());
}

TEST_P(TheApplication, IsHeldWhenItsThreadHangsAndGoesOnWithResume) {
    Blocking robot{moving(), history.observers()};
    robot(set_out(robot.client()));
    await_hold();
    auto const error = std::get<ReceiveError>(history.notifications().front().second);
    auto const details = robot(robot.client().get_error_detail(error.error_id));
    EXPECT_THAT(find(details.parameters, "text")->values.front(), HasSubstr("its application gave no sign of life"));
    EXPECT_EQ(robot(robot.client().component("navigation").resume()), CompletedStatus::ok);
    robot(robot.client().sleep(longer));
    EXPECT_THAT(errors(), ElementsAre(ErrorType::user_defined_error)) << "reported once";
}

TEST_P(TheApplication, IsHeldWhenItsThreadHangsThoughACoroutineListens) {
    Blocking robot{moving(), history.observers()};
    robot.client().spawn([](Client& client) -> Task<> {
        auto stream = co_await client.subscribe("reached_target");
        for (bool is_open = true; is_open;) {
            auto const event = co_await stream.next_event();
            is_open = event.has_value();
        }
    }(robot.client()));
    robot(set_out(robot.client()));
    await_hold();
    robot.client().close();
    history.await_state("closed");
}

TEST_P(TheApplication, OfCoroutinesMovesOnWhileTheClientsThreadIsFree) {
    Client robot{moving(), history.observers()};
    auto const begun = test::begun(robot, set_out(robot));
    begun.wait();
    hang(longer);
    EXPECT_THAT(history.notifications(), IsEmpty());
}

TEST_P(TheApplication, OfCoroutinesIsHeldWhenOneBlocksTheClientsThread) {
    Client robot{moving(), history.observers()};
    robot.spawn([](Client& client) -> Task<> {
        co_await set_out(client);
        hang(longer);
    }(robot));
    await_hold();
}

TEST_P(TheApplication, CannotExtendTheLeaseOfTheGateway) {
    auto settings = moving();
    settings.motion_lease = 3000ms;
    Blocking robot{settings, history.observers()};
    try {
        robot.open();
        ADD_FAILURE() << "it is open";
    } catch (Error const& refused) {
        EXPECT_THAT(refused.what(), HasSubstr("motion_lease must be 1000 to 2000 milliseconds, not 3000"));
    }
}

// --- Stop for everything ---

TEST_P(TheApplication, StopsEverythingAndClears) {
    Blocking robot{moving(), history.observers()};
    auto const command = robot(set_out(robot.client()));
    Settings outside;
    outside.url = gateway.url();
    auto stopped = stop_everything(outside);
    EXPECT_TRUE(stopped.stopped);
    auto const patience = std::chrono::steady_clock::now() + 10s;
    while (!stopped.not_halted.empty() && std::chrono::steady_clock::now() < patience) stopped = stop_everything(outside);
    EXPECT_THAT(stopped.not_halted, IsEmpty()) << "the robot has braked";
    EXPECT_EQ(robot(command.completed()), CompletedStatus::abort);
    try {
        robot(robot.client().component("navigation").start());
        ADD_FAILURE() << "the command was accepted";
    } catch (Error const& refused) {
        EXPECT_EQ(refused.code(), ReturnCode::error);
        EXPECT_THAT(refused.what(), HasSubstr("everything was stopped"));
    }
    EXPECT_FALSE(clear_everything(outside).stopped);
    robot(set_out(robot.client()));
}

TEST(StopForEverything, NamesTheComponentsThatHaveNotConfirmed) {
    GatewayProcess gateway{
        {"--scenario", ROIS_SOURCE_DIR "/tests/server/data/unstoppable.xml", "--sim-speed", "0", "--shutdown-timeout", "0.1"}};
    Settings settings;
    settings.url = gateway.url();
    EXPECT_THAT(stop_everything(settings).not_halted, ElementsAre("navigation"));
    EXPECT_THAT(clear_everything(settings).not_halted, ElementsAre("navigation"));
    gateway.signal(SIGTERM);
    EXPECT_EQ(gateway.wait().exit_code, 71);
}

TEST(StopForEverything, ReportsWhyItFailed) {
    auto const why = [](Settings const& settings) -> std::string {
        try {
            stop_everything(settings);
            return "stopped";
        } catch (Error const& error) {
            return std::string{to_text(error.code())} + ": " + error.what();
        }
    };
    Settings nowhere;
    nowhere.url = "http://127.0.0.1:1";
    EXPECT_THAT(why(nowhere), testing::StartsWith("ERROR: stop for everything: no connection to 127.0.0.1:1: "));
}

}  // namespace
}  // namespace rois::test
