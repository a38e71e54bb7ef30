// Decision 39: sessions of other engines receive more, and end when the other engine counts them as lost.
#include "engine/world.hpp"

namespace rois {

namespace {

Connect const as_engine{.motion_lease = {}, .motion_lease_http = {}, .motion_proof = {}, .is_engine = true, .window = 3000ms};

// A logical component that does nothing by itself.
class Chooser final : public Component {
public:
    Chooser() {
        description_.ref = Application::identifier("chooser");
        description_.profile = std::make_shared<ComponentProfile const>(navigation.profile);
        description_.members = {"navigation"};
        description_.returns_at_once = true;
    }
    ComponentDescription const& description() const override { return description_; }
    void attach(ComponentPort& its_port) override { port = &its_port; }
    void prepare(Ticket, std::string_view, ParameterList const&, Instant) override {}
    void halt(Ticket ticket, Instant) override { port->halted(ticket); }
    void suspend(Ticket, Instant) override {}
    void resume(Ticket, Instant) override {}
    void query(Ticket, std::string_view, Instant) override {}

    ComponentPort* port = nullptr;

private:
    ComponentDescription description_;
};

struct AnEngine : testing::Test {
    World world{navigation, speech};
    Application engine = world.connect(as_engine);
};

}  // namespace

TEST_F(AnEngine, ReceivesTheStateOfEachComponent) {
    world.advance(50ms);
    EXPECT_THAT(engine.received(), ElementsAre("1 component_changed navigation READY", "2 component_changed speech READY"));
    auto application = world.connect();
    application.bind("speech");
    engine.bind("navigation");
    world.advance(300ms);
    EXPECT_THAT(engine.received(), ElementsAre("3 component_changed speech BUSY")) << "its own binding changes nothing";
    world["speech"].status_now = ComponentStatus::error;
    application.release("speech");
    world.advance(300ms);
    EXPECT_THAT(engine.received(), ElementsAre("4 component_changed speech ERROR"));
    EXPECT_THAT(application.received(), IsEmpty()) << "of an application";
}

TEST_F(AnEngine, GetsTheTraitsOfComponents) {
    auto const entries = engine.ask(GetProfile{}).components;
    ASSERT_EQ(entries.size(), 2u);
    ASSERT_TRUE(entries[1].traits);
    EXPECT_EQ(entries[1].ref, "speech");
    EXPECT_EQ(entries[1].traits->alternatives, (std::vector<std::vector<std::string>>{{"speech_text", "SSML_text"}}));
    EXPECT_EQ(entries[1].traits->status_when_stopped, CompletedStatus::abort);
    EXPECT_FALSE(world.connect().ask(GetProfile{}).components[1].traits) << "an application";
}

TEST_F(AnEngine, GetsFramesAndPlaces) {
    Frame const map{.crs = "map", .base = "hall", .position = {1, 2, 3}, .orientation = {0, 0, 90}, .covariance = {}};
    NamedPlace const desk{"desk", {.crs = "hall", .low = {0, 0, 0}, .high = {1, 2, 0}}};
    NamedPlace const circle{"circle", {.crs = "hall", .shape = Geometry::Shape::circle, .paths = {{{0, 0}}}, .radius = 1}};
    world.engine->describe({.frames = {"hall", {map}}, .all = {desk, circle}});
    EXPECT_EQ(engine.ask(GetProfile{}).space, (Space{{map}, {desk}})) << "the circle is left out";
    EXPECT_EQ(world.connect().ask(GetProfile{}).space, Space{}) << "an application";
}

TEST_F(AnEngine, ReceivesAllRowsOfAQuery) {
    auto const row = [](std::string const& length) { return Results{{value("length", "double", {length})}, {}}; };
    world["navigation"].knows = {row("1"), row("2"), row("3")};
    auto const answer = engine.query("route", equal("length", "2"));
    EXPECT_EQ(in_words(answer.results.parameters), "length=2");
    ASSERT_EQ(answer.other_rows.size(), 2u);
    EXPECT_EQ(in_words(answer.other_rows[0].parameters), "length=1");
    EXPECT_EQ(in_words(answer.other_rows[1].parameters), "length=3");
    EXPECT_THAT(world.connect().query("route").other_rows, IsEmpty()) << "an application";
}

TEST_F(AnEngine, ReceivesLocationsAndParameters) {
    world["navigation"].where = Located{};
    world["navigation"].where->of = "robot";
    world["navigation"].where->ref = "robot1";
    world["navigation"].where->position = {1, 2, 0};
    world["navigation"].reads = ParameterList{texts("landmarks", {"desk"})};
    world.advance(300ms);
    engine.received();
    world["navigation"].reads = ParameterList{texts("landmarks", {"door"})};
    world["navigation"].where->position = {3, 4, 0};
    engine.bind("speech");  // the engine looks
    world.advance(300ms);
    EXPECT_THAT(engine.received(), ElementsAre(HasSubstr("component_changed navigation READY")));
    auto const changed = engine.last_received<ComponentChanged>();
    ASSERT_EQ(changed.results.located.size(), 1u);
    EXPECT_THAT(changed.results.located.front().position, ElementsAre(3, 4, 0));
}

TEST_F(AnEngine, ReceivesChangesAtMostFiveTimesASecond) {
    world.advance(1s);
    engine.received();
    for (int i = 0; i < 100; ++i) {
        world["speech"].status_now = i % 2 == 0 ? ComponentStatus::warning : ComponentStatus::ready;
        engine.ask(GetProfile{});
        world.advance(50ms);
    }
    auto const changes = engine.received();
    EXPECT_LE(changes.size(), 25u);
    EXPECT_GE(changes.size(), 20u);
    world.advance(200ms);
    engine.received();
    EXPECT_EQ(engine.last_received<ComponentChanged>().status, ComponentStatus::ready) << "the last state is not lost";
}

TEST_F(AnEngine, ReceivesTheStateOfNewComponents) {
    world.advance(50ms);
    engine.received();
    world.change({"speech"}, {detection});
    world.advance(50ms);
    EXPECT_THAT(engine.received(), ElementsAre("3 profile_changed", "4 component_changed detection READY"));
    world.change({"detection"}, {speech});
    world.advance(1s);
    EXPECT_THAT(engine.received(), testing::Contains(HasSubstr("component_changed speech READY")))
        << "another component of this name";
}

TEST_F(AnEngine, GetsTheResultsOfItsCommands) {
    for (auto* each : {"navigation", "speech"}) engine.bind(each);
    engine.execute(named("dock", command("dock", "navigation")));
    world["navigation"].finishes(CompletedStatus::ok, {.parameters = {value("charge", "int", {"80"})}, .located = {}},
                                 Afterwards::active);
    auto const docked = engine.notifications().read(0, 1'000).back().notification;
    auto const& completed = std::get<Completed>(docked->body);
    EXPECT_EQ(in_words(completed.results->parameters), "charge=80");
    EXPECT_EQ(completed.active, true);
    EXPECT_EQ(completed.reason, "");
    engine.execute(named("stop", stop("navigation")), named("resume", resume("navigation")));
    auto const resumed = engine.notifications().read(0, 1'000).back().notification;
    auto const& failed = std::get<Completed>(resumed->body);
    EXPECT_EQ(failed.status, CompletedStatus::error);
    EXPECT_EQ(failed.reason, engine.reason_of("resume"));
    EXPECT_EQ(failed.active, false);
}

TEST_F(AnEngine, GetsTheTextOfErrors) {
    auto application = world.connect();
    engine.bind("navigation");
    world["navigation"].reports(ErrorType::user_defined_error, "the bumper was touched");
    engine.received();
    EXPECT_EQ(engine.last_received<ReceiveError>().text, "the bumper was touched");
    engine.release("navigation");
    application.bind("navigation");
    world["navigation"].reports(ErrorType::user_defined_error, "again");
    application.received();
    EXPECT_EQ(application.last_received<ReceiveError>().text, std::nullopt) << "of an application";
}

TEST_F(AnEngine, ReceivesAtConnectThatEverythingIsStopped) {
    world.engine->stop_everything(world.now);
    auto another = world.connect(as_engine);
    another.received(1);
    EXPECT_THAT(another.last_received<ReceiveError>().text, testing::Optional(HasSubstr("stopped")));
}

TEST_F(AnEngine, LosesItsSessionWhenItIsSilentThoughItsLinkIsOpen) {
    engine.bind("navigation");
    engine.execute(go("go"));
    world.advance(4900ms);
    world.engine->note_pong(engine.session, world.now);
    world.advance(4900ms);
    EXPECT_EQ(engine.refusal_of(GetProfile{}), std::nullopt);
    world.advance(5100ms);
    EXPECT_EQ(engine.refusal_of(GetProfile{}), Refusal::no_session) << "2 s of silence, and the window";
    EXPECT_TRUE(engine.notifications().wants_signs_of_life(world.now.steady));
}

TEST_F(AnEngine, KeepsItsSessionWithRequestsOfAnyKind) {
    world.advance(4900ms);
    EXPECT_EQ(engine.ask(Connect{}).session, engine.session);
    world.advance(4900ms);
    EXPECT_EQ(engine.ask(Resume{engine.session, 0}).return_code, ReturnCode::ok);
    world.advance(4900ms);
    EXPECT_EQ(engine.refusal_of(GetProfile{}), std::nullopt);
}

TEST_F(AnEngine, KeepsItsSessionWithPongsAlsoIfTheyDoNotProveMotion) {
    EXPECT_EQ(engine.ask(Connect{.motion_lease = {}, .motion_lease_http = {}, .motion_proof = MotionProof::request}).return_code,
              ReturnCode::ok);
    world.advance(4900ms);
    world.engine->note_pong(engine.session, world.now);
    world.advance(4900ms);
    EXPECT_EQ(engine.refusal_of(GetProfile{}), std::nullopt);
}

// The other engine has its own time to confirm.
TEST_F(AnEngine, HasItsStopAnsweredWhenTheHaltIsConfirmed) {
    world["navigation"].halts_later = true;
    engine.bind("navigation");
    auto application = world.connect();
    engine.execute(named("stop", stop("navigation")));
    world.advance(900ms);
    EXPECT_EQ(engine.result_of("stop"), "RUNNING");
    engine.execute(named("again", stop("navigation")));
    world["navigation"].stands_still();
    EXPECT_EQ(engine.result_of("stop"), "OK");
    EXPECT_EQ(engine.result_of("again"), "OK");
}

TEST_F(AnEngine, HasItsStopsForgottenWithItsSession) {
    world["navigation"].halts_later = true;
    engine.bind("navigation");
    engine.execute(named("stop", stop("navigation")));
    engine.leave();
    world.advance(1s);
    world["navigation"].stands_still();
    EXPECT_THAT(world.engine->not_halted(), IsEmpty());
    auto other = world.connect();
    EXPECT_EQ(other.bind("navigation"), ReturnCode::ok);
}

TEST_F(AnEngine, HasAtMostEightStopsThatWaitForAHalt) {
    world["navigation"].halts_later = true;
    engine.bind("navigation");
    for (int i = 1; i <= 9; ++i) engine.execute(named("stop" + std::to_string(i), stop("navigation")));
    EXPECT_EQ(engine.result_of("stop1"), "TIMEOUT");
    EXPECT_EQ(engine.result_of("stop2"), "RUNNING");
}

// Its provider may run on another thread while the engine removes it.
TEST(ALogicalComponent, GetsNoSessionAgainAsItLeaves) {
    struct AskingAtTheEnd final : Trace {
        void session_ended(std::uint64_t, std::string_view why) override {
            EXPECT_EQ(why, "its logical component has left");
            port->ask(GetProfile{}, [](Reply const*) {});
        }
        ComponentPort* port = nullptr;
    } trace;
    World world{navigation};
    auto chooser = std::make_unique<Chooser>();
    auto const& its_port = chooser->port;
    world.engine->add(std::move(chooser));
    world.advance(100ms);
    ASSERT_EQ(world.engine->statistics().sessions, 1u);
    trace.port = its_port;
    world.engine->report_to(trace);
    world.change({"chooser"}, {});
    EXPECT_EQ(world.engine->statistics().sessions, 0u);
    world.advance(1s);
}

TEST(Window, IsTheTimeAfterWhichASessionWithoutALinkEnds) {
    World world{navigation};
    auto desk =
        world.connect({.motion_lease = {}, .motion_lease_http = {}, .motion_proof = {}, .is_engine = false, .window = 3000ms});
    world.engine->link_closed(desk.session, LinkKind::websocket, Closing::lost, world.now);
    world.advance(2900ms);
    world.engine->link_opened(desk.session, LinkKind::websocket, world.now);
    world.engine->link_closed(desk.session, LinkKind::websocket, Closing::lost, world.now);
    world.advance(2900ms);
    EXPECT_FALSE(desk.notifications_closed());
    world.advance(200ms);
    EXPECT_TRUE(desk.notifications_closed());
}

TEST(Window, IsAgreedWithinLimits) {
    World world{navigation};
    auto const asked = [&](std::chrono::milliseconds window) {
        Connect connection;
        connection.window = window;
        return std::get<Connect::Reply>(std::get<Reply>(world.say({}, connection)));
    };
    EXPECT_EQ(asked(3000ms).window, 3000ms);
    EXPECT_EQ(std::get<Connect::Reply>(std::get<Reply>(world.say({}, Connect{}))).window, std::nullopt) << "it was not asked for";
    EXPECT_EQ(asked(999ms).reason, "window must be 1000 to 30000 milliseconds, not 999");
    EXPECT_EQ(asked(30'001ms).return_code, ReturnCode::bad_parameter);
}

}  // namespace rois
