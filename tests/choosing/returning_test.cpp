// Logical components of a gateway that was killed, and keeps a journal.
#include "choosing/team.hpp"

namespace rois::choosing::test {

struct ReturningTeam : testing::Test {
    ReturningTeam() {
        before.world.keep_journal();
        application = before.world.connect().session;
    }

    // The process dies. Another one has its journal, and the robots come one after the other.
    Application die_and_resume() {
        after.emplace(robots, std::map<std::string, Area>{}, EngineSettings{}, std::move(before.world.journal));
        after->world.succeed(before.world);
        Application resumed{after->world, application};
        after->world.engine->link_opened(application, LinkKind::websocket, after->world.now);
        return resumed;
    }

    std::vector<std::string> const robots{"robot1", "robot2"};
    Team before{robots};
    SessionId application;
    std::optional<Team> after;
};

TEST_F(ReturningTeam, KeepsItsBindings) {
    Application desk{before.world, application};
    desk.bind("navigation");
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    auto resumed = die_and_resume();
    EXPECT_THAT(resumed.received(), ElementsAre("1 completed go ABORT"));
    for (auto const& robot : robots) after->come(robot);
    auto other = after->world.connect();
    EXPECT_EQ(other.bind("navigation"), ReturnCode::out_of_resources) << "it is asked for";
    after->world.advance(2s);
    EXPECT_EQ(other.bind("navigation"), ReturnCode::out_of_resources) << "it is bound";
    auto const on = resumed.execute(drive_to("on", {"1000, 0, 0"}));
    EXPECT_EQ(on.return_code, ReturnCode::ok) << on.reason;
    EXPECT_EQ(after->starts_of("robot1") + after->starts_of("robot2"), 1u);
}

// Its robots come while the binding is asked for: the logical component refuses until one of them can act.
TEST_F(ReturningTeam, KeepsItsBindingsAlsoIfNoRobotIsThereForAWhile) {
    Application desk{before.world, application};
    desk.bind("navigation");
    auto resumed = die_and_resume();
    after->world.advance(5s);
    EXPECT_EQ(resumed.execute(drive_to("early", {"1000, 0, 0"})).return_code, ReturnCode::bad_parameter);
    after->come("robot2");
    after->world.advance(2s);
    EXPECT_EQ(resumed.execute(drive_to("go", {"1000, 0, 0"})).return_code, ReturnCode::ok);
    EXPECT_EQ(after->starts_of("robot2"), 1u);
}

TEST_F(ReturningTeam, GivesUpTheBindingWithItsSession) {
    Application desk{before.world, application};
    desk.bind("navigation");
    auto resumed = die_and_resume();
    resumed.ask(Disconnect{});
    for (auto const& robot : robots) after->come(robot);
    auto other = after->world.connect();
    EXPECT_EQ(other.bind("navigation"), ReturnCode::ok);
}

}  // namespace rois::choosing::test
