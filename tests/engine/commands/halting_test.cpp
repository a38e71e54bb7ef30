// Decision 35: `stop` always reaches the component, and returns OK only when that stands still.
#include "engine/asynchronous.hpp"
#include "engine/trace.hpp"
#include "engine/world.hpp"

namespace rois {

namespace {

class Halting : public testing::Test {
protected:
    Halting() { desk.bind("navigation"); }

    auto halts() { return std::ranges::count(robot.calls, "halt"); }

    World world{navigation, speech};
    ScriptedComponent& robot = world["navigation"];
    Application desk = world.connect();
};

}  // namespace

TEST_F(Halting, IsTheFirstCallToEveryComponent) {
    robot.halts_later = true;
    world.engine->begin(world.now);
    EXPECT_THAT(world["speech"].calls, ElementsAre("halt"));
    EXPECT_THAT(world.engine->not_halted(), ElementsAre("navigation"));
    desk.execute(go("go"));
    EXPECT_THAT(robot.calls, ElementsAre("halt")) << "nothing starts before";
    robot.stands_still();
    EXPECT_THAT(robot.calls, ElementsAre("halt", "start"));
}

TEST_F(Halting, IsTheFirstCallToANewComponent) {
    world.change({}, {named("arm", navigation)});
    EXPECT_THAT(world["arm"].calls, ElementsAre("halt"));
}

TEST_F(Halting, StopReachesACommandOfTheComponentsOwn) {
    desk.execute(named("dock", command("dock", "navigation")));
    desk.execute(named("stop", stop("navigation")));
    EXPECT_THAT(robot.calls, ElementsAre("dock", "halt"));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed dock ABORT", "2 completed stop OK"));
    EXPECT_EQ(desk.reason_of("dock"), "it was stopped");
    robot.finishes();
    EXPECT_EQ(world.stray_answers(), 1) << "the command has ended already";
}

TEST_F(Halting, SuspendReachesACommandOfTheComponentsOwn) {
    desk.execute(named("dock", command("dock", "navigation")));
    desk.execute(named("hold", suspend("navigation")));
    desk.execute(named("on", resume("navigation")));
    robot.finishes();
    desk.execute(named("over", suspend("navigation")));
    EXPECT_THAT(robot.calls, ElementsAre("dock", "suspend", "resume"));
    EXPECT_THAT(desk.received(),
                ElementsAre("1 completed hold OK", "2 completed on OK", "3 completed dock OK", "4 completed over ERROR"));
}

TEST_F(Halting, ThatFailsMakesStopFailAndTheStatusError) {
    robot.throws_in = {"halt"};
    desk.execute(go("go"));
    desk.execute(named("stop", stop("navigation")));
    EXPECT_THAT(desk.received(),
                ElementsAre("1 completed go ABORT", "2 completed stop ERROR", "3 COMPONENT_INTERNAL_ERROR navigation"));
    EXPECT_THAT(desk.reason_of("stop"), HasSubstr("failed to halt"));
    EXPECT_EQ(desk.status_of("navigation"), "ERROR");
    desk.query("route");
    EXPECT_EQ(desk.status_of("navigation"), "ERROR") << "a successful query does not clear it";
}

TEST_F(Halting, ThatFailsIsRepeatedUntilItSucceeds) {
    robot.throws_in = {"halt"};
    desk.execute(named("stop", stop("navigation")));
    desk.received();
    world.advance(1s);
    EXPECT_EQ(halts(), 1 + 5) << "every 0.2 s";
    EXPECT_THAT(desk.received(), IsEmpty()) << "it is reported once";
    robot.throws_in = {};
    world.advance(200ms);
    EXPECT_EQ(desk.status_of("navigation"), "READY");
    EXPECT_EQ(halts(), 7);
    world.advance(1s);
    EXPECT_EQ(halts(), 7);
}

TEST_F(Halting, ThatFailsPreventsStarts) {
    robot.throws_in = {"halt"};
    desk.execute(named("stop", stop("navigation")));
    desk.execute(go("go"), named("dock", command("dock", "navigation")));
    desk.execute(named("on", resume("navigation")));
    EXPECT_THAT(robot.calls, ElementsAre("halt"));
    desk.received();
    EXPECT_EQ(desk.result_of("go"), "ERROR");
    EXPECT_THAT(desk.reason_of("go"), HasSubstr("failed to halt"));
    robot.throws_in = {};
    desk.execute(named("stop 2", stop("navigation")));
    desk.execute(go("go 2"));
    EXPECT_THAT(robot.calls, ElementsAre("halt", "halt", "start"));
    EXPECT_EQ(desk.result_of("stop 2"), "OK");
}

TEST_F(Halting, ThatFailsPreventsBinding) {
    robot.throws_in = {"halt"};
    desk.execute(go("go"));
    desk.leave();
    auto hall = world.connect();
    EXPECT_EQ(hall.status_of("navigation"), "ERROR");
    EXPECT_EQ(hall.bind("navigation"), ReturnCode::error);
    EXPECT_EQ(hall.bind_any(equal("component_ref", "navigation")), "OUT_OF_RESOURCES");
    EXPECT_EQ(hall.bind_any(), "speech");
    robot.throws_in = {};
    world.advance(200ms);
    EXPECT_EQ(hall.bind("navigation"), ReturnCode::ok);
}

TEST_F(Halting, ThatFailsLetsNotEvenTheHolderBind) {
    robot.throws_in = {"halt"};
    desk.execute(named("stop", stop("navigation")));
    EXPECT_EQ(desk.bind("navigation"), ReturnCode::error);
    EXPECT_EQ(desk.bind_any(equal("component_ref", "navigation")), "OUT_OF_RESOURCES");
    robot.throws_in = {};
    world.advance(200ms);
    EXPECT_EQ(desk.bind("navigation"), ReturnCode::ok);
    EXPECT_EQ(desk.bind_any(equal("component_ref", "navigation")), "navigation");
}

TEST_F(Halting, IsConfirmedLater) {
    robot.halts_later = true;
    desk.execute(go("go"));
    desk.execute(named("stop", stop("navigation")));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go ABORT"));
    EXPECT_EQ(desk.result_of("stop"), "RUNNING");
    world.advance(450ms);
    robot.stands_still();
    EXPECT_THAT(desk.received(), ElementsAre("2 completed stop OK"));
    world.advance(1s);
    EXPECT_EQ(halts(), 1);
    EXPECT_EQ(desk.status_of("navigation"), "READY");
}

TEST_F(Halting, ThatIsNotConfirmedIsATimeout) {
    robot.halts_later = true;
    desk.execute(go("go"));
    desk.execute(named("stop", stop("navigation")));
    desk.received();
    world.advance(500ms);
    EXPECT_THAT(desk.received(), ElementsAre("2 completed stop TIMEOUT", "3 COMPONENT_NOT_RESPONDING navigation"));
    EXPECT_EQ(desk.status_of("navigation"), "ERROR");
    world.advance(400ms);
    EXPECT_EQ(halts(), 3);
    robot.stands_still();
    EXPECT_EQ(desk.status_of("navigation"), "READY");
    world.advance(1s);
    EXPECT_EQ(halts(), 3);
}

TEST_F(Halting, AStartThatTakesThePlaceOfAnotherOneWaitsForIt) {
    desk.execute(go("go"));
    robot.halts_later = true;
    desk.execute(go("go 2"));
    EXPECT_THAT(robot.calls, ElementsAre("start", "halt"));
    robot.stands_still();
    EXPECT_THAT(robot.calls, ElementsAre("start", "halt", "start"));
    EXPECT_EQ(desk.result_of("go 2"), "RUNNING");
}

TEST_F(Halting, AStartThatWaitsForItIsStoppedToo) {
    desk.execute(go("go"));
    robot.halts_later = true;
    desk.execute(go("go 2"));
    desk.execute(named("stop", stop("navigation")));
    robot.stands_still();
    EXPECT_THAT(robot.calls, ElementsAre("start", "halt", "halt"));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go ABORT", "2 completed go 2 ABORT", "3 completed stop OK"));
}

TEST_F(Halting, AtTheEndOfASessionReachesAnIdleComponent) {
    desk.leave();
    EXPECT_THAT(robot.calls, ElementsAre("halt"));
}

TEST_F(Halting, AtTheEndOfASessionIsRepeatedUntilItIsConfirmed) {
    robot.halts_later = true;
    desk.execute(go("go"));
    desk.leave();
    auto hall = world.connect();
    world.advance(700ms);
    EXPECT_EQ(halts(), 2);
    EXPECT_EQ(hall.bind("navigation"), ReturnCode::error);
    robot.stands_still();
    EXPECT_EQ(hall.bind("navigation"), ReturnCode::ok);
}

TEST_F(Halting, ThatIsUnderWayDelaysTheNextBinding) {
    robot.halts_later = true;
    desk.execute(go("go"));
    desk.leave();
    auto hall = world.connect();
    auto const bound = world.begin_to_say(hall.session, Bind{Application::identifier("navigation")});
    EXPECT_FALSE(bound->said) << "the robot may still move";
    auto kitchen = world.connect();
    auto const late = world.begin_to_say(kitchen.session, Bind{Application::identifier("navigation")});
    robot.stands_still();
    EXPECT_EQ(code_of(*bound), ReturnCode::ok);
    EXPECT_EQ(code_of(*late), ReturnCode::out_of_resources);
    hall.execute(go("go"));
    EXPECT_THAT(robot.calls, ElementsAre("start", "halt", "parameters_changed", "start"));
}

TEST_F(Halting, ThatIsUnderWayDelaysTheNextBindAny) {
    robot.halts_later = true;
    desk.release("navigation");
    auto hall = world.connect();
    auto const bound = world.begin_to_say(hall.session, BindAny{});
    EXPECT_FALSE(bound->said) << "navigation is preferred to speech, also if it is not quite free yet";
    robot.stands_still();
    EXPECT_EQ(std::get<BindAny::Reply>(std::get<Reply>(bound->said.value())).component_ref.code, "navigation");
}

TEST_F(Halting, ThatIsUnderWayAndFailsRefusesTheBindingsThatWaitForIt) {
    robot.halts_later = true;
    desk.release("navigation");
    auto hall = world.connect();
    auto const bound = world.begin_to_say(hall.session, Bind{Application::identifier("navigation")});
    auto const any = world.begin_to_say(hall.session, BindAny{});
    world.advance(500ms);
    EXPECT_EQ(code_of(*bound), ReturnCode::error);
    EXPECT_EQ(std::get<BindAny::Reply>(std::get<Reply>(any->said.value())).component_ref.code, "speech") << reason_of(*any);
}

TEST_F(Halting, OfAComponentThatLeavesRefusesTheBindingsThatWaitForIt) {
    robot.halts_later = true;
    desk.release("navigation");
    auto hall = world.connect();
    auto const bound = world.begin_to_say(hall.session, Bind{Application::identifier("navigation")});
    world.change({"navigation"}, {});
    EXPECT_EQ(code_of(*bound), ReturnCode::bad_parameter);
}

TEST_F(Halting, ThatIsUnderWayAndFailsEndsTheCommandsThatWaitForIt) {
    robot.halts_later = true;
    desk.execute(go("go"));
    desk.execute(named("stop", stop("navigation")));
    desk.execute(named("dock", command("dock", "navigation")));
    desk.execute(go("go 2"));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go ABORT"));
    world.advance(500ms);
    EXPECT_THAT(desk.received(), ElementsAre("2 completed stop TIMEOUT", "3 completed dock TIMEOUT", "4 completed go 2 TIMEOUT",
                                             "5 COMPONENT_NOT_RESPONDING navigation"));
}

TEST_F(Halting, ASecondStopEndsTheCommandsThatWaitForTheFirst) {
    robot.halts_later = true;
    desk.execute(go("go"));
    desk.execute(named("stop", stop("navigation")));
    desk.execute(named("dock", command("dock", "navigation")));
    desk.execute(named("stop 2", stop("navigation")));
    robot.stands_still();
    EXPECT_THAT(desk.received(),
                ElementsAre("1 completed go ABORT", "2 completed dock ABORT", "3 completed stop OK", "4 completed stop 2 OK"));
    EXPECT_THAT(robot.calls, ElementsAre("start", "halt", "halt"));
}

TEST_F(Halting, ThatIsUnderWayLeavesTheEngineReadyUnlessItFails) {
    world.engine->begin(world.now);
    robot.halts_later = true;
    desk.execute(go("go"));
    desk.execute(named("stop", stop("navigation")));
    EXPECT_THAT(world.engine->not_halted(), ElementsAre("navigation"));
    EXPECT_THAT(world.engine->not_ready(), IsEmpty());
    world.engine->stop_everything(world.now);
    EXPECT_THAT(world.engine->not_ready(), ElementsAre("navigation"));
    world.engine->clear();
    EXPECT_THAT(world.engine->not_ready(), IsEmpty());
    world.advance(500ms);
    EXPECT_THAT(world.engine->not_ready(), ElementsAre("navigation"));
    robot.stands_still();
    EXPECT_THAT(world.engine->not_ready(), IsEmpty());
}

TEST_F(Halting, IsAwaitedOnceBeforeTheEngineIsReady) {
    robot.halts_later = true;
    world.engine->begin(world.now);
    EXPECT_THAT(world.engine->not_ready(), ElementsAre("navigation"));
    robot.stands_still();
    EXPECT_THAT(world.engine->not_ready(), IsEmpty());
}

TEST_F(Halting, AtTheEndOfTheEngineReachesEveryComponent) {
    world.engine->shut_down(world.now);
    EXPECT_GE(halts(), 1);
    EXPECT_THAT(world["speech"].calls, ElementsAre("halt"));
}

TEST_F(Halting, OfEverythingReachesEveryComponentAndLetsNothingStart) {
    auto hall = world.connect();
    hall.bind("speech");
    hall.execute(say("say"));
    desk.execute(go("go"), after(1s, go("later")));
    world.engine->stop_everything(world.now);
    EXPECT_THAT(robot.calls, ElementsAre("start", "halt"));
    EXPECT_THAT(world["speech"].calls, ElementsAre("start", "halt"));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go ABORT", "2 completed later ABORT", "3 USER_DEFINED_ERROR"));
    EXPECT_THAT(hall.received(), ElementsAre("1 completed say ABORT", "2 USER_DEFINED_ERROR"));
    for (auto const& unit : {go("again"), command("dock", "navigation"), resume("navigation")}) {
        auto const reply = desk.execute(stop("navigation"), unit);
        EXPECT_EQ(reply.return_code, ReturnCode::error);
        EXPECT_THAT(reply.reason, HasSubstr("everything was stopped"));
    }
    EXPECT_EQ(desk.execute(stop("navigation")).return_code, ReturnCode::ok);
    world.advance(5s);
    EXPECT_THAT(robot.calls, ElementsAre("start", "halt", "halt"));
    auto later = world.connect();
    EXPECT_THAT(later.received(), ElementsAre("1 USER_DEFINED_ERROR"));
    world.engine->clear();
    EXPECT_EQ(desk.execute(go("again")).return_code, ReturnCode::ok);
    EXPECT_THAT(robot.calls, ElementsAre("start", "halt", "halt", "start"));
}

TEST_F(Halting, OfEverythingIsReportedToASessionOnceASecondAtMost) {
    for (int i = 0; i < 2'000; ++i) {
        world.engine->stop_everything(world.now);
        world.engine->clear();
    }
    EXPECT_THAT(desk.received(), ElementsAre("1 USER_DEFINED_ERROR"));
    world.advance(1s);
    world.engine->stop_everything(world.now);
    EXPECT_THAT(desk.received(), ElementsAre("2 USER_DEFINED_ERROR"));
}

TEST_F(Halting, OfEverythingIsReportedALittleLaterIfTheLastReportWasJustBefore) {
    world.engine->stop_everything(world.now);
    world.engine->clear();
    world.engine->stop_everything(world.now);
    EXPECT_THAT(desk.received(), ElementsAre("1 USER_DEFINED_ERROR"));
    world.advance(1s);
    EXPECT_THAT(desk.received(), ElementsAre("2 USER_DEFINED_ERROR"));
    world.advance(5s);
    EXPECT_THAT(desk.received(), IsEmpty());
}

TEST_F(Halting, OfEverythingIsAnOperationToo) {
    desk.execute(go("go"));
    auto const stopped = desk.ask(StopEverything{});
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go ABORT", "2 USER_DEFINED_ERROR"));
    EXPECT_TRUE(world.engine->everything_is_stopped());
    auto const again = desk.ask(StopEverything{});
    EXPECT_THAT(again.not_halted, IsEmpty());
    EXPECT_EQ(again.stop, stopped.stop) << "the first answer may have been lost";
    EXPECT_THAT(robot.calls, ElementsAre("start", "halt")) << "the same session only asks how far it is";
    auto other = world.connect();
    other.ask(ClearStop{ClearStop::own});
    EXPECT_TRUE(world.engine->everything_is_stopped()) << "it has none";
    desk.ask(ClearStop{ClearStop::own});
    EXPECT_FALSE(world.engine->everything_is_stopped());
}

TEST(AStopOfEverything, MayEndTheSessionThatAsksForIt) {
    EngineSettings settings;
    settings.max_waiting_notifications = 3;
    World world{{navigation}, settings};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.execute(in_sequence({after(10s, go("1")), go("2"), go("3")}));
    desk.ask(StopEverything{});
    EXPECT_TRUE(desk.notifications_closed()) << "three completions and an error do not fit";
    auto other = world.connect();
    auto const stopped = other.ask(StopEverything{});
    ASSERT_TRUE(stopped.stop);
    other.ask(ClearStop{*stopped.stop});
    EXPECT_FALSE(world.engine->everything_is_stopped()) << "it has taken the place of the one that has ended";
}

TEST_F(Halting, OfEverythingByTwoSessionsEndsWhenBothHaveClearedIt) {
    auto hall = world.connect();
    auto const first = desk.ask(StopEverything{});
    auto const second = hall.ask(StopEverything{});
    desk.ask(ClearStop{first.stop.value()});
    EXPECT_TRUE(world.engine->everything_is_stopped());
    hall.ask(ClearStop{second.stop.value()});
    EXPECT_FALSE(world.engine->everything_is_stopped());
}

TEST_F(Halting, OfEverythingByASessionThatHasEndedIsNotClearedByAnother) {
    auto hall = world.connect();
    auto const first = desk.ask(StopEverything{});
    auto const second = hall.ask(StopEverything{});
    desk.leave();
    hall.ask(ClearStop{second.stop.value()});
    EXPECT_TRUE(world.engine->everything_is_stopped());
    auto successor = world.connect();
    successor.ask(ClearStop{first.stop.value()});
    EXPECT_FALSE(world.engine->everything_is_stopped());
}

TEST_F(Halting, OfEverythingIsClearedByASessionThatAskedForItAgain) {
    auto hall = world.connect();
    desk.ask(StopEverything{});
    auto const second = hall.ask(StopEverything{});
    desk.leave();
    auto successor = world.connect();
    auto const again = successor.ask(StopEverything{});
    successor.ask(ClearStop{again.stop.value()});
    EXPECT_TRUE(world.engine->everything_is_stopped());
    hall.ask(ClearStop{second.stop.value()});
    EXPECT_FALSE(world.engine->everything_is_stopped());
}

TEST_F(Halting, OfEverythingByTheOperatorIsClearedByNoSession) {
    auto hall = world.connect();
    auto const first = desk.ask(StopEverything{});
    world.engine->stop_everything(world.now);
    EXPECT_FALSE(hall.ask(StopEverything{}).stop);
    EXPECT_FALSE(desk.ask(StopEverything{}).stop);
    desk.ask(ClearStop{first.stop.value()});
    EXPECT_TRUE(world.engine->everything_is_stopped());
}

TEST_F(Halting, ThatFailsIsReportedOnceUntilItSucceeds) {
    struct Halts : Trace {
        std::vector<std::string> said;
        void halt_failed(std::string const& ref, std::string_view why) override {
            said.push_back(ref + " failed: " + std::string{why});
        }
        void halted_at_last(std::string const& ref) override { said.push_back(ref + " halted"); }
    } trace;
    world.engine->report_to(trace);
    robot.throws_in = {"halt"};
    desk.execute(named("stop", stop("navigation")));
    world.advance(1s);
    robot.throws_in = {};
    world.advance(200ms);
    desk.execute(named("again", stop("navigation")));
    EXPECT_THAT(trace.said, ElementsAre("navigation failed: the component failed to halt", "navigation halted"));
}

TEST_F(Halting, OfEverythingReportsTheComponentsThatHaveNotConfirmed) {
    robot.halts_later = true;
    world.engine->stop_everything(world.now);
    EXPECT_THAT(world.engine->not_halted(), ElementsAre("navigation"));
    robot.stands_still();
    EXPECT_THAT(world.engine->not_halted(), IsEmpty());
}

TEST_F(Halting, OfEverythingGoesOnWhenOneComponentFails) {
    robot.throws_in = {"halt"};
    world["speech"].throws_in = {"halt"};
    world.engine->stop_everything(world.now);
    EXPECT_THAT(world.engine->not_halted(), ElementsAre("navigation", "speech"));
}

TEST_F(Halting, EndsWithAComponentThatGoes) {
    robot.halts_later = true;
    desk.execute(go("go"));
    desk.execute(named("stop", stop("navigation")));
    world.change({"navigation"}, {});
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go ABORT", "2 completed stop ABORT", "3 profile_changed"));
    world.advance(1s);
}

TEST_F(Halting, UnexpectedConfirmationsAreCounted) {
    robot.stands_still();
    EXPECT_EQ(world.stray_answers(), 1);
}

}  // namespace rois
