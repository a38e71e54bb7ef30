// Which sessions receive errors, and during which time (7.4.1.2); ends of commands that the notes below tables 7 and 8 leave
// open.
#include "engine/conditions/conditions.hpp"
#include "engine/world.hpp"

namespace rois {

namespace {

// Advances until the test makes it fail.
struct Floor : Device {
    bool breaks = false;
    void advance(Instant) override {
        if (breaks) throw std::runtime_error("the floor is gone");
    }
};

void reports(World& world, std::string const& ref) { world[ref].reports(ErrorType::user_defined_error, "a wheel is stuck"); }

}  // namespace

TEST(ErrorsOfTheEngine, AreReportedFromConnectToDisconnect) {
    World world{navigation};
    auto const floor = std::make_shared<Floor>();
    world.engine->add(floor);
    auto gone = world.connect(), here = world.connect();
    gone.leave();
    floor->breaks = true;
    world.advance(100ms);
    auto late = world.connect();
    world.advance(100ms);
    EXPECT_THAT(here.received(), ElementsAre("1 ENGINE_INTERNAL_ERROR"));
    EXPECT_THAT(gone.received(), IsEmpty());
    EXPECT_THAT(late.received(), IsEmpty());
}

TEST(ErrorsOfAComponent, AreReportedFromBindToRelease) {
    World world{navigation};
    auto desk = world.connect();
    reports(world, "navigation");
    EXPECT_THAT(desk.received(), IsEmpty());
    desk.bind("navigation");
    reports(world, "navigation");
    EXPECT_THAT(desk.received(), ElementsAre("1 USER_DEFINED_ERROR navigation"));
    desk.release("navigation");
    reports(world, "navigation");
    EXPECT_THAT(desk.received(), IsEmpty());
    desk.bind_any();
    reports(world, "navigation");
    EXPECT_THAT(desk.received(), ElementsAre("2 USER_DEFINED_ERROR navigation"));
}

TEST(ErrorsOfAComponent, AreReportedFromSubscribeToUnsubscribe) {
    World world{navigation};
    auto desk = world.connect();
    auto const id = desk.subscribe("reached_target").subscribe_id;
    reports(world, "navigation");
    EXPECT_THAT(desk.received(), ElementsAre("1 USER_DEFINED_ERROR navigation"));
    desk.unsubscribe(id);
    reports(world, "navigation");
    EXPECT_THAT(desk.received(), IsEmpty());
}

TEST(ErrorsOfAComponent, HaveAnIdEach) {
    World world{navigation};
    auto desk = world.connect();
    desk.bind("navigation");
    std::vector<std::string> ids;
    for (int i = 0; i < 2; ++i) {
        reports(world, "navigation");
        desk.received();
        ids.push_back(desk.last_received<ReceiveError>().error_id.text);
    }
    EXPECT_NE(ids[0], ids[1]);
    for (auto const& id : ids) EXPECT_EQ(desk.detail_of(ErrorId{id}).return_code, ReturnCode::ok);
}

// An adapter for a robot in another process, which has ended.
TEST(ErrorsOfAComponent, WhoseProcessIsGoneAreNotResponding) {
    World world{navigation, speech};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.bind("speech");
    desk.execute(go("go"), say("arrived"));
    world["navigation"].reports(ErrorType::component_not_responding, "the robot does not answer any more");
    world["navigation"].finishes(CompletedStatus::error);
    EXPECT_THAT(desk.received(),
                ElementsAre("1 COMPONENT_NOT_RESPONDING navigation", "2 completed go ERROR", "3 completed arrived ABORT"));
    EXPECT_EQ(desk.execute(say("still well")).return_code, ReturnCode::ok);
}

TEST(Settings, HaveTheDefaultsOfTheDecisions) {
    EngineSettings const settings;
    EXPECT_EQ(settings.session_timeout, 60s);
    EXPECT_EQ(settings.resume_window, 30s);
    EXPECT_EQ(settings.on_session_end, OnSessionEnd::stop);
    EXPECT_EQ(settings.start_timeout, 5s);
    EXPECT_EQ(settings.max_command_results, 1'000U);
    EXPECT_EQ(settings.command_results, 10min);
    EXPECT_EQ(settings.event_details, 60s);
    EXPECT_EQ(settings.error_details, 10min);
    EXPECT_EQ(settings.max_waiting_notifications, 1'024U);
    EXPECT_EQ(settings.max_sent_notifications, 1'024U);
    EXPECT_EQ(settings.max_sessions, 1'000U);
}

// 7.5.1: get_profile can select an engine by its position and by its components.
TEST(Profile, MayBeChosenByPlace) {
    World world{navigation, in_engine("sub1", navigation), in_engine("sub1", speech)};
    world.engine->describe({.frames = {"hall"}, .all = {{"desk", box(0, 0, 1'000, 1'000, "hall")}}});
    auto const stands = [&](std::string const& ref, double x) {
        world[ref].where = Located{"location", ref, "hall", {x, 500, 0}, {}, {}};
    };
    stands("navigation", 5'000);
    stands("sub1.navigation", 500);
    stands("sub1.speech", 500);
    auto desk = world.connect();
    auto const chosen = [&](Condition condition) {
        std::vector<std::string> refs;
        for (auto const& component : desk.ask(GetProfile{std::move(condition)}).components) refs.push_back(component.ref);
        return refs;
    };
    EXPECT_THAT(chosen(within("location", literal("desk"))), ElementsAre("sub1.navigation", "sub1.speech"));
    EXPECT_THAT(chosen(equal("engine", "sub1")), ElementsAre("sub1.navigation", "sub1.speech"));
}

// Annex B.1: A, B, then C and D in parallel with E, then F after both branches.
TEST(AnnexB, TheSequenceRunsInItsOrder) {
    World world{named("a", speech), named("c", navigation), named("e", speech)};
    auto desk = world.connect();
    for (auto const* ref : {"a", "c", "e"}) desk.bind(ref);
    desk.execute(say("A", "a"), say("B", "a"), branches({{go("C", "c"), go("D", "c")}, {say("E", "e")}}), say("F", "a"));
    auto const running = [&] {
        std::string names;
        for (auto const* id : {"A", "B", "C", "D", "E", "F"})
            if (desk.result_of(id) == "RUNNING") names += id;
        return names;
    };
    EXPECT_EQ(running(), "A");
    world["a"].finishes();
    EXPECT_EQ(running(), "B");
    world["a"].finishes();
    EXPECT_EQ(running(), "CE");
    world["e"].finishes();
    world["c"].finishes();
    EXPECT_EQ(running(), "D");
    world["c"].finishes();
    EXPECT_EQ(running(), "F");
    world["a"].finishes();
    EXPECT_THAT(desk.received(), ElementsAre("1 completed A OK", "2 completed B OK", "3 completed E OK", "4 completed C OK",
                                             "5 completed D OK", "6 completed F OK"));
}

// Annex B.2: set_parameter with an empty command_id, and a component_ref with more attributes than the code.
TEST(AnnexB, TheCommandMessageGetsItsId) {
    World world{named("speech_synthesis", speech)};
    auto desk = world.connect();
    desk.bind("speech_synthesis");
    auto message = set("speech_synthesis", {text("speech_text", "hello"), integer("volume", 10), text("language", "en")});
    std::get<CommandMessage>(message.unit).component_ref.codebook_ref = "urn:x-rois:def:codebook:ComponentType";
    std::get<CommandMessage>(message.unit).component_ref.version = "0.1";
    auto const reply = desk.execute(message);
    auto const ids = ids_of(reply.command_unit_list.command_unit_list);
    ASSERT_EQ(ids.size(), 1U) << reply.reason;
    EXPECT_NE(ids[0], "");
    EXPECT_THAT(desk.received(), ElementsAre("1 completed " + ids[0] + " OK"));
    EXPECT_EQ(in_words(desk.get_parameter("speech_synthesis").parameters), "speech_text=hello volume=10 language=en");
    auto const as_printed = set("speech_synthesis", {value("language", "Integer", {"en"})});
    EXPECT_THAT(desk.execute(as_printed).reason, HasSubstr("'language' is declared as 'Integer', its type is string"));
}

}  // namespace rois
