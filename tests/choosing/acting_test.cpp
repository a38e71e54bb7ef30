#include <algorithm>

#include "choosing/common_profile.hpp"
#include "choosing/team.hpp"
#include "engine/conditions/conditions.hpp"

namespace rois::choosing::test {

namespace {

using testing::Contains;
using testing::Not;

// A component whose positions are in the frame of its engine.
ComponentDescription const& with_own_frame(std::string const& ref) {
    static ComponentDescription description;
    description.ref = Application::identifier(ref);
    description.crs = "urn:x-example:robot1";
    description.positions = {"target_position"};
    auto profile = std::make_shared<ComponentProfile>();
    profile->parameters.push_back({.name = "target_position",
                                   .data_type_ref = {"string[]", {}, description.crs, {}},
                                   .default_value = {},
                                   .description = {}});
    description.profile = std::move(profile);
    return description;
}

}  // namespace

// --- What applications see ---

TEST_F(TwoRobots, AreOneForThoseWhoDoNotAskForUnits) {
    EXPECT_THAT(desk.search(), ElementsAre("navigation", "speech"));
    EXPECT_THAT(desk.search(equal("component_type", "urn:x-rois:def:component:OMG::Navigation")), ElementsAre("navigation"));
    EXPECT_EQ(desk.bind_any(equal("component_type", "urn:x-rois:def:component:OMG::Navigation")), "navigation");
}

TEST_F(TwoRobots, AreNotInTheProfileForThoseWhoDoNotAskForUnits) {
    auto const whole = desk.ask(GetProfile{});
    EXPECT_THAT(whole.profile->components, ElementsAre("navigation", "speech"));
    EXPECT_THAT(whole.profile->sub_profiles, IsEmpty());
    EXPECT_EQ(whole.components.size(), 2u);
    auto const of_robot = desk.ask(GetProfile{equal("engine", "robot1")});
    EXPECT_EQ(of_robot.profile->object.name, "robot1");
    EXPECT_EQ(of_robot.components.size(), 2u);
}

TEST_F(TwoRobots, AreSeenByThoseWhoAskByRefOrEngine) {
    EXPECT_THAT(desk.search(equal("engine", "robot2")), ElementsAre("robot2.navigation", "robot2.speech"));
    EXPECT_THAT(desk.search(equal("component_ref", "robot1.speech")), ElementsAre("robot1.speech"));
    EXPECT_EQ(desk.bind("robot1.navigation"), ReturnCode::ok);
}

TEST_F(TwoRobots, AreSeenByThoseWhoAskForAnyEngine) {
    Condition const any_engine{PropertyIsLike{{ValueReference{"engine"}}, {Literal{"*"}}, "*", "?", "!"}};
    EXPECT_THAT(desk.search(any_engine), Contains("robot1.navigation"));
    EXPECT_THAT(desk.search(equal("engine", "main")), ElementsAre("navigation", "speech"));
    Condition const of_main = both({equal("engine", "main"), equal("component_type", navigation.profile.object.identifier)});
    EXPECT_THAT(desk.search(of_main), ElementsAre("navigation"));
    desk.subscribe("reached_target", any_engine);
    desk.subscribe("reached_target");
    desk.bind("navigation");
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    team.drive("robot1").fires("reached_target", {text("target", "1000, 0, 0"), boolean("is_final_target", true)});
    EXPECT_THAT(desk.received(),
                ElementsAre("1 reached_target robot1.navigation", "2 reached_target navigation", "3 reached_target navigation"))
        << "the first condition also matches the main engine";
}

TEST_F(TwoRobots, FireOneEventForThoseWhoDoNotAskForUnits) {
    desk.subscribe("reached_target");
    desk.bind("navigation");
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    team.drive("robot1").fires("reached_target", {text("target", "1000, 0, 0"), boolean("is_final_target", true)});
    EXPECT_THAT(desk.received(), ElementsAre("1 reached_target navigation"));
}

TEST_F(TwoRobots, AreFoundByTheNameOfTheRobot) {
    EXPECT_THAT(desk.search(equal("RobotId", "robot2")), ElementsAre("robot2.navigation", "robot2.speech"));
    EXPECT_THAT(desk.search(equal("RobotId", "main")), ElementsAre("navigation", "speech"));
}

TEST_F(TwoRobots, KeepTheOneWhoseFunctionIsActive) {
    for (auto const* ref : {"navigation", "speech"}) desk.bind(ref);
    desk.execute(named("1", command("dock", "navigation")));
    ASSERT_THAT(team.drive("robot1").calls, Contains("dock"));
    team.drive("robot1").finishes(CompletedStatus::ok, {{integer("charge", 1)}, {}}, Afterwards::active);
    auto hall = world.connect();
    hall.bind("robot1.speech");
    desk.execute(named("hello", start("speech", {text("speech_text", "Hello.")})));
    desk.execute(named("2", command("dock", "navigation")));
    EXPECT_THAT(team.drive("robot2").calls, Not(Contains("dock"))) << "although robot2 speaks for this application";
    desk.execute(named("stop", stop("navigation")));
    world.advance(100ms);
    desk.execute(named("3", command("dock", "navigation")));
    EXPECT_THAT(team.drive("robot2").calls, Contains("dock"));
}

TEST(ATeam, AppearsWithItsFirstMemberAndGoesWithItsLast) {
    Team team{{"robot1", "robot2"}};
    auto desk = team.world.connect();
    team.go("robot1");
    EXPECT_THAT(desk.search(), ElementsAre("navigation", "speech"));
    team.go("robot2");
    EXPECT_THAT(desk.search(), IsEmpty());
    team.come("robot2");
    EXPECT_THAT(desk.search(), ElementsAre("navigation", "speech"));
    EXPECT_EQ(desk.bind("navigation"), ReturnCode::ok);
}

TEST(ATeam, ReportsNamesThatNoEngineHas) {
    Team team{{"robot1", "robot2"}};
    EXPECT_THAT(team.log, ElementsAre(R"("sensing" has 'localization', but no engine of "engines" has such a component)",
                                      R"("sensing" has 'detection', but no engine of "engines" has such a component)"));
    team.go("robot1");
    team.come("robot1");
    EXPECT_EQ(team.log.size(), 2u) << "once";
}

TEST(ATeam, OffersWhatAllItsMembersHave) {
    Team team{{"robot1", "robot2"}};
    team.log.clear();
    team.go("robot2");
    auto simple = Team::driving("robot2");
    std::erase_if(simple.profile.messages, [](auto const& message) { return message.name == "dock"; });
    std::erase_if(simple.profile.parameters, [](auto const& parameter) { return parameter.name == "routing_policy"; });
    team.world.change({}, {simple});
    EXPECT_THAT(team.log,
                ElementsAre("navigation is offered without the command 'dock', which robot2.navigation lacks",
                            "navigation is offered without the parameter 'routing_policy', which robot2.navigation lacks"));
    auto desk = team.world.connect();
    desk.bind("navigation");
    EXPECT_EQ(desk.execute(command("dock", "navigation")).return_code, ReturnCode::bad_parameter);
    team.go("robot1");
    EXPECT_EQ(desk.bind("navigation"), ReturnCode::ok) << "it was replaced";
}

// A client that does not see the members would learn from these which one acts.
TEST_F(TwoRobots, DoNotShowInThePositionOrTheProfile) {
    EXPECT_THAT(desk.search(equal("location/@ref", "robot1")), IsEmpty());
    EXPECT_THAT(desk.search(equal("location/@ref", "main")), ElementsAre("navigation", "speech"));
    EXPECT_EQ(common("navigation", {&with_own_frame("robot1.navigation")})
                  .description.profile->parameters.front()
                  .data_type_ref.codebook_ref,
              "");
}

// --- Choosing ---

TEST_F(TwoRobots, ActIfTheyAreNearest) {
    desk.bind("navigation");
    desk.execute(drive_to("near2", {"9000, 0, 0"}));
    EXPECT_EQ(team.starts_of("robot1"), 0);
    EXPECT_EQ(team.starts_of("robot2"), 1);
    EXPECT_EQ(desk.result_of("near2"), "RUNNING");
    team.drive("robot2").finishes();
    EXPECT_EQ(desk.result_of("near2"), "OK");
    desk.execute(drive_to("near1", {"1000, 0, 0"}));
    EXPECT_EQ(team.starts_of("robot1"), 1);
}

TEST_F(TwoRobots, ChangeOnlyForMoreThanAMetre) {
    desk.bind("navigation");
    desk.execute(drive_to("first", {"9000, 0, 0"}));
    team.drive("robot2").finishes();
    desk.execute(drive_to("middle", {"4800, 0, 0"}));  // robot2 is 0.4 m farther away
    EXPECT_EQ(team.starts_of("robot2"), 2);
    team.drive("robot2").finishes();
    desk.execute(drive_to("beyond", {"4000, 0, 0"}));
    EXPECT_EQ(team.starts_of("robot1"), 1);
}

TEST_F(TwoRobots, SpeakIfTheyDrive) {
    desk.bind("navigation");
    desk.bind("speech");
    desk.execute(drive_to("go", {"9000, 0, 0"}));
    desk.execute(say("hello"));
    EXPECT_THAT(world["robot2.speech"].calls, Contains("start"));
    EXPECT_THAT(world["robot1.speech"].calls, Not(Contains("start")));
}

TEST(ATeam, ForgetsWhoDroveWhenTheDrivingComponentIsReplaced) {
    Team team{{"robot1", "robot2", "robot3"}};
    team.go("robot3");
    team.place("robot1", 0, 0);
    team.place("robot2", 10'000, 0);
    auto desk = team.world.connect();
    desk.bind("navigation");
    desk.bind("speech");
    desk.execute(drive_to("go", {"9000, 0, 0"}));
    team.drive("robot2").finishes();
    auto simple = Team::driving("robot3");
    std::erase_if(simple.profile.messages, [](auto const& message) { return message.name == "dock"; });
    team.world.change({}, {simple});
    ASSERT_THAT(team.log, Contains(HasSubstr("without the command 'dock'")));
    team.look();
    desk.execute(say("hello"));
    EXPECT_THAT(team.world["robot1.speech"].calls, Contains("start"));
    EXPECT_THAT(team.world["robot2.speech"].calls, Not(Contains("start")));
}

TEST_F(TwoRobots, SpeakIfTheyDriveInAParallelUnit) {
    desk.bind("navigation");
    desk.bind("speech");
    desk.execute(in_parallel({drive_to("go", {"9000, 0, 0"}), say("hello")}));
    EXPECT_EQ(team.starts_of("robot2"), 1);
    EXPECT_THAT(world["robot2.speech"].calls, Contains("start"));
    EXPECT_THAT(world["robot1.speech"].calls, Not(Contains("start")));
}

TEST_F(TwoRobots, AreChosenInTheOrderOfTheCondition) {
    QueryExpression farthest{
        equal("component_type", "urn:x-rois:def:component:OMG::Navigation"),
        {{{Function{"distance", {{ValueReference{"location"}}, {Literal{"0, 0"}}}}}, SortOrder::descending}}};
    ASSERT_EQ(desk.bind_any(farthest), "navigation");
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    EXPECT_EQ(team.starts_of("robot2"), 1);
    team.drive("robot2").finishes();
    team.place("robot1", 20'000, 0);
    desk.execute(drive_to("on", {"1000, 0, 0"}));
    EXPECT_EQ(team.starts_of("robot1"), 1) << "as the members are now";
}

// The order of the members is needed before one is asked: comparing them may take more steps than the session has.
TEST(ATeam, IsNotAskedAfterARefusal) {
    EngineSettings settings;
    settings.max_condition_steps = 1'000'000;
    Team team{{"robot1", "robot2"}, {}, settings};
    auto desk = team.world.connect();
    QueryExpression nearest{equal("component_type", "urn:x-rois:def:component:OMG::Navigation"),
                            {{{Function{"distance", {{ValueReference{"location"}}, {Literal{"0, 0"}}}}}, SortOrder::descending}}};
    ASSERT_EQ(desk.bind_any(nearest), "navigation");
    std::vector<Condition> many(250, like("component_type", "*" + std::string(900, 'n')));
    while (desk.ask(Search{either(many)}).return_code == ReturnCode::ok) continue;
    EXPECT_EQ(desk.execute(drive_to("go", {"1000, 0, 0"})).return_code, ReturnCode::out_of_resources);
    team.world.advance(3s);
    EXPECT_THAT(desk.received(), testing::Each(HasSubstr("profile_changed"))) << "no error";
    EXPECT_EQ(desk.ask(Release{Application::identifier("navigation")}).return_code, ReturnCode::ok);
    EXPECT_THAT(desk.search(equal("status", "READY")), Contains("navigation"));
}

TEST(ATeam, PrefersRobotsWhoseAreaHasTheTarget) {
    Team team{{"robot1", "robot2"}, {{"robot1", {{0, -1'000}, {5'000, -1'000}, {5'000, 1'000}, {0, 1'000}}}}};
    team.place("robot1", 4'000, 0);
    team.place("robot2", 20'000, 0);
    auto desk = team.world.connect();
    desk.bind("navigation");
    desk.execute(drive_to("go", {"6000, 0, 0"}));
    EXPECT_EQ(team.starts_of("robot2"), 1);
}

TEST_F(TwoRobots, AreNotChosenIfAnotherApplicationHasBoundThem) {
    auto other = world.connect();
    other.bind("robot1.navigation");
    desk.bind("navigation");
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    EXPECT_EQ(team.starts_of("robot2"), 1);
    EXPECT_EQ(other.bind("robot2.navigation"), ReturnCode::out_of_resources);
    desk.release("navigation");
    EXPECT_EQ(other.bind("robot2.navigation"), ReturnCode::ok);
    team.look();
    EXPECT_EQ(desk.bind("navigation"), ReturnCode::out_of_resources);
}

TEST_F(TwoRobots, AreChosenAsSoonAsTheyAreFree) {
    auto other = world.connect();
    for (auto* each : {"robot1.navigation", "robot2.navigation"}) other.bind(each);
    world.advance(20ms);
    EXPECT_EQ(desk.bind("navigation"), ReturnCode::out_of_resources);
    for (auto* each : {"robot1.navigation", "robot2.navigation"}) other.release(each);
    world.advance(20ms);
    EXPECT_EQ(desk.bind("navigation"), ReturnCode::ok);
}

TEST_F(TwoRobots, AreChosenIfTheOtherRefusesTheParameters) {
    team.drive("robot1").accepts = 0;
    desk.bind("navigation");
    EXPECT_EQ(desk.execute(drive_to("go", {"1000, 0, 0"})).return_code, ReturnCode::ok);
    EXPECT_EQ(team.starts_of("robot2"), 1);
}

TEST_F(TwoRobots, AreChosenIfTheOtherFails) {
    team.drive("robot1").throws_in = {"prepare"};
    desk.bind("navigation");
    EXPECT_EQ(desk.execute(drive_to("go", {"1000, 0, 0"})).return_code, ReturnCode::ok);
    EXPECT_EQ(team.starts_of("robot2"), 1);
}

TEST_F(TwoRobots, AreChosenIfTheOtherIsInError) {
    team.drive("robot1").status_now = ComponentStatus::error;
    team.look();
    EXPECT_EQ(desk.status_of("navigation"), "READY");
    desk.bind("navigation");
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    EXPECT_THAT(team.drive("robot1").calls, Not(Contains("prepare")));
    EXPECT_EQ(team.starts_of("robot2"), 1);
}

TEST(ATeam, GoesOnWithTheChosenOneWhenANearerOneJoins) {
    Team team{{"robot1", "robot2"}};
    team.go("robot2");
    team.place("robot1", 0, 0);
    auto desk = team.world.connect();
    bind(desk, "navigation", Switching::restart);
    desk.execute(drive_to("go", {"9000, 0, 0"}));
    team.come("robot2");
    team.place("robot2", 9'000, 0);
    EXPECT_EQ(team.starts_of("robot2"), 0);
    team.drive("robot1").finishes();
    EXPECT_EQ(desk.result_of("go"), "OK");
    desk.execute(drive_to("again", {"9000, 0, 0"}));
    EXPECT_EQ(team.starts_of("robot2"), 1) << "the next command goes to the nearer one";
}

TEST_F(TwoRobots, ResumeNothingWhileIdle) {
    desk.bind("navigation");
    desk.execute(named("resume", command("resume", "navigation")));
    EXPECT_EQ(desk.result_of("resume"), "ERROR");
}

TEST_F(TwoRobots, RefuseTogether) {
    desk.bind("navigation");
    auto const reply = desk.execute(start("navigation"));
    EXPECT_EQ(reply.return_code, ReturnCode::bad_parameter);
    EXPECT_EQ(reply.reason, "command_unit_list[1]: robot1.navigation: the parameter target_position is mandatory");
    auto other = world.connect();
    EXPECT_EQ(other.bind("robot1.navigation"), ReturnCode::ok) << "nothing was kept";
}

TEST_F(TwoRobots, AnswerQueriesByTheOneThatActs) {
    desk.bind("navigation");
    desk.execute(drive_to("go", {"9000, 0, 0"}));
    Results route;
    route.parameters = {Parameter{"length", {"double", {}, {}, {}}, {"7.5"}}};
    world["robot2.navigation"].knows = {route};
    auto const reply = desk.query("route");
    EXPECT_EQ(reply.component_ref.code, "navigation");
    EXPECT_EQ(in_words(reply.results.parameters), "length=7.5");
}

// --- Stopping ---

TEST_F(TwoRobots, StopWithTheLogicalComponent) {
    desk.bind("navigation");
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    team.drive("robot1").halts_later = true;
    desk.execute(named("stop", stop("navigation")));
    EXPECT_EQ(desk.result_of("stop"), "RUNNING");
    team.drive("robot1").stands_still();
    EXPECT_EQ(desk.result_of("stop"), "OK");
    EXPECT_EQ(desk.result_of("go"), "ABORT");
}

TEST_F(TwoRobots, StopAndAreFreeWhenTheirApplicationHasLeft) {
    desk.bind("navigation");
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    team.drive("robot1").calls.clear();
    desk.leave();
    EXPECT_THAT(team.drive("robot1").calls, Contains("halt"));
    auto other = world.connect();
    EXPECT_EQ(other.bind("robot1.navigation"), ReturnCode::ok);
}

TEST_F(TwoRobots, WaitForTheOneThatMovesForAnApplicationThatHasLeft) {
    desk.bind("navigation");
    desk.execute(drive_to("go", {"9000, 0, 0"}));
    team.drive("robot2").halts_later = true;
    desk.leave();
    auto other = world.connect();
    auto const bound = world.begin_to_say(other.session, Bind{Application::identifier("navigation")});
    EXPECT_FALSE(bound->said);
    team.drive("robot2").stands_still();
    EXPECT_TRUE(bound->said);
    other.execute(drive_to("near1", {"1000, 0, 0"}));
    EXPECT_EQ(team.starts_of("robot1"), 1);
}

TEST_F(TwoRobots, ArePausedWithoutSignsOfLife) {
    desk.bind("navigation");
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    world.advance(5s);
    EXPECT_THAT(team.drive("robot1").calls, Contains("suspend"));
    bind(desk, "navigation", Switching::restart);
    team.drive("robot1").finishes(CompletedStatus::error);
    EXPECT_EQ(team.starts_of("robot2"), 0) << "nothing moves for an application that is silent";
}

TEST_F(TwoRobots, StandStillAfterAStopOfEverything) {
    bind(desk, "navigation", Switching::restart);
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    world.engine->stop_everything(world.now);
    EXPECT_EQ(desk.result_of("go"), "ABORT");
    world.advance(1s);
    EXPECT_EQ(team.starts_of("robot2"), 0);
    world.engine->clear();
    EXPECT_EQ(desk.execute(drive_to("again", {"1000, 0, 0"})).return_code, ReturnCode::ok);
    EXPECT_EQ(desk.result_of("again"), "RUNNING");
}

TEST_F(TwoRobots, AreNotChosenIfAllAreLost) {
    desk.bind("navigation");
    world["robot1.navigation"].status_now = ComponentStatus::error;
    world["robot2.navigation"].status_now = ComponentStatus::error;
    team.look();
    EXPECT_EQ(desk.status_of("navigation"), "ERROR");
    EXPECT_EQ(desk.execute(drive_to("go", {"1000, 0, 0"})).return_code, ReturnCode::error);
}

}  // namespace rois::choosing::test
