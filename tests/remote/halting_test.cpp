// Components of a sub engine that must stand still.
#include <algorithm>

#include "remote/two_engines.hpp"

namespace rois {

namespace {

struct HaltingThere : testing::Test {
    TwoEngines engines{{navigation}};
    Application desk = engines.main.connect();

    HaltingThere() {
        engines.bind(desk, "hall.navigation");
        engines.execute(desk, go("go", "hall.navigation"));
        desk.received();
        engines.asked();
    }
    ScriptedComponent& robot() { return engines.hall["navigation"]; }
    auto halts() { return std::ranges::count(robot().calls, "halt"); }
    void stop(std::string const& id) { engines.execute(desk, named(id, rois::stop("hall.navigation"))); }

    // How often the application has received this error since the last call.
    std::ptrdiff_t reports_of(std::string const& error) {
        return std::ranges::count_if(desk.received(), [&](std::string const& words) { return words.find(error) != words.npos; });
    }
};

}  // namespace

TEST_F(HaltingThere, IsAskedForAgainWhileNothingIsAnswered) {
    engines.hold_back(true);
    stop("stop");
    engines.advance(3s);
    EXPECT_EQ(desk.result_of("stop"), "TIMEOUT");
    auto const asked = engines.asked();
    EXPECT_GE(std::ranges::count(asked, "execute"), 3);
    EXPECT_LE(std::ranges::count(asked, "execute"), 7) << "at most twice a second";
    engines.hold_back(false);
    engines.advance(300ms);
    EXPECT_THAT(engines.main.engine->not_halted(), IsEmpty());
    stop("again");
    EXPECT_EQ(desk.result_of("again"), "OK");
}

TEST_F(HaltingThere, ThatFailsEndsTheStopWithErrorAndIsReportedOnce) {
    robot().throws_in = {"halt"};
    stop("stop");
    engines.advance(100ms);
    EXPECT_EQ(desk.result_of("stop"), "ERROR");
    engines.advance(2s);
    EXPECT_EQ(reports_of("COMPONENT_INTERNAL_ERROR hall.navigation"), 1);
    robot().throws_in = {};
    engines.advance(500ms);
    EXPECT_THAT(engines.main.engine->not_halted(), IsEmpty());
}

TEST_F(HaltingThere, ThatIsNotConfirmedIsReportedByOneOfTheEngines) {
    robot().halts_later = true;
    stop("stop");
    engines.advance(1s);
    EXPECT_EQ(desk.result_of("stop"), "TIMEOUT");
    EXPECT_EQ(reports_of("COMPONENT_NOT_RESPONDING hall.navigation"), 1);
}

// It may always take a little longer than the time to confirm, on each of several levels.
TEST_F(HaltingThere, IsKnownAsSoonAsItIsConfirmedLate) {
    robot().halts_later = true;
    stop("stop");
    engines.advance(600ms);
    EXPECT_EQ(desk.result_of("stop"), "TIMEOUT");
    robot().stands_still();
    engines.settle();
    EXPECT_THAT(engines.main.engine->not_halted(), IsEmpty());
    engines.advance(300ms);
    EXPECT_EQ(desk.status_of("hall.navigation"), "READY");
}

TEST_F(HaltingThere, IsAskedForAtOnceIfSomethingHasBegunSince) {
    robot().halts_later = true;
    stop("first");
    engines.advance(700ms);
    engines.inject(Completed{.command_id = {"c2"}, .status = CompletedStatus::ok});  // the repetition of the first, c1
    EXPECT_THAT(engines.main.engine->not_halted(), IsEmpty());
    engines.execute(desk, go("next", "hall.navigation"));
    engines.asked();
    auto const before = halts();
    stop("second");
    EXPECT_EQ(engines.asked(), std::vector<std::string>{"execute"});
    EXPECT_EQ(halts(), before + 1);
}

TEST_F(HaltingThere, IsNotConfirmedByAnEarlierStop) {
    robot().halts_later = true;
    stop("first");
    engines.advance(700ms);
    engines.inject(Completed{.command_id = {"c2"}, .status = CompletedStatus::ok});
    engines.execute(desk, go("next", "hall.navigation"));
    stop("second");
    engines.inject(Completed{.command_id = {"c1"}, .status = CompletedStatus::ok});
    EXPECT_EQ(desk.result_of("second"), "RUNNING");
}

TEST(ATakeOverThere, EndsTheBindingHere) {
    TwoEngines engines{{navigation}};
    auto desk = engines.main.connect();
    engines.bind(desk, "hall.navigation");
    auto chief = engines.hall.connect();
    chief.ask(Bind{Application::identifier("navigation"), Switching::none, true});
    engines.advance(1s);
    EXPECT_EQ(engines.bind(desk, "hall.navigation"), ReturnCode::out_of_resources);
    chief.release("navigation");
    engines.advance(1s);
    EXPECT_EQ(engines.bind(desk, "hall.navigation"), ReturnCode::ok);
}

TEST(NotificationsThatAreLostWithTheLink, EndTheCommandsThatTheyMayHaveBeenAbout) {
    TwoEngines engines{{navigation}};
    auto desk = engines.main.connect();
    engines.bind(desk, "hall.navigation");
    engines.execute(desk, named("go", go("go", "hall.navigation")));
    engines.cut();
    engines.advance(200ms);
    engines.repair();
    engines.advance(1s);
    EXPECT_EQ(desk.result_of("go"), "RUNNING");
    engines.inject(Lost{3});
    engines.advance(2s);
    EXPECT_THAT(desk.result_of("go"), HasSubstr("ABORT"));
    engines.advance(4s);
    EXPECT_EQ(engines.bind(desk, "hall.navigation"), ReturnCode::ok) << "in another session";
    EXPECT_EQ(engines.execute(desk, go("again", "hall.navigation")).return_code, ReturnCode::ok);
}

TEST(HaltingSomethingIdle, ReachesTheComponent) {
    TwoEngines engines{{navigation}};
    auto desk = engines.main.connect();
    engines.bind(desk, "hall.navigation");
    engines.hall["navigation"].calls.clear();
    engines.execute(desk, named("stop", rois::stop("hall.navigation")));
    EXPECT_THAT(engines.hall["navigation"].calls, testing::ElementsAre("halt"));
    EXPECT_EQ(desk.result_of("stop"), "OK");
    engines.ask(desk, Release{Application::identifier("hall.navigation")});
    EXPECT_THAT(engines.hall["navigation"].calls, testing::ElementsAre("halt")) << "it stands still";
}

TEST(HaltingSomethingWithoutStop, ReleasesItAndBindsItAgain) {
    auto part = navigation;
    part.profile.sub_components.clear();
    TwoEngines engines{{part}};
    auto desk = engines.main.connect();
    engines.bind(desk, "hall.navigation");
    engines.execute(desk, named("dock", command("dock", "hall.navigation")));
    engines.asked();
    engines.main.engine->stop_everything(engines.main.now);
    engines.settle();
    EXPECT_THAT(engines.asked(), testing::IsSupersetOf({"release", "bind"}));
    EXPECT_THAT(engines.hall["navigation"].calls, testing::Contains("halt"));
    EXPECT_THAT(engines.main.engine->not_halted(), IsEmpty());
}

TEST_F(HaltingThere, HappensOnceForARelease) {
    engines.ask(desk, Release{Application::identifier("hall.navigation")});
    engines.advance(200ms);
    EXPECT_EQ(halts(), 1);
    EXPECT_EQ(engines.bind(desk, "hall.navigation"), ReturnCode::ok);
}

// So the next application does not find its parameters.
TEST_F(HaltingThere, OfItselfJustBeforeItIsStoppedEndsTheBindingThere) {
    engines.hold_back(true);
    robot().finishes(CompletedStatus::ok, {}, Afterwards::idle);
    engines.ask(desk, Release{Application::identifier("hall.navigation")});
    EXPECT_EQ(engines.asked(), std::vector<std::string>{"execute"}) << "stop";
    engines.hold_back(false);
    engines.settle();
    EXPECT_THAT(engines.asked(), testing::Contains("release"));
}

TEST_F(HaltingThere, EndsIfSomebodyThereHasTakenTheComponentOver) {
    auto chief = engines.hall.connect();
    EXPECT_EQ(chief.ask(Bind{Application::identifier("navigation"), Switching::none, true}).return_code, ReturnCode::ok);
    engines.settle();
    EXPECT_EQ(desk.result_of("go"), "ABORT");
    auto const received = desk.received();
    ASSERT_FALSE(received.empty());
    auto const error = desk.last_received<ReceiveError>();
    EXPECT_THAT(in_words(desk.detail_of(error.error_id).results.parameters), HasSubstr("was taken over by"));
    stop("stop");
    engines.advance(1s);
    EXPECT_THAT(engines.main.engine->not_halted(), IsEmpty()) << "it is not this engine's affair any more";
    EXPECT_EQ(engines.bind(desk, "hall.navigation"), ReturnCode::out_of_resources);
    chief.release("navigation");
    EXPECT_EQ(engines.bind(desk, "hall.navigation"), ReturnCode::ok);
}

TEST_F(HaltingThere, IsReportedAtEachLoss) {
    for (int loss = 0; loss < 3; ++loss) {
        engines.cut();
        engines.advance(3100ms);
        EXPECT_EQ(reports_of("COMPONENT_NOT_RESPONDING hall.navigation"), 1) << "loss " << loss;
        engines.repair();
        engines.advance(5s);
    }
}

}  // namespace rois
