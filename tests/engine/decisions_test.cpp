// Decisions 1 to 9 by number: each rule as one dialogue. docs/conformance-decisions.md lists the tests of the details.
#include "engine/world.hpp"

namespace rois {

namespace {

bool is_open(World& world, Application const& application) { return world.engine->notifications(application.session) != nullptr; }

std::vector<Operation> all_but_connect(SessionId const& session) {
    auto const navigation = Application::identifier("navigation");
    return {GetProfile{},
            GetErrorDetail{{"x-1"}, {}},
            Search{},
            Bind{navigation},
            BindAny{},
            Release{navigation},
            GetParameter{navigation},
            SetParameter{navigation, {}},
            Execute{{{stop("navigation")}}},
            GetCommandResult{{"c-1"}, {}},
            Query{"component_status", {}},
            Subscribe{"reached_target", {}, false},
            Unsubscribe{{"s-1"}},
            GetEventDetail{{"e-1"}, {}},
            Resume{session, 0},
            Disconnect{}};
}

}  // namespace

TEST(Decision01, ASessionIsOpenFromConnectToDisconnect) {
    World world{navigation};
    for (auto const& operation : all_but_connect({"nobody"}))
        EXPECT_EQ(std::get<Refusal>(world.say({}, operation)), Refusal::no_session);
    auto desk = world.connect();
    desk.bind("navigation");
    auto const again = desk.ask(Connect{});
    EXPECT_EQ(again.return_code, ReturnCode::ok);
    EXPECT_EQ(again.session, desk.session);
    EXPECT_EQ(desk.get_parameter("navigation").return_code, ReturnCode::ok) << "a second connect changes nothing";
    desk.leave();
    for (auto const& operation : all_but_connect(desk.session)) EXPECT_EQ(desk.refusal_of(operation), Refusal::no_session);
}

TEST(Decision02, ALostLinkMayBeResumedForAWhileAndThenEndsTheSession) {
    World world{navigation};
    auto over_websocket = world.connect(), over_http = world.connect_without_link();
    over_websocket.bind("navigation");
    over_websocket.execute(go("go"));
    world.engine->note_request(over_http.session, world.now);
    world.engine->link_closed(over_websocket.session, LinkKind::websocket, Closing::lost, world.now);
    world.advance(29'950ms);
    EXPECT_EQ(over_websocket.ask(Resume{over_websocket.session, 0}).return_code, ReturnCode::ok);
    world.engine->link_opened(over_websocket.session, LinkKind::websocket, world.now);
    world.engine->link_closed(over_websocket.session, LinkKind::websocket, Closing::lost, world.now);
    world.advance(29'950ms);
    EXPECT_TRUE(is_open(world, over_websocket));
    world.advance(50ms);
    EXPECT_FALSE(is_open(world, over_websocket)) << "a closed WebSocket: the resume window of 30 s";
    EXPECT_THAT(over_websocket.received(), ElementsAre("1 completed go ABORT")) << "as if disconnected";
    world.advance(30s);
    EXPECT_TRUE(is_open(world, over_http)) << "silence on HTTP: the session timeout of 60 s, and the window";
    world.advance(50ms);
    EXPECT_FALSE(is_open(world, over_http));
}

// The end of its first window is checked before the later request lets the session end.
TEST(Decision02, ARequestPutsTheEndOffByTheTimeoutAndTheWholeWindow) {
    World world{navigation};
    auto over_http = world.connect_without_link();
    world.engine->note_request(over_http.session, world.now);
    world.advance(10s);
    world.engine->note_request(over_http.session, world.now);
    world.advance(89'950ms);
    EXPECT_TRUE(is_open(world, over_http)) << "60 s and 30 s after the second one";
    world.advance(50ms);
    EXPECT_FALSE(is_open(world, over_http));
}

TEST(Decision03, TheEndOfASessionStopsReleasesAndCancels) {
    World world{navigation, speech, detection};
    auto desk = world.connect(), hall = world.connect();
    for (auto const* ref : {"navigation", "speech", "detection"}) desk.bind(ref);
    desk.subscribe("person_detected");
    desk.execute(start("detection"), go("go"), say("arrived"));
    desk.received();
    desk.leave();
    EXPECT_THAT(desk.received(), ElementsAre("2 completed go ABORT", "3 completed arrived ABORT"));
    EXPECT_TRUE(desk.notifications_closed());
    EXPECT_THAT(world["navigation"].calls, ElementsAre("start", "halt", "parameters_changed"));
    EXPECT_THAT(world["detection"].calls, ElementsAre("start", "halt"));
    for (auto const* ref : {"navigation", "speech", "detection"}) EXPECT_EQ(hall.bind(ref), ReturnCode::ok) << ref;
    EXPECT_EQ(world.engine->statistics().subscriptions, 0U);
    world["detection"].fires("person_detected");
    world.advance(1min);
    EXPECT_THAT(desk.received(), IsEmpty());
    EXPECT_NE(desk.ask(Connect{}).session, desk.session) << "connect with an ended id opens another session";
}

TEST(Decision04, ABindingIsExclusive) {
    World world{named("robot_a", navigation), named("robot_b", navigation)};
    auto desk = world.connect(), hall = world.connect();
    EXPECT_EQ(desk.bind("robot_a"), ReturnCode::ok);
    EXPECT_EQ(desk.bind("robot_a"), ReturnCode::ok) << "it is bound already";
    EXPECT_EQ(hall.bind("robot_a"), ReturnCode::out_of_resources);
    EXPECT_THAT(hall.ask(Bind{Application::identifier("robot_a")}).reason,
                HasSubstr("'robot_a' is bound by another session, number 1"));
    EXPECT_EQ(hall.bind("robot_c"), ReturnCode::bad_parameter);
    EXPECT_EQ(hall.bind_any(equal("name", "robot_c")), "UNSUPPORTED");
    EXPECT_EQ(hall.bind_any(equal("name", "robot_a")), "OUT_OF_RESOURCES");
    EXPECT_THAT(hall.ask(BindAny{equal("name", "robot_a")}).reason, HasSubstr("no component that matches the condition is free"));
    EXPECT_EQ(hall.bind_any(equal("colour", "red")), "BAD_PARAMETER");
    EXPECT_EQ(hall.bind_any(), "robot_b");
    EXPECT_THAT(hall.search(equal("name", "robot_c")), IsEmpty()) << "no match is not an error";
}

TEST(Decision05, CommandsNeedABindingAndQueriesDoNot) {
    World world{navigation};
    auto desk = world.connect();
    EXPECT_EQ(desk.get_parameter("navigation").return_code, ReturnCode::error);
    EXPECT_EQ(desk.set_parameter("navigation", {integer("time_limit", 7)}).return_code, ReturnCode::error);
    EXPECT_EQ(desk.execute(go("go")).return_code, ReturnCode::error);
    EXPECT_THAT(world["navigation"].calls, IsEmpty());
    EXPECT_EQ(desk.query("route").return_code, ReturnCode::ok);
    EXPECT_EQ(desk.subscribe("reached_target").return_code, ReturnCode::ok);
    EXPECT_THAT(desk.search(), ElementsAre("navigation"));
    EXPECT_EQ(desk.ask(GetProfile{}).components.size(), 1U);
    desk.bind("navigation");
    EXPECT_EQ(desk.get_parameter("navigation").return_code, ReturnCode::ok);
    EXPECT_EQ(desk.set_parameter("navigation", {integer("time_limit", 7)}).return_code, ReturnCode::ok);
    EXPECT_EQ(desk.execute(go("go")).return_code, ReturnCode::ok);
}

TEST(Decision06, ReleaseStopsTheCommandsOfTheSession) {
    World world{named("robot_a", navigation), named("robot_b", navigation), detection};
    auto desk = world.connect(), hall = world.connect();
    EXPECT_EQ(desk.bind_any(equal("component_type", "urn:x-rois:def:component:OMG::Navigation")), "robot_a");
    EXPECT_EQ(desk.bind_any(equal("component_type", "urn:x-rois:def:component:OMG::Navigation")), "robot_b");
    EXPECT_EQ(desk.bind_any(equal("component_type", "urn:x-rois:def:component:OMG::Navigation")), "robot_a") << "none is free";
    desk.bind("detection");
    desk.execute(named("look", start("detection")), go("go", "robot_a"));
    EXPECT_EQ(desk.release("robot_a"), ReturnCode::ok);
    EXPECT_EQ(desk.release("detection"), ReturnCode::ok);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed look OK", "2 completed go ABORT"));
    EXPECT_THAT(world["detection"].calls, ElementsAre("start", "halt"));
    hall.bind("robot_a");
    hall.execute(go("on", "robot_a"));
    EXPECT_EQ(desk.release("robot_a"), ReturnCode::ok) << "known, and nothing to do";
    EXPECT_EQ(hall.result_of("on"), "RUNNING");
    EXPECT_EQ(desk.release("robot_c"), ReturnCode::bad_parameter);
}

TEST(Decision07, TheStatusDependsOnTheSessionThatAsks) {
    World world{navigation};
    auto desk = world.connect(), hall = world.connect();
    auto& robot = world["navigation"];
    for (auto const status : {ComponentStatus::uninitialized, ComponentStatus::error, ComponentStatus::warning}) {
        robot.status_now = status;
        EXPECT_EQ(desk.status_of("navigation"), to_text(status));
    }
    hall.bind("navigation");
    EXPECT_EQ(desk.status_of("navigation"), "BUSY");
    EXPECT_EQ(hall.status_of("navigation"), "WARNING");
    robot.status_now = ComponentStatus::ready;
    hall.execute(go("go"));
    EXPECT_EQ(hall.status_of("navigation"), "READY") << "also while its own command runs";
    EXPECT_EQ(desk.status_of("navigation"), "BUSY");
    EXPECT_THAT(desk.search(equal("status", "BUSY")), ElementsAre("navigation"));
    EXPECT_THAT(hall.search(equal("status", "BUSY")), IsEmpty());
}

TEST(Decision08, ParametersAreStoredAndStartActs) {
    World world{speech, detection, navigation};
    auto desk = world.connect();
    for (auto const* ref : {"navigation", "speech", "detection"}) desk.bind(ref);
    auto const stored = desk.set_parameter("speech", {text("speech_text", "hello"), integer("volume", 70)}).command_id;
    EXPECT_THAT(desk.received(), ElementsAre("1 completed " + stored.text + " OK")) << "stored, and completed at once";
    EXPECT_THAT(world["speech"].calls, ElementsAre("parameters_changed")) << "it does not speak";
    desk.execute(named("say", start("speech", {integer("volume", 20)})));
    EXPECT_EQ(in_words(world["speech"].started_with), "speech_text=hello volume=20 language=en")
        << "arguments of start are stored first";
    EXPECT_THAT(desk.received(), IsEmpty());
    world["speech"].finishes();
    EXPECT_THAT(desk.received(), ElementsAre("2 completed say OK")) << "an action completes at its end";
    desk.execute(named("look", start("detection")));
    EXPECT_THAT(desk.received(), ElementsAre("3 completed look OK")) << "a function completes once it is active";
    EXPECT_THAT(desk.execute(start("navigation")).reason, HasSubstr("target_position is mandatory"));
    desk.subscribe("reached_target");
    desk.execute(go("go"));
    world["navigation"].fires("reached_target");
    world["navigation"].finishes();
    EXPECT_THAT(desk.received(), ElementsAre("4 reached_target navigation", "5 completed go OK")) << "its events come first";
}

TEST(Decision08, FollowEndsByStopOrByItsTimeLimit) {
    auto part = named("follow", navigation);
    part.status_when_stopped = CompletedStatus::ok;
    World world{part};
    auto desk = world.connect();
    desk.bind("follow");
    desk.execute(go("follow", "follow"), named("too late", stop("follow")));
    world.advance(1h);
    EXPECT_THAT(desk.received(), IsEmpty()) << "a stop after it in the sequence never runs";
    desk.execute(named("enough", stop("follow")));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed follow OK", "2 completed enough OK", "3 completed too late OK"));
    desk.execute(go("again", "follow"));
    world["follow"].finishes(CompletedStatus::timeout);
    EXPECT_THAT(desk.received(), ElementsAre("4 completed again TIMEOUT"));
    desk.execute(in_parallel({go("beside", "follow"), after(1s, named("now", stop("follow")))}), named("after", stop("follow")));
    world.advance(1s);
    EXPECT_THAT(desk.received(), ElementsAre("5 completed beside OK", "6 completed now OK", "7 completed after OK"))
        << "a stop in a parallel branch";
}

TEST(Decision09, StopEndsStartReplacesAndSuspendHolds) {
    World world{navigation};
    auto desk = world.connect();
    desk.bind("navigation");
    auto const say_it = [&](std::string const& id, std::string const& type) {
        desk.execute(named(id, command(type, "navigation")));
    };
    for (auto const* type : {"suspend", "resume"}) say_it(type, type);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed suspend ERROR", "2 completed resume ERROR")) << "idle";
    say_it("idle", "stop");
    desk.execute(go("here"));
    desk.execute(go("there"));
    EXPECT_THAT(desk.received(), ElementsAre("3 completed idle OK", "4 completed here ABORT"));
    say_it("hold", "suspend");
    say_it("hold more", "suspend");
    say_it("on", "resume");
    EXPECT_THAT(desk.received(), ElementsAre("5 completed hold OK", "6 completed hold more ERROR", "7 completed on OK"));
    say_it("halt", "stop");
    EXPECT_THAT(desk.received(), ElementsAre("8 completed there ABORT", "9 completed halt OK"));
    say_it("dock", "dock");
    EXPECT_EQ(world["navigation"].calls.back(), "dock") << "a command of its profile";
    auto const refused = desk.execute(command("fly", "navigation"));
    EXPECT_EQ(refused.return_code, ReturnCode::bad_parameter);
}

}  // namespace rois
