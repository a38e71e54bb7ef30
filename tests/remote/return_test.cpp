// What a sub engine restores when its session, or one of its components, returns.
#include <optional>

#include "remote/two_engines.hpp"

namespace rois {

namespace {

Part driving() {
    auto part = navigation;
    part.moves = true;
    return part;
}

struct ReturningSubEngines : testing::Test {
    TwoEngines engines{{driving(), speech}};
    Application desk = engines.main.connect();

    void SetUp() override { engines.bind(desk, "hall.navigation"); }
    ScriptedComponent& robot() { return engines.hall["navigation"]; }
    ReturnCode drive(std::string const& id) { return engines.execute(desk, go(id, "hall.navigation")).return_code; }
    // The sub engine returns while one of its own applications has bound the component.
    Application return_bound_by_another() {
        auto other = engines.hall.connect();
        engines.cut();
        engines.advance(4s);
        other.bind("navigation");
        engines.repair();
        engines.advance(3s);
        return other;
    }
    void limit(std::string const& time) {
        engines.execute(desk, command("set_parameter", "hall.navigation", {value("time_limit", "int", {time})}));
    }
};

}  // namespace

// The sub engine ends the session, because there are no signs of life, and keeps the link.
TEST_F(ReturningSubEngines, HaveANewSessionIfThisEngineHung) {
    drive("go");
    desk.subscribe("reached_target");
    engines.main_is_alive = engines.main_answers_pings = false;
    engines.advance(6s);
    EXPECT_THAT(robot().calls, testing::Contains("halt"));
    engines.main_is_alive = engines.main_answers_pings = true;
    engines.advance(2s);
    EXPECT_THAT(desk.received(), testing::Contains(HasSubstr("completed go ABORT")));
    EXPECT_THAT(engines.reported, testing::Contains("its session has ended"));
    EXPECT_EQ(drive("again"), ReturnCode::ok) << "the binding is restored";
    robot().fires("reached_target", {value("is_final_target", "bool", {"true"})});
    engines.settle();
    EXPECT_THAT(desk.received(), testing::Contains(HasSubstr("reached_target hall.navigation")));
    auto const sessions = engines.hall.engine->statistics().each_session;
    EXPECT_THAT(sessions, testing::SizeIs(1)) << "the one that was opened by a sign of life has ended";
}

TEST_F(ReturningSubEngines, AreAskedForABindingUntilTheyGiveIt) {
    auto guard = return_bound_by_another();
    EXPECT_EQ(drive("early"), ReturnCode::error);
    guard.release("navigation");
    engines.advance(2s);
    EXPECT_EQ(drive("later"), ReturnCode::ok);
}

TEST_F(ReturningSubEngines, AreAskedAgainIfAnApplicationBindsAgain) {
    auto guard = return_bound_by_another();
    EXPECT_EQ(engines.bind(desk, "hall.navigation"), ReturnCode::out_of_resources);
    guard.release("navigation");
    EXPECT_EQ(engines.bind(desk, "hall.navigation"), ReturnCode::ok);
    EXPECT_EQ(drive("later"), ReturnCode::ok);
}

TEST_F(ReturningSubEngines, KeepTheParametersOfWhatRunsIfTheirProfileChanges) {
    limit("7000");
    drive("go");
    robot().changed_to.clear();
    engines.hall.change({"speech"}, {});
    engines.advance(2s);
    EXPECT_THAT(desk.search(), ElementsAre("hall.navigation"));
    EXPECT_THAT(robot().changed_to, IsEmpty());
}

TEST_F(ReturningSubEngines, HaveTheLastParametersOfStart) {
    limit("7000");
    engines.execute(desk, named("go", start("hall.navigation", {value("target_position", "string[]", {"b"}),
                                                                value("time_limit", "int", {"8000"})})));
    EXPECT_EQ(desk.result_of("go"), "RUNNING");
    engines.cut();
    engines.advance(4s);
    engines.repair();
    engines.advance(5s);
    ASSERT_NE(find(robot().changed_to, "time_limit"), nullptr);
    EXPECT_THAT(find(robot().changed_to, "time_limit")->values, ElementsAre("8000"));
}

TEST(AMotionThatASubEngineHolds, GoesOnWithResume) {
    auto part = navigation;
    part.moves = true;
    TwoEngines engines{{part}};
    auto desk = engines.main.connect();
    auto const& calls = engines.hall["navigation"].calls;
    engines.bind(desk, "hall.navigation");
    engines.execute(desk, go("go", "hall.navigation"));
    engines.execute(desk, named("early", command("resume", "hall.navigation")));
    EXPECT_EQ(desk.result_of("early"), "ERROR");
    EXPECT_THAT(calls, testing::Not(testing::Contains("halt"))) << "it goes on";
    auto const pass = [&](std::chrono::milliseconds time) {
        for (auto passed = 0ms; passed < time; passed += 100ms) {
            engines.main.engine->note_pong(desk.session, engines.main.now);
            engines.advance(100ms);
        }
    };
    engines.cut();
    pass(1500ms);
    EXPECT_THAT(calls, testing::Contains("suspend"));
    engines.repair();
    pass(1s);
    engines.execute(desk, named("resume", command("resume", "hall.navigation")));
    EXPECT_EQ(desk.result_of("resume"), "OK");
    EXPECT_THAT(calls, testing::Contains("resume"));
}

// An engine that joins would come again only after a while.
TEST(ASubEngineThatReturnsAfterTheWindow, GetsANewSessionOnTheSameLink) {
    TwoEngines engines{{navigation}};
    auto desk = engines.main.connect();
    engines.bind(desk, "hall.navigation");
    engines.cut();
    engines.advance(4s);
    engines.repair();
    engines.asked();
    auto const links = engines.links;
    engines.advance(5s);
    EXPECT_EQ(engines.links, links + 1);
    EXPECT_EQ(desk.status_of("hall.navigation"), "READY");
    EXPECT_THAT(engines.asked(), testing::IsSupersetOf({"resume", "connect", "bind"}));
}

// The disk has just stored the new session when the window of the earlier one ends.
TEST(ASubEngineThatReturnsAtTheEndOfTheWindow, IsUsedAgain) {
    TwoEngines engines{{navigation}};
    auto& journal = (engines.main.keep_journal(), *engines.main.journal);
    auto desk = engines.main.connect();
    engines.cut();
    engines.hall.restart({navigation});
    engines.advance(2'500ms);
    journal.then = MemoryJournal::Then::later;
    engines.repair();
    engines.advance(450ms);
    ASSERT_TRUE(journal.has_waiting());
    journal.settle(true);
    engines.main.engine->and_work([&] { engines.main.engine->stored(engines.main.now); }, engines.main.now);
    journal.then = MemoryJournal::Then::stored;
    engines.advance(5s);
    EXPECT_EQ(engines.bind(desk, "hall.navigation"), ReturnCode::ok);
    EXPECT_EQ(engines.execute(desk, go("go", "hall.navigation")).return_code, ReturnCode::ok);
    EXPECT_EQ(desk.status_of("hall.navigation"), "READY") << "for its owner";
}

// The main engine has died, and the hall has not.
struct AMainEngineThatHasDied : testing::Test {
    AMainEngineThatHasDied() {
        engines.main.keep_journal();
        desk.emplace(engines.main.connect());
        for (auto const* ref : {"hall.navigation", "hall.speech"}) engines.bind(*desk, ref);
    }
    Application resumed() {
        Application again{engines.main, desk->session};
        engines.main.engine->link_opened(desk->session, LinkKind::websocket, engines.main.now);
        engines.settle();
        return again;
    }

    TwoEngines engines{{navigation, speech}};
    std::optional<Application> desk;
};

TEST_F(AMainEngineThatHasDied, LearnsHowItsCommandsHaveEnded) {
    engines.execute(*desk, named("d", command("dock", "hall.navigation")));
    engines.execute(*desk, say("s", "hall.speech"));
    auto const answer = engines.hall["navigation"].latest();
    engines.restart_main([&] { engines.hall["navigation"].answers(answer); });
    auto again = resumed();
    engines.advance(1s);
    EXPECT_THAT(again.received(), testing::IsSupersetOf({HasSubstr("completed d OK"), HasSubstr("completed s ABORT")}));
    EXPECT_EQ(again.result_of("d"), "OK");
    EXPECT_THAT(engines.hall["speech"].calls, testing::Contains("halt")) << "nothing goes on in the earlier session";
}

TEST_F(AMainEngineThatHasDied, HasItsBindingsAgain) {
    engines.restart_main();
    auto again = resumed();
    auto other = engines.main.connect();
    engines.advance(1s);
    EXPECT_EQ(engines.bind(other, "hall.navigation"), ReturnCode::out_of_resources);
    EXPECT_EQ(engines.execute(again, go("go", "hall.navigation")).return_code, ReturnCode::ok);
    EXPECT_EQ(engines.hall.connect().bind("navigation"), ReturnCode::out_of_resources) << "also there";
}

TEST_F(AMainEngineThatHasDied, TellsWhoHasLostABindingMeanwhile) {
    std::optional<Application> other;
    engines.restart_main([&] {
        engines.hall.advance(31s);
        other.emplace(engines.hall.connect());
        EXPECT_EQ(other->bind("navigation"), ReturnCode::ok);
    });
    auto again = resumed();
    engines.advance(1s);
    EXPECT_THAT(again.received(), testing::Contains(HasSubstr("USER_DEFINED_ERROR")));
}

TEST_F(AMainEngineThatHasDied, RestoresTheParametersThatItsApplicationsHaveSet) {
    engines.execute(*desk, command("set_parameter", "hall.navigation", {value("time_limit", "int", {"7000"})}));
    engines.hall["navigation"].changed_to.clear();
    engines.restart_main();
    auto again = resumed();
    engines.advance(1s);
    EXPECT_THAT(in_words(again.get_parameter("hall.navigation").parameters), HasSubstr("time_limit=7000"));
    EXPECT_THAT(in_words(engines.hall["navigation"].changed_to), HasSubstr("time_limit=7000")) << "also there";
}

TEST_F(AMainEngineThatHasDied, EndsItsCommandsIfTheHallHasDiedToo) {
    engines.execute(*desk, say("s", "hall.speech"));
    engines.restart_main([&] { engines.restart_hall(); });
    auto again = resumed();
    engines.advance(1s);
    EXPECT_THAT(again.received(), testing::Contains(HasSubstr("completed s ABORT")));
}

TEST_F(AMainEngineThatHasDied, EndsItsCommandsIfTheHallStaysSilent) {
    engines.execute(*desk, say("s", "hall.speech"));
    engines.hold_back(true);
    engines.restart_main();
    auto again = resumed();
    EXPECT_THAT(again.received(), IsEmpty());
    engines.advance(11s);
    EXPECT_THAT(again.received(), testing::Contains(HasSubstr("completed s ABORT")));
}

}  // namespace rois
