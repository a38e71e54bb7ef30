// Decisions 1 to 3: sessions begin, lose their link, and end.
#include "engine/world.hpp"

namespace rois {

namespace {

bool lives(World& world, Application const& application) { return world.engine->notifications(application.session) != nullptr; }

// The session ends after this time, not before.
void expect_end_after(std::chrono::seconds time, World& world, Application const& application) {
    world.advance(time - 50ms);
    EXPECT_TRUE(lives(world, application));
    world.advance(50ms);
    EXPECT_FALSE(lives(world, application));
}

}  // namespace

TEST(Session, CannotBeOpenedAboveTheLimit) {
    EngineSettings settings;
    settings.max_sessions = 2;
    World world{{navigation}, settings};
    auto desk = world.connect();
    auto hall = world.connect();
    EXPECT_EQ(std::get<Refusal>(world.say({}, Connect{})), Refusal::too_many_sessions);
    EXPECT_EQ(desk.refusal_of(Connect{}), std::nullopt) << "a second connect opens no session";
    hall.leave();
    EXPECT_TRUE(std::holds_alternative<Reply>(world.say({}, Connect{})));
}

TEST(Session, ThatIsIdleForLongestMakesRoomForANewOne) {
    EngineSettings settings;
    settings.max_sessions = 5;
    World world{{navigation, detection}, settings};
    auto linked = world.connect(), bound = world.connect_without_link(), subscribed = world.connect_without_link(),
         first = world.connect_without_link(), second = world.connect_without_link();
    bound.bind("navigation");
    subscribed.subscribe("person_detected");
    world.advance(1s);
    world.engine->note_request(first.session, world.now);
    auto const known = [&](Application& session) { return session.refusal_of(Search{}) == std::nullopt; };
    auto third = world.connect_without_link();
    EXPECT_FALSE(known(second)) << "the other one was active later";
    EXPECT_TRUE(known(first));
    auto fourth = world.connect();
    EXPECT_FALSE(known(first));
    auto fifth = world.connect();
    EXPECT_FALSE(known(third)) << "although it is new";
    EXPECT_EQ(std::get<Refusal>(world.say({}, Connect{})), Refusal::too_many_sessions) << "no session is idle";
    for (auto* busy : {&linked, &bound, &subscribed, &fourth, &fifth}) EXPECT_TRUE(known(*busy));
    EXPECT_EQ(world.engine->statistics().sessions_replaced, 3U);
    bound.release("navigation");
    EXPECT_TRUE(std::holds_alternative<Reply>(world.say({}, Connect{})));
    EXPECT_FALSE(known(bound));
}

TEST(Session, ReceivesNothingAfterItsEnd) {
    World world{navigation, detection};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.subscribe("person_detected");
    desk.execute(go("go"), after(200ms, go("later")));
    desk.leave();
    desk.received();
    auto const notified = world.notified[desk.session];
    world["detection"].fires("person_detected");
    world["navigation"].finishes();
    world.advance(10s);
    EXPECT_THAT(desk.received(), IsEmpty());
    EXPECT_EQ(world.notified[desk.session], notified);
    EXPECT_EQ(world.engine->statistics().subscriptions, 0U);
    EXPECT_THAT(world["navigation"].calls, ElementsAre("start", "halt", "parameters_changed"));
}

TEST(Session, MayLeaveItsCommandsRunning) {
    EngineSettings settings;
    settings.on_session_end = OnSessionEnd::continue_;
    World world{{navigation, speech}, settings};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.bind("speech");
    desk.execute(go("go"), say("say"));
    desk.leave();
    EXPECT_THAT(world["navigation"].calls, ElementsAre("start"));
    world["navigation"].finishes();
    EXPECT_THAT(world["speech"].calls, ElementsAre("start"));
    EXPECT_THAT(desk.received(), IsEmpty());
    EXPECT_EQ(world.stray_answers(), 0U);
}

TEST(Session, CommandsThatContinueDoNotKeepTheirComponentFromTheNextSession) {
    EngineSettings settings;
    settings.on_session_end = OnSessionEnd::continue_;
    World world{{navigation, speech}, settings};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.bind("speech");
    desk.execute(go("go"), say("say"));
    desk.leave();
    auto hall = world.connect();
    hall.bind("speech");
    hall.execute(say("mine"));
    world["navigation"].finishes();
    EXPECT_THAT(world["speech"].calls, ElementsAre("start"));
    EXPECT_EQ(hall.result_of("mine"), "RUNNING");
}

// --- The link (decision 2) ---

TEST(Link, AWebSocketThatClosesLeavesTheSessionTheResumeWindow) {
    World world{navigation};
    auto desk = world.connect_without_link();
    world.engine->link_opened(desk.session, LinkKind::websocket, world.now);
    world.advance(200s);
    EXPECT_TRUE(lives(world, desk)) << "a silent WebSocket is a link";
    world.engine->link_closed(desk.session, LinkKind::websocket, Closing::lost, world.now);
    expect_end_after(30s, world, desk);
}

TEST(Link, AClientThatBindsAndVanishesIsStoppedWithinTheWindow) {
    World world{navigation};
    auto desk = world.connect_without_link();
    world.engine->link_opened(desk.session, LinkKind::websocket, world.now);
    desk.bind("navigation");
    desk.execute(go("go"));
    world.engine->link_closed(desk.session, LinkKind::websocket, Closing::lost, world.now);
    world.advance(29s);
    EXPECT_THAT(world["navigation"].calls, ElementsAre("start"));
    world.advance(1s);
    EXPECT_THAT(world["navigation"].calls, ElementsAre("start", "halt", "parameters_changed"));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go ABORT"));
    EXPECT_EQ(world.connect().bind("navigation"), ReturnCode::ok);
}

TEST(Link, CannotBeResumedFromASequenceThatWasNeverSent) {
    World world{navigation};
    auto desk = world.connect_without_link();
    desk.bind("navigation");
    desk.set_parameter("navigation", {});
    EXPECT_EQ(desk.ask(Resume{desk.session, 1}).return_code, ReturnCode::ok);
    auto const refused = desk.ask(Resume{desk.session, 2});
    EXPECT_EQ(refused.return_code, ReturnCode::bad_parameter);
    EXPECT_THAT(refused.reason, testing::HasSubstr("last_sequence"));
}

TEST(Link, ASessionWithoutRequestsAfterConnectEnds) {
    World world{navigation};
    auto desk = world.connect_without_link();
    expect_end_after(30s, world, desk);
}

TEST(Link, AStreamThatClosesLeavesTheSessionTimeoutToo) {
    World world{navigation};
    auto desk = world.connect_without_link();
    world.engine->link_opened(desk.session, LinkKind::stream, world.now);
    world.advance(300s);
    world.engine->link_closed(desk.session, LinkKind::stream, Closing::lost, world.now);
    expect_end_after(90s, world, desk);
}

TEST(Link, KeepsItsSessionAliveAlone) {
    World world{navigation};
    auto desk = world.connect_without_link();
    world.engine->link_opened(desk.session, LinkKind::websocket, world.now);
    world.engine->link_opened(desk.session, LinkKind::websocket, world.now);
    world.engine->link_closed(desk.session, LinkKind::websocket, Closing::lost, world.now);
    world.advance(300s);
    EXPECT_TRUE(lives(world, desk));
    world.engine->link_closed(desk.session, LinkKind::websocket, Closing::lost, world.now);
    world.advance(30s);
    EXPECT_FALSE(lives(world, desk));
}

TEST(Link, HttpBesideAWebSocketCounts) {
    World world{navigation};
    auto desk = world.connect_without_link();
    world.engine->link_opened(desk.session, LinkKind::websocket, world.now);
    world.engine->note_request(desk.session, world.now);
    world.engine->link_closed(desk.session, LinkKind::websocket, Closing::lost, world.now);
    expect_end_after(90s, world, desk);
}

TEST(Link, ManyShortPollsDoNotShortenIt) {
    World world{navigation};
    auto desk = world.connect_without_link();
    for (int poll = 0; poll < 200; ++poll) {
        world.engine->link_opened(desk.session, LinkKind::stream, world.now);
        world.engine->link_closed(desk.session, LinkKind::stream, Closing::lost, world.now);
        world.advance(1s);
    }
    EXPECT_TRUE(lives(world, desk));
    expect_end_after(89s, world, desk);
}

TEST(Link, OfAnUnknownSessionHasNoEffect) {
    World world{navigation};
    world.engine->note_request({"made-up"}, world.now);
    world.engine->link_opened({"made-up"}, LinkKind::stream, world.now);
    world.engine->link_closed({"made-up"}, LinkKind::stream, Closing::lost, world.now);
    world.engine->end({"made-up"}, world.now);
    EXPECT_EQ(world.engine->statistics().sessions, 0U);
}

// --- The engine's end ---

TEST(ShutDown, EndsAllSessionsAndRefusesNewOnes) {
    World world{navigation, speech};
    auto desk = world.connect();
    auto hall = world.connect();
    desk.bind("navigation");
    hall.bind("speech");
    desk.execute(go("go"));
    hall.execute(say("say"));
    world.engine->shut_down(world.now);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go ABORT"));
    EXPECT_THAT(hall.received(), ElementsAre("1 completed say ABORT"));
    EXPECT_TRUE(desk.notifications_closed());
    EXPECT_TRUE(hall.notifications_closed());
    EXPECT_EQ(desk.refusal_of(Search{}), Refusal::shutting_down);
    EXPECT_EQ(std::get<Refusal>(world.say({}, Connect{})), Refusal::shutting_down);
    EXPECT_THAT(world["navigation"].calls, ElementsAre("start", "halt", "halt", "parameters_changed"));
}

TEST(ShutDown, StopsCommandsWithoutASessionToo) {
    EngineSettings settings;
    settings.on_session_end = OnSessionEnd::continue_;
    World world{{navigation, detection}, settings};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.bind("detection");
    desk.execute(start("detection"), go("go"), go("and on"));
    desk.leave();
    world.engine->shut_down(world.now);
    EXPECT_THAT(world["navigation"].calls, ElementsAre("start", "halt"));
    EXPECT_THAT(world["detection"].calls, ElementsAre("start", "halt"));
}

TEST(ShutDown, AnEngineMayBeDestroyedWhileItsCommandsRun) {
    World world{navigation};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.execute(go("go"), after(1h, go("later")));
    world.engine.reset();  // a leak sanitizer checks that all of it is freed
    EXPECT_THAT(desk.received(), IsEmpty());
}

}  // namespace rois
