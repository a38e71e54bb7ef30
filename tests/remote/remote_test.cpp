#include "remote/two_engines.hpp"

namespace rois {

namespace {

struct SubEngines : testing::Test {
    TwoEngines engines{{navigation, speech, localization}};
    Application desk = engines.main.connect();

    ScriptedComponent& robot() { return engines.hall["navigation"]; }
};

}  // namespace

TEST_F(SubEngines, HaveTheirComponentsInThisEngine) {
    EXPECT_THAT(desk.search(), ElementsAre("hall.localization", "hall.navigation", "hall.speech"));
    EXPECT_EQ(desk.ask(Search{}).component_ref_list[1].codebook_ref, navigation.profile.object.identifier);
    auto const profile = desk.ask(GetProfile{}).profile;
    ASSERT_EQ(profile->sub_profiles.size(), 1u);
    EXPECT_EQ(profile->sub_profiles[0].object.name, "hall");
    EXPECT_EQ(desk.status_of("hall.navigation"), "READY");
}

TEST_F(SubEngines, AreAskedForBindings) {
    EXPECT_EQ(engines.bind(desk, "hall.navigation"), ReturnCode::ok);
    auto guard = engines.hall.connect();
    EXPECT_EQ(guard.bind("navigation"), ReturnCode::out_of_resources) << "it belongs to an application of the main engine";
    EXPECT_EQ(guard.bind("speech"), ReturnCode::ok);
    EXPECT_EQ(engines.bind(desk, "hall.speech"), ReturnCode::out_of_resources);
    engines.advance(300ms);
    EXPECT_EQ(desk.status_of("hall.speech"), "BUSY");
    desk.release("hall.navigation");
    engines.settle();
    EXPECT_EQ(guard.bind("navigation"), ReturnCode::ok);
}

TEST_F(SubEngines, WithAnApplicationOfTheirOwnAreTakenForBindAny) {
    auto guard = engines.hall.connect();
    guard.bind("navigation");
    auto const taken = engines.ask(desk, BindAny{equal("name", "hall.navigation")});
    EXPECT_EQ(taken.return_code, ReturnCode::out_of_resources);
    EXPECT_THAT(taken.reason, HasSubstr("in the engine 'hall': the component 'navigation' is bound by another session"));
}

TEST_F(SubEngines, LossesAreReportedEachTime) {
    for (int i = 0; i < 3; ++i) {
        engines.cut();
        engines.advance(500ms);
        engines.repair();
        engines.advance(500ms);
    }
    EXPECT_EQ(std::ranges::count(engines.reported, "the link broke"), 3);
    EXPECT_EQ(std::ranges::count(engines.reported, "the link is back"), 3);
}

TEST_F(SubEngines, ThatDoNotAnswerGetProfileAreGivenUp) {
    engines.inject(ProfileChanged{});
    engines.hold_back(true);
    engines.inject(ProfileChanged{});
    engines.advance(6s);
    EXPECT_THAT(engines.reported, testing::Contains("no answer to get_profile within 5 s"));
}

TEST(SubEnginesWithoutAWantedComponent, AreReported) {
    auto settings = TwoEngines::hall_settings();
    settings.components = {"navigation", "navigatoin"};
    TwoEngines engines{{navigation}, settings};
    EXPECT_THAT(engines.reported,
                testing::Contains("it lacks navigatoin, which the engines file names in \"components\"").Times(1));
    engines.hall.change({}, {speech});
    engines.advance(1s);
    EXPECT_THAT(engines.reported,
                testing::Contains("it lacks navigatoin, which the engines file names in \"components\"").Times(1));
}

TEST_F(SubEngines, PerformCommands) {
    engines.bind(desk, "hall.navigation");
    engines.execute(desk, go("go", "hall.navigation"));
    EXPECT_EQ(desk.status_of("hall.navigation"), "READY");
    EXPECT_EQ(in_words(robot().started_with), in_words(engines.hall["navigation"].started_with));
    EXPECT_THAT(robot().calls, testing::Contains(HasSubstr("start")));
    robot().finishes();
    engines.settle();
    EXPECT_THAT(desk.received(), testing::Contains(HasSubstr("completed go OK")));
    engines.execute(desk, named("dock", command("dock", "hall.navigation")));
    robot().finishes(CompletedStatus::ok, {.parameters = {value("charge", "int", {"80"})}, .located = {}});
    engines.settle();
    EXPECT_EQ(desk.result_of("dock"), "OK charge=80");
}

TEST_F(SubEngines, RefuseCommandsBeforeTheyRun) {
    engines.bind(desk, "hall.navigation");
    auto const refused = engines.execute(desk, start("hall.navigation"));
    EXPECT_EQ(refused.return_code, ReturnCode::bad_parameter);
    EXPECT_THAT(refused.reason, HasSubstr("target_position"));
}

TEST_F(SubEngines, AreStopped) {
    engines.bind(desk, "hall.navigation");
    engines.execute(desk, go("go", "hall.navigation"));
    engines.execute(desk, named("stop", stop("hall.navigation")));
    EXPECT_THAT(robot().calls, testing::Contains("halt"));
    EXPECT_THAT(desk.received(), testing::IsSupersetOf({HasSubstr("completed go ABORT"), HasSubstr("completed stop OK")}));
}

TEST_F(SubEngines, AnswerQueries) {
    auto const reply = engines.ask(desk, Query{"route", equal("component_ref", "hall.navigation")});
    EXPECT_EQ(reply.return_code, ReturnCode::ok) << reply.reason;
    EXPECT_EQ(reply.component_ref.code, "hall.navigation");
}

TEST_F(SubEngines, AnswerQueriesWithTheRowThatMatches) {
    auto const row = [](std::string const& length) { return Results{{value("length", "double", {length})}, {}}; };
    robot().knows = {row("1"), row("2"), row("3")};
    auto const reply = engines.ask(desk, Query{"route", equal("length", "2")});
    EXPECT_EQ(in_words(reply.results.parameters), "length=2") << reply.reason;
    EXPECT_THAT(reply.other_rows, IsEmpty());
    EXPECT_EQ(engines.ask(desk, Query{"route", equal("length", "4")}).return_code, ReturnCode::unsupported);
}

// Two applications, one at each engine, want the same component.
TEST_F(SubEngines, ShareTheirComponentsWithTheirOwnApplications) {
    auto guard = engines.hall.connect();
    EXPECT_EQ(guard.bind("navigation"), ReturnCode::ok);
    engines.advance(1s);
    EXPECT_EQ(engines.bind(desk, "hall.navigation"), ReturnCode::out_of_resources);
    EXPECT_EQ(engines.execute(desk, go("go", "hall.navigation")).return_code, ReturnCode::error) << "not bound";
    EXPECT_EQ(guard.release("navigation"), ReturnCode::ok);
    engines.advance(1s);
    EXPECT_EQ(engines.bind(desk, "hall.navigation"), ReturnCode::ok);
    EXPECT_EQ(guard.bind("navigation"), ReturnCode::out_of_resources);
}

TEST_F(SubEngines, DoNotMindJumpsOfTheCalendar) {
    engines.bind(desk, "hall.navigation");
    engines.execute(desk, go("go", "hall.navigation"));
    for (auto const jump : {std::chrono::hours{24 * 400}, std::chrono::hours{-24 * 800}}) {
        engines.main.now.utc += jump;
        engines.advance(2s);
        engines.hall.now.utc += jump;
        engines.advance(5s);
        EXPECT_EQ(desk.status_of("hall.navigation"), "READY");
    }
    robot().finishes();
    engines.advance(1s);
    EXPECT_THAT(desk.received(), testing::Contains(HasSubstr("completed go OK")));
}

TEST_F(SubEngines, ReportEvents) {
    desk.subscribe("reached_target");
    robot().fires("reached_target", {value("is_final_target", "bool", {"true"})});
    engines.settle();
    EXPECT_THAT(desk.received(), testing::Contains(HasSubstr("reached_target hall.navigation")));
}

TEST_F(SubEngines, ReportErrors) {
    engines.bind(desk, "hall.navigation");
    robot().reports(ErrorType::user_defined_error, "the bumper was touched");
    engines.settle();
    EXPECT_THAT(desk.received(), testing::Contains(HasSubstr("USER_DEFINED_ERROR hall.navigation")));
}

TEST_F(SubEngines, ShowTheirState) {
    using enum EngineState::Is;
    engines.advance(2s);
    EXPECT_EQ(engines.shown.is, present);
    EXPECT_EQ(engines.shown.components, 3U);
    EXPECT_EQ(engines.shown.link, "ws://hall");
    EXPECT_TRUE(engines.shown.round_trip);
    EXPECT_EQ(engines.shown.last_error, "");
    engines.cut();
    engines.advance(100ms);
    EXPECT_EQ(engines.shown.is, lost);
    EXPECT_FALSE(engines.shown.round_trip);
    EXPECT_EQ(engines.shown.losses, 1U);
    engines.advance(3s);
    EXPECT_EQ(engines.shown.is, given_up);
    EXPECT_EQ(engines.shown.last_error, "cannot be reached");
    engines.advance(30s);
    EXPECT_EQ(engines.shown.is, absent);
    EXPECT_EQ(engines.shown.components, 0U);
    engines.repair();
    engines.advance(31s);
    EXPECT_EQ(engines.shown.is, present);
    EXPECT_EQ(engines.shown.losses, 1U);
}

TEST_F(SubEngines, LoseNothingIfTheLinkReturnsWithinTheWindow) {
    engines.bind(desk, "hall.navigation");
    for (auto const missing : {1000ms, 1800ms, 2700ms}) {
        engines.execute(desk, go("go " + std::to_string(missing.count()), "hall.navigation"));
        engines.cut();
        engines.advance(missing);
        robot().finishes();
        engines.repair();
        engines.advance(1s);
        EXPECT_THAT(desk.received(), testing::Contains(HasSubstr(" " + std::to_string(missing.count()) + " OK")));
        EXPECT_EQ(desk.status_of("hall.navigation"), "READY");
    }
}

TEST_F(SubEngines, RefuseOperationsAtOnceWhileTheyAreLost) {
    engines.bind(desk, "hall.navigation");
    engines.cut();
    EXPECT_EQ(engines.bind(desk, "hall.speech"), ReturnCode::error);
    auto const refused = engines.execute(desk, go("go", "hall.navigation"));
    EXPECT_EQ(refused.return_code, ReturnCode::error);
    EXPECT_THAT(refused.reason, HasSubstr("its engine is lost"));
    EXPECT_EQ(engines.ask(desk, Query{"route", {}}).return_code, ReturnCode::error);
    engines.repair();
    engines.advance(1s);
    EXPECT_EQ(engines.execute(desk, go("later", "hall.navigation")).return_code, ReturnCode::ok);
}

TEST_F(SubEngines, SayWhyTheyRefuseWhatTheirTokenDoesNotAllow) {
    engines.bind(desk, "hall.speech");
    engines.not_allowed = "bind";
    EXPECT_THAT(engines.ask(desk, Bind{Application::identifier("hall.navigation")}).reason, HasSubstr("the token may not bind"));
    engines.not_allowed = "execute";
    auto const refused = engines.execute(desk, say("hello", "hall.speech"));
    EXPECT_EQ(refused.return_code, ReturnCode::error);
    EXPECT_THAT(refused.reason, HasSubstr("the token may not execute"));
    engines.cut();
    EXPECT_THAT(engines.ask(desk, Bind{Application::identifier("hall.navigation")}).reason, HasSubstr("its engine is lost"));
}

TEST_F(SubEngines, AloneConfirmThatTheirComponentsStandStill) {
    engines.bind(desk, "hall.navigation");
    engines.execute(desk, go("go", "hall.navigation"));
    engines.hold_back(true);
    desk.release("hall.navigation");
    engines.advance(2s);
    EXPECT_THAT(engines.main.engine->not_halted(), ElementsAre("hall.navigation"));
    EXPECT_EQ(engines.bind(desk, "hall.navigation"), ReturnCode::error);
    engines.hold_back(false);
    engines.advance(500ms);
    EXPECT_THAT(engines.main.engine->not_halted(), IsEmpty());
    EXPECT_EQ(engines.bind(desk, "hall.navigation"), ReturnCode::ok);
}

TEST_F(SubEngines, EndAStopWhenTheirComponentsStandStill) {
    engines.bind(desk, "hall.navigation");
    engines.execute(desk, go("go", "hall.navigation"));
    robot().halts_later = true;
    engines.execute(desk, named("stop", stop("hall.navigation")));
    engines.advance(200ms);
    EXPECT_EQ(desk.result_of("go"), "ABORT");
    EXPECT_EQ(desk.result_of("stop"), "RUNNING");
    robot().stands_still();
    engines.advance(50ms);
    EXPECT_EQ(desk.result_of("stop"), "OK");
}

TEST_F(SubEngines, ThatAreLostConfirmNoHalt) {
    engines.bind(desk, "hall.navigation");
    engines.execute(desk, go("go", "hall.navigation"));
    engines.cut();
    engines.advance(4s);
    engines.execute(desk, named("stop", stop("hall.navigation")));
    engines.advance(1s);
    EXPECT_THAT(desk.received(), testing::Contains(HasSubstr("completed stop TIMEOUT")));
    engines.repair();
    engines.advance(5s);
    EXPECT_THAT(engines.main.engine->not_halted(), IsEmpty());
}

TEST_F(SubEngines, NeedNoHaltIfNothingRuns) {
    engines.bind(desk, "hall.navigation");
    engines.execute(desk, go("go", "hall.navigation"));
    robot().finishes(CompletedStatus::ok, {}, Afterwards::idle);
    engines.settle();
    engines.cut();
    desk.release("hall.navigation");
    engines.advance(1s);
    EXPECT_THAT(engines.main.engine->not_halted(), IsEmpty());
}

TEST_F(SubEngines, HaveTheirParametersRestoredWhenTheyReturn) {
    engines.bind(desk, "hall.navigation");
    engines.execute(desk, command("set_parameter", "hall.navigation", {value("time_limit", "int", {"7000"})}));
    engines.cut();
    engines.advance(4s);
    robot().changed_to.clear();
    engines.repair();
    engines.advance(5s);
    ASSERT_NE(find(robot().changed_to, "time_limit"), nullptr);
    EXPECT_THAT(find(robot().changed_to, "time_limit")->values, ElementsAre("7000"));
}

// Engines above this one find loops by the instances.
TEST_F(SubEngines, ShowTheirNewInstanceWhenTheyReturn) {
    auto const instance = [&] {
        auto const profile = desk.ask(GetProfile{}).profile;
        return find_parameter(profile->sub_profiles.at(0).parameters, "instance")->default_value.value();
    };
    EXPECT_EQ(instance(), "instance1");
    engines.falsify = [](Reply& reply) {
        auto* const answer = std::get_if<GetProfile::Reply>(&reply);
        if (answer == nullptr) return;
        auto profile = *answer->profile;
        for (auto& parameter : profile.parameters)
            if (parameter.name == "instance") parameter.default_value = "another";
        answer->profile = std::make_shared<EngineProfile const>(std::move(profile));
    };
    desk.received();
    engines.restart_hall();
    engines.advance(6s);
    EXPECT_EQ(instance(), "another");
    EXPECT_THAT(desk.received(), testing::Contains(HasSubstr("profile_changed")));
}

// Engines above this one count levels and find loops by them.
TEST(ASubEngineWithoutComponents, IsShownOnlyToOtherEngines) {
    TwoEngines engines{{}};
    auto const shown_to = [&](bool is_engine) {
        Connect as;
        as.is_engine = is_engine;
        auto const profile = engines.main.connect(as).ask(GetProfile{}).profile;
        std::vector<std::string> names;
        for (auto const& sub : profile->sub_profiles) names.push_back(sub.object.name);
        return names;
    };
    EXPECT_THAT(shown_to(false), IsEmpty());
    EXPECT_THAT(shown_to(true), ElementsAre("hall"));

    engines.hall.change({}, {speech});
    engines.advance(2s);
    EXPECT_THAT(shown_to(false), ElementsAre("hall"));
    engines.hall.change({"speech"}, {});
    engines.advance(2s);
    EXPECT_THAT(shown_to(false), IsEmpty());
    EXPECT_THAT(shown_to(true), ElementsAre("hall"));

    engines.cut();
    engines.advance(60s);
    EXPECT_THAT(shown_to(true), IsEmpty());
}

TEST_F(SubEngines, HaveTheirReportsPassedOnBeforeTheAnswerToAnotherRequest) {
    engines.bind(desk, "hall.navigation");
    engines.execute(desk, go("go", "hall.navigation"));
    desk.received();
    robot().finishes();
    engines.receive_without_main();
    auto const queue = engines.main.engine->notifications(desk.session);
    auto const hold = queue->hold();
    auto const slow = engines.main.begin_to_say(desk.session, Query{"route", {}});
    EXPECT_FALSE(slow->said);
    queue->leave(hold);
    queue->delay(hold);
    EXPECT_THAT(desk.received(), ElementsAre(HasSubstr("completed go OK")));
}

TEST_F(SubEngines, AreGivenUpAfterTheWindow) {
    engines.bind(desk, "hall.navigation");
    engines.execute(desk, go("go", "hall.navigation"));
    desk.received();
    engines.cut();
    engines.advance(3100ms);
    EXPECT_THAT(desk.received(),
                testing::IsSupersetOf({HasSubstr("completed go ABORT"), HasSubstr("COMPONENT_NOT_RESPONDING hall.navigation")}));
    EXPECT_EQ(desk.status_of("hall.navigation"), "ERROR");
    EXPECT_THAT(robot().calls, testing::Contains("halt"));
    EXPECT_EQ(engines.execute(desk, go("again", "hall.navigation")).return_code, ReturnCode::error);
    engines.repair();
    engines.advance(5s);
    EXPECT_EQ(desk.status_of("hall.navigation"), "READY");
    EXPECT_EQ(engines.execute(desk, go("later", "hall.navigation")).return_code, ReturnCode::ok) << "it is still bound";
    auto guard = engines.hall.connect();
    EXPECT_EQ(guard.bind("navigation"), ReturnCode::out_of_resources);
}

// The link breaks again after each number of documents of connect, resume, get_profile and bind.
TEST(SubEnginesThatReturn, MayLoseTheirLinkAfterEachDocument) {
    for (auto const missing : {500ms, 4000ms}) {
        for (int documents = 0; documents < 30; ++documents) {
            TwoEngines engines{{navigation, speech}};
            auto desk = engines.main.connect();
            engines.bind(desk, "hall.navigation");
            engines.execute(desk, go("go", "hall.navigation"));
            engines.cut();
            engines.advance(missing);
            engines.cut_after(documents);
            engines.repair();
            engines.advance(8s);
            engines.repair();
            engines.advance(40s);
            EXPECT_EQ(desk.status_of("hall.navigation"), "READY") << documents << " documents after " << missing.count() << " ms";
            engines.hall["navigation"].finishes();
            engines.advance(1s);
            EXPECT_THAT(desk.received(), testing::Contains(HasSubstr("completed go ")).Times(1)) << documents;
            EXPECT_EQ(engines.execute(desk, go("again", "hall.navigation")).return_code, ReturnCode::ok) << documents;
        }
    }
}

TEST_F(SubEngines, LeaveAfterTheResumeWindow) {
    engines.cut();
    engines.advance(31s);
    EXPECT_THAT(desk.search(), IsEmpty());
    EXPECT_EQ(engines.bind(desk, "hall.navigation"), ReturnCode::bad_parameter);
    engines.repair();
    engines.advance(31s);
    EXPECT_EQ(desk.search().size(), 3u);
}

// Then there is no session that could be lost with the link.
TEST_F(SubEngines, LeaveAfterTheResumeWindowAlsoIfTheirSessionHadEnded) {
    engines.inject(xml::encode(Fault{FaultCode::no_session, "ended", {}, {}}));
    engines.cut();
    engines.advance(31s);
    EXPECT_THAT(desk.search(), IsEmpty());
}

TEST_F(SubEngines, ComeAndGoWithTheirProfile) {
    engines.hall.change({"speech"}, {detection});
    engines.advance(100ms);
    EXPECT_THAT(desk.search(), ElementsAre("hall.detection", "hall.localization", "hall.navigation"));
}

TEST_F(SubEngines, ThatDoNotAnswerLeaveOperationsWithTimeout) {
    engines.hold_back(true);
    EXPECT_EQ(engines.bind(desk, "hall.navigation"), ReturnCode::timeout);
    EXPECT_EQ(engines.ask(desk, Query{"route", {}}).return_code, ReturnCode::timeout);
    engines.hold_back(false);
    engines.settle();
    auto guard = engines.hall.connect();
    EXPECT_EQ(guard.bind("navigation"), ReturnCode::ok) << "the late binding was given back";
}

// The thread of the links answers pings all the time.
TEST(AnEngineWhoseClockStandsStill, LeavesItsSubEnginesToHoldTheirRobots) {
    auto part = navigation;
    part.moves = true;
    TwoEngines engines{{part}};
    auto const desk = engines.main.connect();
    auto const& calls = engines.hall["navigation"].calls;
    engines.bind(desk, "hall.navigation");
    engines.execute(desk, go("go", "hall.navigation"));
    for (int i = 0; i < 30; ++i) {
        engines.main.engine->note_pong(desk.session, engines.main.now);
        engines.advance(100ms);
    }
    EXPECT_THAT(calls, testing::Not(testing::Contains("suspend"))) << "the signs of life arrive";
    engines.main_is_alive = false;
    engines.advance(2s);
    EXPECT_THAT(calls, testing::Contains("suspend"));
}

TEST(ASubEngineWithAPlacement, HasItsPositionsInOurFrame) {
    auto settings = TwoEngines::hall_settings();
    settings.placement = {.position = {1000, 0, 0}, .orientation = {0, 0, 90}, .covariance = {}};
    TwoEngines engines{{localization, navigation}, settings, {.frames = {"crs1"}, .all = {}}};
    auto desk = engines.main.connect();
    desk.subscribe("person_localized", {}, true);
    Located found{
        .of = "position_data", .ref = "person-1", .crs = "crs1", .position = {100, 0, 0}, .orientation = {}, .certainty = {}};
    engines.hall["localization"].fires(
        "person_localized",
        {value("person_ref", "RoISIdentifier[]", {"person-1"}), positions("position_data", {"100, 0, 0"}, "crs1")}, {found});
    engines.settle();
    EXPECT_THAT(desk.received(), testing::Contains(HasSubstr("person_localized hall.localization")));
    auto const event = desk.last_received<ReceiveEvent>();
    ASSERT_EQ(event.results->located.size(), 1u);
    EXPECT_EQ(event.results->located[0].crs, "here");
    EXPECT_THAT(event.results->located[0].position, ElementsAre(1000, 100, 0));
    EXPECT_EQ(find(event.results->parameters, "position_data")->values, std::vector<std::string>{"1000, 100, 90"});

    engines.bind(desk, "hall.navigation");
    engines.execute(desk, start("hall.navigation", {positions("target_position", {"1000, 100, 90"}, "here")}));
    EXPECT_EQ(find(engines.hall["navigation"].started_with, "target_position")->values, std::vector<std::string>{"100, 0, 0"});
}

TEST(ALoop, IsRefused) {
    TwoEngines engines{{navigation}};
    auto desk = engines.main.connect();
    EXPECT_EQ(desk.search().size(), 1u);
    engines.instance_of_main = "instance1";  // that of the hall
    engines.hall.change({}, {speech});
    engines.advance(2s);
    EXPECT_THAT(desk.search(), IsEmpty());
    EXPECT_THAT(engines.reported, testing::Contains(HasSubstr("loop")));
}

}  // namespace rois
