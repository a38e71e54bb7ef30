// What sessions with rights see and command (docs/trust.md).
#include "engine/conditions/conditions.hpp"
#include "engine/world.hpp"

namespace rois {

namespace {

std::shared_ptr<Rights const> rights(std::vector<std::string> sees, std::vector<std::string> commands = {"*"}) {
    return std::make_shared<Rights const>("desk", std::move(sees), std::move(commands));
}

Part named(std::string const& ref, Part part, std::string const& engine = "") {
    part.ref = ref;
    part.engine = engine;
    return part;
}

struct OneOfTwoRobots : testing::Test {
    World world{named("one.navigation", navigation, "one"), named("two.navigation", navigation, "two"), speech};
    Application of_one = world.connect_as(rights({"one.*"}));
};

}  // namespace

TEST_F(OneOfTwoRobots, ShowOnlyTheOneThatTheClientMaySee) {
    EXPECT_THAT(of_one.search(), ElementsAre("one.navigation"));
    EXPECT_EQ(of_one.bind_any(equal("component_ref", "two.navigation")), "UNSUPPORTED");
    EXPECT_EQ(of_one.bind("two.navigation"), ReturnCode::bad_parameter);
    EXPECT_EQ(of_one.bind_any(), "one.navigation");
    auto const profile = of_one.ask(GetProfile{});
    ASSERT_EQ(profile.components.size(), 1u);
    EXPECT_EQ(profile.components.front().ref, "one.navigation");
    ASSERT_EQ(profile.profile->sub_profiles.size(), 1u);
    EXPECT_EQ(profile.profile->sub_profiles.front().object.name, "one");
    EXPECT_THAT(profile.profile->components, IsEmpty());
    EXPECT_EQ(of_one.query("route", equal("component_ref", "two.navigation")).return_code, ReturnCode::unsupported);
    EXPECT_EQ(of_one.query("component_status", equal("component_ref", "speech")).return_code, ReturnCode::unsupported);
    EXPECT_EQ(of_one.query("route").component_ref.code, "one.navigation");
}

TEST_F(OneOfTwoRobots, LetConditionsNameOnlyWhatTheClientSees) {
    auto everyone = world.connect();
    EXPECT_EQ(everyone.ask(Search{equal("volume", "1")}).return_code, ReturnCode::ok) << "a parameter of speech";
    for (auto const* name : {"volume", "nonsense"}) {
        auto const refused = of_one.ask(Search{equal(name, "1")});
        EXPECT_EQ(refused.return_code, ReturnCode::bad_parameter);
        EXPECT_THAT(refused.reason, testing::AllOf(HasSubstr("is not known here"), HasSubstr("Property/target_position"),
                                                   testing::Not(HasSubstr("Property/volume"))));
    }
}

TEST_F(OneOfTwoRobots, LetConditionsOnDetailsNameOnlyWhatTheClientSees) {
    world.engine->describe({.frames = {"hall"}, .all = {}});
    Belongings of_two{.profiles = {}, .frames = {}, .places = {{"two.lab", box(0, 0, 1'000, 1'000, "hall")}}};
    world.engine->change({{}, {}, std::move(of_two), "two"}, world.now);
    auto everyone = world.connect();
    for (auto* client : {&everyone, &of_one}) client->subscribe("reached_target");
    world["one.navigation"].fires("reached_target");
    auto const reason = [](Application& client) {
        client.received();
        auto const event = client.last_received<ReceiveEvent>().event_id;
        return client.ask(GetEventDetail{event, within("located", literal("nonsense"))}).reason;
    };
    EXPECT_THAT(reason(everyone), HasSubstr("two.lab"));
    EXPECT_THAT(reason(of_one), testing::Not(HasSubstr("two.lab")));
}

TEST(RightsOfOneComponent, LetGroupsConsistOnlyOfWhatTheClientSees) {
    World world{named("one.navigation", navigation, "one"), named("one.speech", speech, "one")};
    auto desk = world.connect_as(rights({"one.speech"})), everyone = world.connect();
    auto const both = group({.types = {"Navigation", "SpeechSynthesis"}, .aliases = {}, .filter = {}, .members = {}});
    EXPECT_THAT(desk.search(both), IsEmpty());
    EXPECT_THAT(everyone.search(both), ElementsAre("one.navigation", "one.speech"));
    everyone.bind("one.navigation");
    EXPECT_THAT(desk.search(both), IsEmpty());
    EXPECT_THAT(desk.ask(BindAny{both}).reason, testing::Not(HasSubstr("one.navigation")));
}

TEST_F(OneOfTwoRobots, DoNotLetTheClientEndAStopOfAnother) {
    auto chief = world.connect();
    chief.ask(StopEverything{});
    chief.leave();
    auto const stop = of_one.ask(StopEverything{}).stop;
    of_one.ask(ClearStop{});
    of_one.ask(ClearStop{stop.value_or(ClearStop::own)});
    EXPECT_TRUE(world.engine->everything_is_stopped());
    auto engine = world.connect_as(nullptr, {.motion_lease = {}, .motion_lease_http = {}, .motion_proof = {}, .is_engine = true});
    engine.ask(StopEverything{});
    engine.ask(ClearStop{});
    EXPECT_TRUE(world.engine->everything_is_stopped()) << "it was not an engine's";
    auto next = world.connect();
    next.ask(StopEverything{});
    next.ask(ClearStop{});
    EXPECT_FALSE(world.engine->everything_is_stopped());
}

TEST_F(OneOfTwoRobots, SendOnlyChangesOfTheProfileThatTheClientSees) {
    auto everyone = world.connect();
    world.change({}, {named("two.speech", speech, "two")});
    EXPECT_THAT(of_one.received(), IsEmpty());
    EXPECT_THAT(everyone.received(), testing::Contains(HasSubstr("profile_changed")));
    world.advance(std::chrono::seconds{2});
    world.change({}, {named("one.speech", speech, "one")});
    EXPECT_THAT(of_one.received(), testing::Contains(HasSubstr("profile_changed")));
}

TEST_F(OneOfTwoRobots, KeepEventsThatDoNotMatchTheirConditions) {
    World keeping{{named("one.navigation", navigation, "one")}, {.max_kept_events = 10}};
    auto desk = keeping.connect_as(rights({"one.*"})), other = keeping.connect();
    desk.subscribe("reached_target", equal("component_ref", "another"));
    keeping["one.navigation"].fires("reached_target");
    EXPECT_THAT(desk.received(), IsEmpty());
    other.subscribe("reached_target");
    EXPECT_THAT(other.received(), testing::SizeIs(1)) << "it was delivered to no session";
}

TEST_F(OneOfTwoRobots, SendOnlyTheEventsOfTheOne) {
    auto everyone = world.connect();
    of_one.subscribe("reached_target");
    everyone.subscribe("reached_target");  // the same subscription
    world["two.navigation"].fires("reached_target");
    world["one.navigation"].fires("reached_target");
    EXPECT_THAT(of_one.received(), ElementsAre("1 reached_target one.navigation"));
    EXPECT_THAT(everyone.received(), ElementsAre("1 reached_target two.navigation", "2 reached_target one.navigation"));
}

TEST_F(OneOfTwoRobots, SendOnlyTheErrorsOfTheOne) {
    of_one.subscribe("reached_target");
    world["two.navigation"].reports(ErrorType::component_internal_error, "the wheel of two");
    world["one.navigation"].reports(ErrorType::component_internal_error, "the wheel of one");
    EXPECT_THAT(of_one.received(), ElementsAre("1 COMPONENT_INTERNAL_ERROR one.navigation"));
}

TEST_F(OneOfTwoRobots, TellAnotherEngineOnlyTheStateOfTheOne) {
    auto engine =
        world.connect_as(rights({"one.*"}), {.motion_lease = {}, .motion_lease_http = {}, .motion_proof = {}, .is_engine = true});
    world.advance(50ms);
    EXPECT_THAT(engine.received(), ElementsAre("1 component_changed one.navigation READY"));
}

TEST(Rights, LetTheEngineKeepAnEventThatNobodyMayReceive) {
    EngineSettings settings;
    settings.max_kept_events = 10;
    World world{{navigation, speech}, settings};
    auto blind = world.connect_as(rights({"speech"}));
    auto desk = world.connect();
    auto const subscribed = desk.subscribe("reached_target");
    desk.unsubscribe(subscribed.subscribe_id);
    EXPECT_EQ(blind.subscribe("reached_target").return_code, ReturnCode::unsupported);
    world["navigation"].fires("reached_target");
    EXPECT_THAT(blind.received(), IsEmpty());
    desk.subscribe("reached_target");
    EXPECT_THAT(desk.received(), ElementsAre("1 reached_target navigation"));
}

TEST_F(OneOfTwoRobots, NameOnlyTheOneThatDoesNotHalt) {
    world["one.navigation"].halts_later = world["two.navigation"].halts_later = true;
    EXPECT_THAT(of_one.ask(StopEverything{}).not_halted, ElementsAre("one.navigation"));
}

TEST(Rights, ToSeeAreNotThoseToCommand) {
    World world{navigation, speech};
    auto desk = world.connect_as(rights({"*"}, {"speech"}));
    EXPECT_EQ(desk.refusal_of(Bind{Application::identifier("navigation")}), Refusal::not_allowed);
    EXPECT_EQ(desk.bind_any(equal("component_ref", "navigation")), "UNSUPPORTED");
    EXPECT_EQ(desk.bind_any(), "speech");
    EXPECT_THAT(desk.search(), ElementsAre("navigation", "speech"));
    EXPECT_EQ(desk.status_of("navigation"), "READY");
}

TEST(Rights, CoverEverythingOnlyWithAStar) {
    EXPECT_TRUE(rights({"*"})->sees_everything());
    for (auto const* pattern : {"[!n]*", "?", "?*", "[*]", "navigation"})
        EXPECT_FALSE(rights({pattern})->sees_everything()) << pattern;
}

TEST(Rights, CoverAnEngineIfAPatternFitsAllItsComponents) {
    for (auto const* pattern : {"*", "robot2.*", "robot*", "r?bot2.*"})
        EXPECT_TRUE(rights({pattern})->sees_all_of("robot2.")) << pattern;
    for (auto const* pattern : {"*.a*", "robot2.navigation", "robot2", "robot1.*", "robot2.[a-z]*"})
        EXPECT_FALSE(rights({pattern})->sees_all_of("robot2.")) << pattern;
}

TEST(Rights, BelongToTheirSessions) {
    World world{navigation};
    auto const own = rights({"*"}), equal = rights({"*"});
    auto desk = world.connect_as(own);
    auto const with = [&](std::shared_ptr<Rights const> const& other) {
        return world.engine->begin_to_handle(desk.session, GetProfile{}, world.now, other)->said.value();
    };
    EXPECT_TRUE(std::holds_alternative<Reply>(with(own)));
    EXPECT_EQ(std::get<Refusal>(with(equal)), Refusal::no_session) << "they are compared by address";
    EXPECT_EQ(std::get<Refusal>(with(nullptr)), Refusal::no_session);
    auto const resumed = world.engine->begin_to_handle({}, Resume{desk.session, 0}, world.now, equal);
    EXPECT_EQ(std::get<Refusal>(resumed->said.value()), Refusal::no_session);
}

TEST(Rights, ThatAreWithdrawnEndTheirSessionsAndAllTheirCommands) {
    for (auto const at_its_end : {OnSessionEnd::stop, OnSessionEnd::continue_}) {
        World world{{navigation, speech}, {.on_session_end = at_its_end}};
        auto const of_desk = rights({"*"});
        auto desk = world.connect_as(of_desk);
        auto other = world.connect_as(rights({"*"}));
        desk.bind("speech");
        desk.execute(say("say-1"));
        desk.received();
        of_desk->withdraw();
        world.engine->end_withdrawn(world.now);
        EXPECT_THAT(desk.received(), ElementsAre("1 completed say-1 ABORT"));
        EXPECT_TRUE(desk.notifications_closed());
        EXPECT_THAT(world["speech"].calls, ElementsAre("start", "halt", "parameters_changed"));
        EXPECT_EQ(other.bind("speech"), ReturnCode::ok);
    }
}

}  // namespace rois
