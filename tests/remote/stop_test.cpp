// A stop of everything reaches the sub engines (decision 34).
#include "remote/two_engines.hpp"

namespace rois {

namespace {

struct AStopOfEverything : testing::Test {
    TwoEngines engines{{navigation, speech}};
    // An application of the hall, whose robot it drives.
    Application guard = engines.hall.connect();

    void SetUp() override {
        guard.bind("navigation");
        guard.execute(go("go", "navigation"));
        guard.received();
    }
    ScriptedComponent& robot() { return engines.hall["navigation"]; }
    void stop(World& world) { world.engine->stop_everything(world.now); }
    void clear(World& world) {
        world.engine->clear();
        engines.settle();
    }
    std::vector<std::string> not_halted() const { return engines.main.engine->not_halted(); }
    bool hall_is_stopped() const { return engines.hall.engine->everything_is_stopped(); }
};

}  // namespace

TEST_F(AStopOfEverything, StopsWhatApplicationsOfTheSubEngineHaveBegun) {
    stop(engines.main);
    EXPECT_THAT(not_halted(), testing::Contains("hall.navigation")) << "the hall has not confirmed it yet";
    engines.advance(200ms);
    EXPECT_THAT(guard.received(), testing::Contains(HasSubstr("completed go ABORT")));
    EXPECT_THAT(not_halted(), IsEmpty());
    EXPECT_EQ(guard.execute(go("again", "navigation")).return_code, ReturnCode::error) << "it is stopped there, too";
    clear(engines.main);
    EXPECT_EQ(guard.execute(go("later", "navigation")).return_code, ReturnCode::ok);
}

TEST_F(AStopOfEverything, IsConfirmedWhenTheComponentStandsStill) {
    robot().halts_later = true;
    stop(engines.main);
    engines.advance(400ms);
    EXPECT_THAT(not_halted(), ElementsAre("hall.navigation"));
    robot().stands_still();
    engines.advance(300ms);
    EXPECT_THAT(not_halted(), IsEmpty());
}

TEST_F(AStopOfEverything, ReachesASubEngineWhoseLinkReturns) {
    engines.cut();
    stop(engines.main);
    engines.advance(1s);
    EXPECT_THAT(not_halted(), testing::Contains("hall.navigation"));
    EXPECT_FALSE(hall_is_stopped());
    engines.repair();
    engines.advance(1s);
    EXPECT_TRUE(hall_is_stopped());
    EXPECT_THAT(not_halted(), IsEmpty());
}

TEST_F(AStopOfEverything, DoesNotEndOneOfTheSubEnginesOwn) {
    stop(engines.hall);
    stop(engines.main);
    engines.advance(200ms);
    EXPECT_THAT(not_halted(), IsEmpty());
    clear(engines.main);
    EXPECT_TRUE(hall_is_stopped());
}

TEST_F(AStopOfEverything, DoesNotEndALaterOneOfTheSubEnginesOwn) {
    stop(engines.main);
    engines.advance(200ms);
    stop(engines.hall);
    clear(engines.main);
    EXPECT_TRUE(hall_is_stopped());
}

TEST_F(AStopOfEverything, MayBeClearedWhileTheLinkIsLost) {
    for (auto const lost : {0ms, 5'000ms}) {  // 5 s: the session is given up
        stop(engines.main);
        engines.advance(200ms);
        engines.cut();
        engines.advance(lost);
        clear(engines.main);
        engines.repair();
        engines.advance(10s);
        EXPECT_FALSE(hall_is_stopped()) << lost.count() << " ms";
    }
}

TEST_F(AStopOfEverything, MayBeClearedBeforeItsAnswerHasCome) {
    engines.hold_back(true);
    stop(engines.main);
    engines.settle();
    clear(engines.main);
    EXPECT_TRUE(hall_is_stopped());
    engines.hold_back(false);
    engines.advance(1s);
    EXPECT_FALSE(hall_is_stopped());
}

TEST_F(AStopOfEverything, MayBeClearedWhenItsAnswerWasLost) {
    engines.hold_back(true);
    stop(engines.main);
    engines.settle();
    engines.cut();
    clear(engines.main);
    engines.repair();
    engines.hold_back(false);
    engines.advance(10s);
    EXPECT_FALSE(hall_is_stopped());
}

TEST_F(AStopOfEverything, IsClearedThereAfterTheMainEngineHasDied) {
    engines.main.keep_journal();
    stop(engines.main);
    engines.advance(200ms);
    engines.cut();
    clear(engines.main);
    engines.restart_main();
    engines.advance(10s);
    EXPECT_FALSE(hall_is_stopped());
}

TEST_F(AStopOfEverything, IsClearedThereWhenItsAnswerWasLostAndTheSessionThereHasEnded) {
    engines.hold_back(true);
    stop(engines.main);
    engines.settle();
    engines.cut();
    clear(engines.main);
    engines.hold_back(false);
    engines.advance(31s);
    engines.repair();
    engines.advance(31s);
    EXPECT_FALSE(hall_is_stopped());
}

TEST_F(AStopOfEverything, IsClearedThereAfterTheMainEngineHasDiedAndTheSessionThereHasEnded) {
    engines.main.keep_journal();
    for (bool const is_answered : {true, false}) {
        engines.hold_back(!is_answered);
        stop(engines.main);
        engines.advance(200ms);
        EXPECT_TRUE(hall_is_stopped());
        engines.cut();
        clear(engines.main);
        engines.hold_back(false);
        engines.restart_main([&] { engines.hall.advance(31s); });
        engines.advance(10s);
        EXPECT_FALSE(hall_is_stopped()) << is_answered;
    }
}

// A halt is not stored, and the next start is not stopped.
TEST_F(AStopOfEverything, IsClearedThereIfItWasTheHaltOfAGatewayThatCouldNotGoOn) {
    engines.main.keep_journal();
    stop(engines.main);
    engines.advance(200ms);
    clear(engines.main);
    engines.advance(200ms);
    EXPECT_FALSE(hall_is_stopped());
    engines.main.journal->then = MemoryJournal::Then::not_stored;  // from now on
    engines.main.engine->halt_everything(engines.main.now);
    engines.settle();
    EXPECT_TRUE(hall_is_stopped());
    engines.cut();
    engines.restart_main([&] { engines.hall.advance(31s); });
    engines.advance(10s);
    EXPECT_FALSE(engines.main.engine->everything_is_stopped());
    EXPECT_FALSE(hall_is_stopped());
}

TEST_F(AStopOfEverything, IsClearedOnceTheHallCanBeUsedAgain) {
    std::string const instance = engines.instance_of_main;
    stop(engines.main);
    engines.advance(200ms);
    engines.cut();
    engines.instance_of_main = "instance1";  // a loop: each new session there is given up at once
    engines.repair();
    engines.advance(10s);
    clear(engines.main);
    engines.instance_of_main = instance;
    engines.advance(60s);
    EXPECT_FALSE(hall_is_stopped());
}

TEST_F(AStopOfEverything, DoesNotReachASubEngineAfterItWasCleared) {
    engines.hold_back(true);  // the request is lost
    stop(engines.main);
    engines.settle();
    engines.cut();
    clear(engines.main);
    engines.restart_hall();
    auto application = engines.hall.connect();
    application.bind("navigation");
    application.execute(go("go", "navigation"));
    engines.hold_back(false);
    engines.repair();
    engines.advance(31s);
    EXPECT_FALSE(hall_is_stopped());
    EXPECT_EQ(application.result_of("go"), "RUNNING");
}

TEST_F(AStopOfEverything, LastsThereWhenTheMainEngineHasDied) {
    engines.main.keep_journal();
    stop(engines.main);
    engines.advance(200ms);
    engines.restart_main();
    engines.advance(10s);
    EXPECT_TRUE(hall_is_stopped());
    clear(engines.main);
    engines.advance(1s);
    EXPECT_FALSE(hall_is_stopped());
}

TEST_F(AStopOfEverything, DoesNotEndOneThatARestartedSubEngineHas) {
    stop(engines.main);
    engines.advance(200ms);
    engines.cut();
    clear(engines.main);
    engines.restart_hall();
    stop(engines.hall);
    engines.repair();
    engines.advance(10s);
    EXPECT_TRUE(hall_is_stopped());
}

// A component program does not know the request.
TEST_F(AStopOfEverything, NeedsNoAnswerFromASubEngineThatHasNoApplications) {
    engines.falsify = [](Reply& reply) {
        if (auto* stopped = std::get_if<StopEverything::Reply>(&reply)) stopped->return_code = ReturnCode::unsupported;
    };
    stop(engines.main);
    engines.advance(200ms);
    EXPECT_THAT(not_halted(), IsEmpty());
}

}  // namespace rois
