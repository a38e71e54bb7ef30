// Another member goes on with a command.
#include "choosing/team.hpp"

namespace rois::choosing::test {

namespace {

using testing::Contains;

}  // namespace

TEST_F(TwoRobots, EndTheCommandAsTheMemberEndedItWithoutSwitching) {
    desk.bind("navigation");
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    team.drive("robot1").finishes(CompletedStatus::error);
    EXPECT_EQ(desk.result_of("go"), "ERROR");
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go ERROR"));
}

TEST_F(TwoRobots, AbortTheCommandIfThatWasAgreed) {
    bind(desk, "navigation", Switching::abort);
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    team.drive("robot1").finishes(CompletedStatus::error);
    EXPECT_EQ(desk.result_of("go"), "ABORT");
    EXPECT_EQ(team.starts_of("robot2"), 0);
}

TEST_F(TwoRobots, GoOnWithWhatIsLeft) {
    bind(desk, "navigation", Switching::restart);
    desk.execute(drive_to("go", {"1000, 0, 0", "2000, 0, 0", "3000, 0, 0"}));
    team.drive("robot1").fires("reached_target", {text("target", "1000, 0, 0"), boolean("is_final_target", false)});
    team.drive("robot1").finishes(CompletedStatus::error);
    EXPECT_EQ(desk.result_of("go"), "RUNNING");
    EXPECT_THAT(in_words(team.drive("robot2").started_with), testing::StartsWith("target_position=2000, 0, 0|3000, 0, 0 "));
    team.drive("robot2").finishes();
    EXPECT_THAT(desk.received(),
                ElementsAre("1 switched navigation from robot1.navigation to robot2.navigation", "2 completed go OK"));
}

TEST_F(TwoRobots, GoOnIfOneIsLost) {
    bind(desk, "navigation", Switching::restart);
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    team.go("robot1");
    EXPECT_EQ(team.starts_of("robot2"), 1);
    team.drive("robot2").finishes();
    EXPECT_EQ(desk.result_of("go"), "OK");
}

// A lost engine cannot confirm that its robot stands still.
TEST_F(TwoRobots, StopAfterASwitchFromOneThatIsLost) {
    bind(desk, "navigation", Switching::restart);
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    auto& lost = team.drive("robot1");
    lost.halts_later = true;
    lost.status_now = ComponentStatus::error;
    lost.finishes(CompletedStatus::abort);
    EXPECT_EQ(team.starts_of("robot2"), 1);
    world.advance(2s);
    desk.execute(named("stop", stop("navigation")));
    EXPECT_EQ(desk.result_of("stop"), "OK");
    EXPECT_EQ(desk.result_of("go"), "ABORT");
    team.drive("robot2").calls.clear();
    desk.leave();
    world.advance(1s);
    auto other = world.connect();
    EXPECT_EQ(other.bind("navigation"), ReturnCode::ok);
}

TEST_F(TwoRobots, DoNotGoOnBeforeTheOtherStandsStill) {
    bind(desk, "navigation", Switching::restart);
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    team.drive("robot1").halts_later = true;
    team.drive("robot1").finishes(CompletedStatus::error);
    EXPECT_EQ(team.starts_of("robot2"), 0);
    team.drive("robot1").stands_still();
    EXPECT_EQ(team.starts_of("robot2"), 1);
}

TEST_F(TwoRobots, DoNotGoOnIfTheOtherNeverStandsStill) {
    bind(desk, "navigation", Switching::restart);
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    team.drive("robot1").halts_later = true;
    team.drive("robot1").finishes(CompletedStatus::error);
    world.advance(1s);
    EXPECT_EQ(team.starts_of("robot2"), 0);
    EXPECT_EQ(desk.result_of("go"), "ERROR");
    EXPECT_THAT(desk.reason_of("go"), HasSubstr("robot1.navigation has not confirmed that it stands still"));
}

TEST_F(TwoRobots, DoNotSwitchAtTheEndOfTheApplicationsOwnTimeLimit) {
    bind(desk, "navigation", Switching::restart);
    desk.execute(named("go", start("navigation", {texts("target_position", {"1000, 0, 0"}), integer("time_limit", 6'000)})));
    team.drive("robot1").finishes(CompletedStatus::timeout);
    EXPECT_EQ(desk.result_of("go"), "TIMEOUT");
    EXPECT_EQ(team.starts_of("robot2"), 0);
}

TEST_F(TwoRobots, SwitchAtMostOnceInFiveSeconds) {
    bind(desk, "navigation", Switching::restart);
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    team.drive("robot1").finishes(CompletedStatus::error);
    team.drive("robot2").finishes(CompletedStatus::error);
    EXPECT_EQ(desk.result_of("go"), "ABORT");
    EXPECT_THAT(desk.reason_of("go"), HasSubstr("switched less than 5 s ago"));
    EXPECT_EQ(team.starts_of("robot1"), 1);
}

TEST_F(TwoRobots, SwitchOnceInFiveSecondsAlsoAfterARefusal) {
    bind(desk, "navigation", Switching::restart);
    team.drive("robot1").accepts = 2;  // twice it only checks the command
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    EXPECT_EQ(team.starts_of("robot2"), 1);
    team.drive("robot2").finishes(CompletedStatus::error);
    EXPECT_EQ(desk.result_of("go"), "ABORT");
    EXPECT_THAT(desk.reason_of("go"), HasSubstr("switched less than 5 s ago"));
}

TEST_F(TwoRobots, EndTheCommandIfNoneIsLeft) {
    bind(desk, "navigation", Switching::restart);
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    team.go("robot2");
    team.drive("robot1").finishes(CompletedStatus::error);
    EXPECT_EQ(desk.result_of("go"), "ABORT");
    EXPECT_THAT(desk.reason_of("go"), HasSubstr("no other component can go on"));
}

TEST(ARobotThatLeavesItsArea, IsStoppedAndAnotherGoesOn) {
    Team team{{"robot1", "robot2"}, {{"robot1", {{-1'000, -1'000}, {2'000, -1'000}, {2'000, 1'000}, {-1'000, 1'000}}}}};
    team.place("robot1", 0, 0);
    team.place("robot2", 10'000, 0);
    auto desk = team.world.connect();
    bind(desk, "navigation", Switching::restart);
    desk.execute(drive_to("go", {"1500, 0, 0", "5000, 0, 0"}));
    EXPECT_EQ(team.starts_of("robot1"), 1);
    team.drive("robot1").calls.clear();
    team.place("robot1", 2'100, 0);
    EXPECT_THAT(team.drive("robot1").calls, Contains("halt"));
    EXPECT_EQ(team.starts_of("robot2"), 1);
    team.drive("robot2").finishes();
    EXPECT_EQ(desk.result_of("go"), "OK");
    desk.execute(drive_to("back", {"2100, 0, 0"}));
    EXPECT_EQ(team.starts_of("robot2"), 2) << "robot1 is outside of its area";
}

TEST_F(TwoRobots, SwitchInTheMiddleOfAParallelUnit) {
    bind(desk, "navigation", Switching::restart);
    desk.bind("speech");
    desk.execute(in_parallel({drive_to("go", {"1000, 0, 0"}), say("hello")}));
    team.drive("robot1").finishes(CompletedStatus::error);
    world["robot1.speech"].finishes();
    EXPECT_EQ(desk.result_of("hello"), "OK");
    team.drive("robot2").finishes();
    EXPECT_EQ(desk.result_of("go"), "OK");
}

TEST_F(TwoRobots, ReportSwitchesToThoseWhoAskForAll) {
    Connect connect;
    connect.switches = true;
    auto console = world.connect(connect);
    auto other = world.connect();
    bind(desk, "navigation", Switching::restart);
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    team.drive("robot1").finishes(CompletedStatus::error);
    EXPECT_THAT(console.received(), ElementsAre("1 switched navigation from robot1.navigation to robot2.navigation"));
    EXPECT_THAT(other.received(), IsEmpty());
}

// Only those who see its members, or may command it, learn their names.
TEST_F(TwoRobots, HideTheirNamesFromThoseWhoSeeOnlyTheLogicalComponent) {
    Connect connect;
    connect.switches = true;
    using Patterns = std::vector<std::string>;
    auto const client = [&](Patterns sees, Patterns commands) {
        auto made = world.connect_as(std::make_shared<Rights const>("client", std::move(sees), std::move(commands)), connect);
        made.subscribe("reached_target");
        return made;
    };
    auto sees_all = client({"*"}, {}), commands = client({"navigation"}, {"*"});
    auto commands_another = client({"navigation", "speech"}, {"speech"}), observes = client({"navigation"}, {});
    bind(desk, "navigation", Switching::restart);
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    std::vector<Application*> const all{&sees_all, &commands, &commands_another, &observes};
    auto const is_told = [&](Application const* each) { return each == &sees_all || each == &commands; };
    team.drive("robot1").reports(ErrorType::component_internal_error, "its wheel");
    for (auto* each : all) {
        EXPECT_THAT(each->received(), Contains("1 COMPONENT_INTERNAL_ERROR navigation"));
        auto const detail = each->detail_of(each->last_received<ReceiveError>().error_id);
        EXPECT_EQ(find(detail.results.parameters, "text") != nullptr, is_told(each));
    }
    team.drive("robot1").finishes(CompletedStatus::error);
    for (auto* each : all) {
        auto const received = each->received();
        auto const names = [](std::string const& text) { return text.find("robot1.navigation to") != text.npos; };
        EXPECT_EQ(std::ranges::any_of(received, names), is_told(each));
    }
}

}  // namespace rois::choosing::test
