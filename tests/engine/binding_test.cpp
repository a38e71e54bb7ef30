// Decisions 4 to 7: binding, and the commands that need it.
#include "engine/conditions/conditions.hpp"
#include "engine/world.hpp"
#include "types/text/texts.hpp"

namespace rois {

TEST(Bind, OfAnUnknownComponentIsABadParameter) {
    World world{navigation};
    auto desk = world.connect();
    auto const refused = desk.ask(Bind{Application::identifier("../\r\n<x>")});
    EXPECT_EQ(refused.return_code, ReturnCode::bad_parameter);
    EXPECT_EQ(refused.reason, "unknown component '../  <x>'");
}

TEST(BindAny, KeepsToTheRobotThatTheSessionWorksWith) {
    World world{in_engine("robot1", navigation), in_engine("robot1", speech), in_engine("robot1", detection),
                in_engine("robot2", navigation), in_engine("robot2", speech), in_engine("robot2", detection)};
    auto const drives = equal("component_type", navigation.profile.object.identifier);
    auto const speaks = equal("component_type", speech.profile.object.identifier);
    auto const detects = equal("component_type", detection.profile.object.identifier);
    auto desk = world.connect(), hall = world.connect();
    EXPECT_EQ(hall.bind("robot1.navigation"), ReturnCode::ok);
    EXPECT_EQ(desk.bind_any(drives), "robot2.navigation") << "the other one is taken";
    EXPECT_EQ(desk.bind_any(speaks), "robot2.speech") << "of the robot that drives";
    EXPECT_EQ(hall.bind_any(speaks), "robot1.speech");
    EXPECT_EQ(desk.bind("robot1.detection"), ReturnCode::ok);
    EXPECT_EQ(desk.bind_any(detects), "robot2.detection") << "two components are more than one";
    for (auto const* ref : {"robot2.navigation", "robot2.speech", "robot2.detection"}) desk.release(ref);
    EXPECT_EQ(desk.bind_any(speaks), "robot2.speech") << "the other robot's are taken";
    desk.leave();
    hall.leave();
    EXPECT_EQ(world.connect().bind_any(either({speaks, detects})), "robot1.detection");
}

TEST(BindAny, PutsTheRobotBeforeTheOrderOfTheCondition) {
    World world{in_engine("robot1", navigation), in_engine("robot1", speech), in_engine("robot2", navigation),
                in_engine("robot2", speech)};
    auto const last_first = sorted(reference("component_ref"), SortOrder::descending);
    auto desk = world.connect();
    EXPECT_EQ(desk.bind_any(last_first), "robot2.speech");
    desk.release("robot2.speech");
    desk.bind("robot1.navigation");
    EXPECT_EQ(desk.bind_any(last_first), "robot1.speech");
    EXPECT_EQ(desk.bind_any(last_first), "robot2.speech") << "nothing of the first is free";
}

// Without the name of the sub engine, "robot2.navigation" sorts before "speech".
TEST(BindAny, ComparesCodesWithinTheirEngines) {
    World world{speech, in_engine("robot2", speech), in_engine("arm", named("tool", speech))};
    auto const speaks = equal("component_type", speech.profile.object.identifier);
    auto desk = world.connect();
    EXPECT_EQ(desk.bind_any(speaks), "speech");
    desk.leave();
    desk = world.connect();
    EXPECT_EQ(desk.query("component_status", speaks).component_ref.code, "speech");
}

TEST(Search, FindsAGroupOfOneRobot) {
    World world{in_engine("robot1", navigation), in_engine("robot1", speech), in_engine("robot2", navigation),
                in_engine("robot2", speech), in_engine("robot3", speech)};
    auto const both_of_them = group({.types = {"Navigation", "SpeechSynthesis"}, .aliases = {}, .filter = {}, .members = {}});
    auto desk = world.connect();
    EXPECT_THAT(desk.search(both_of_them), ElementsAre("robot1.navigation", "robot1.speech"));
    EXPECT_EQ(desk.ask(GetProfile{both_of_them}).profile->object.name, "robot1");
    desk.bind("robot3.speech");
    EXPECT_THAT(desk.search(both_of_them), ElementsAre("robot1.navigation", "robot1.speech")) << "robot3 has no navigation";
    desk.bind("robot2.speech");
    EXPECT_THAT(desk.search(both_of_them), ElementsAre("robot2.navigation", "robot2.speech"));
    EXPECT_EQ(desk.bind_any(both_of_them), "robot2.navigation");
    EXPECT_THAT(desk.search(either({both_of_them, equal("name", "robot3.speech")})),
                ElementsAre("robot2.navigation", "robot2.speech", "robot3.speech"));
    desk.subscribe("reached_target", both_of_them);
    for (auto const* ref : {"robot1.navigation", "robot2.navigation"}) world[ref].fires("reached_target");
    EXPECT_THAT(desk.received(), testing::SizeIs(2)) << "events are received from each robot that meets it";
}

struct GroupsOfTwoRobots : testing::Test {
    World world{in_engine("robot1", navigation),  in_engine("robot1", speech), in_engine("robot1", detection),
                in_engine("robot2", navigation),  in_engine("robot2", speech), in_engine("robot2", detection),
                in_engine("robot2", localization)};
    Application desk = world.connect(), hall = world.connect();
    Condition drives_and_speaks = group({.types = {"Navigation", "SpeechSynthesis"}, .aliases = {}, .filter = {}, .members = {}});
};

TEST_F(GroupsOfTwoRobots, AreBoundFromTheRobotThatHasAllOfThemFree) {
    hall.bind("robot1.speech");
    EXPECT_THAT(desk.search(drives_and_speaks), ElementsAre("robot2.navigation", "robot2.speech")) << "what bind_any takes";
    EXPECT_EQ(desk.bind_any(drives_and_speaks), "robot2.navigation");
    EXPECT_EQ(desk.bind_any(drives_and_speaks), "robot2.speech");
    EXPECT_EQ(desk.bind_any(drives_and_speaks), "robot2.navigation") << "nothing of robot1: the group is complete";
}

TEST_F(GroupsOfTwoRobots, AreBoundFromOneRobotHoweverOftenTheApplicationAsks) {
    std::vector<std::string> bound;
    for (int i = 0; i < 4; ++i) bound.push_back(desk.bind_any(drives_and_speaks));
    EXPECT_THAT(bound, ElementsAre("robot1.navigation", "robot1.speech", "robot1.navigation", "robot1.navigation"));
    EXPECT_EQ(hall.bind_any(drives_and_speaks), "robot2.navigation") << "no component of robot2 was taken";
}

TEST_F(GroupsOfTwoRobots, AreCompletedBeforeThoseOfTheRobotWithMoreOtherComponents) {
    EXPECT_EQ(desk.bind_any(drives_and_speaks), "robot1.navigation");
    for (auto const* ref : {"robot2.detection", "robot2.localization", "robot2.speech"}) desk.bind(ref);
    EXPECT_EQ(desk.bind_any(drives_and_speaks), "robot2.navigation") << "each has one of the group, robot2 more components";
    desk.release("robot2.navigation");
    desk.release("robot2.speech");
    EXPECT_EQ(desk.bind_any(drives_and_speaks), "robot1.speech") << "one of the group is more than none";
}

TEST_F(GroupsOfTwoRobots, ThatNoRobotCanProvideAreRefusedAndTheReasonNamesTheHolder) {
    hall.bind("robot1.speech");
    hall.bind("robot2.navigation");
    auto const refused = desk.ask(BindAny{drives_and_speaks});
    EXPECT_EQ(refused.return_code, ReturnCode::out_of_resources);
    EXPECT_EQ(refused.reason,
              "no robot can give all components of the group now; the component 'robot1.speech' is bound by another session, "
              "number 2");
    EXPECT_THAT(desk.search(equal("bound", "true")), ElementsAre("robot1.speech", "robot2.navigation"));
    EXPECT_EQ(desk.bind_any(either({drives_and_speaks, equal("name", "robot1.detection")})), "robot1.detection")
        << "not of the group";
    hall.release("robot2.navigation");
    EXPECT_EQ(desk.bind_any(drives_and_speaks), "robot2.navigation");
}

TEST_F(GroupsOfTwoRobots, StartOverWhenARobotCannotProvideTheRest) {
    EXPECT_EQ(desk.bind_any(drives_and_speaks), "robot1.navigation");
    hall.bind("robot1.speech");
    EXPECT_EQ(desk.bind_any(drives_and_speaks), "robot2.navigation");
    EXPECT_EQ(desk.bind_any(drives_and_speaks), "robot2.speech");
    EXPECT_EQ(desk.bind_any(drives_and_speaks), "robot2.navigation");
}

TEST_F(GroupsOfTwoRobots, MustBeFreeAlsoIfTheConditionHasOtherParts) {
    hall.bind("robot1.speech");
    auto const of_type = [](Part const& part) { return equal("component_type", part.profile.object.identifier); };
    EXPECT_EQ(desk.bind_any(both({drives_and_speaks, of_type(navigation)})), "robot2.navigation");
    EXPECT_EQ(desk.bind_any(both({drives_and_speaks, of_type(speech)})), "robot2.speech");
    QueryExpression last_first = sorted(reference("component_ref"), SortOrder::descending);
    last_first.filter = drives_and_speaks;
    EXPECT_EQ(hall.bind_any(last_first), "robot1.navigation") << "the session has the other one";
    desk.leave();
    EXPECT_EQ(world.connect().bind_any(last_first), "robot2.speech");
}

TEST_F(GroupsOfTwoRobots, MayRequireComponentsThatNoOtherSessionHasBound) {
    auto const free = [](Part const& part) {
        return both({equal("component_type", part.profile.object.identifier), equal("bound", "false")});
    };
    auto const free_ones = group({.types = {}, .aliases = {}, .filter = {}, .members = {free(navigation), free(speech)}});
    std::vector<std::string> bound;
    for (int i = 0; i < 4; ++i) bound.push_back(desk.bind_any(free_ones));
    EXPECT_THAT(bound, ElementsAre("robot1.navigation", "robot1.speech", "robot1.navigation", "robot1.navigation"))
        << "its own binding does not count";
    EXPECT_EQ(hall.bind_any(free_ones), "robot2.navigation");
    EXPECT_THAT(desk.search(equal("bound", "false")), testing::Not(testing::Contains("robot1.navigation")))
        << "outside of groups, any session counts";
    auto const all_free = group({.types = {"Navigation", "SpeechSynthesis"},
                                 .aliases = {"a", "b"},
                                 .filter = {both({equal("a/bound", "false"), equal("b/bound", "false")})},
                                 .members = {}});
    EXPECT_EQ(hall.bind_any(all_free), "robot2.speech");
}

TEST(BindAny, OfAGroupTakesComponentsThatTheSessionLacksFirst) {
    World world{named("navigation_a", navigation), named("navigation_b", navigation), speech};
    auto desk = world.connect();
    auto const drives_and_speaks =
        group({.types = {"Navigation", "SpeechSynthesis"}, .aliases = {}, .filter = {}, .members = {}});
    std::vector<std::string> bound;
    for (int i = 0; i < 4; ++i) bound.push_back(desk.bind_any(drives_and_speaks));
    EXPECT_THAT(bound, ElementsAre("navigation_a", "speech", "navigation_b", "navigation_a"))
        << "others of the same robot, then one that the session has bound";
}

TEST(BindAny, DistinguishesImpossibleConditionsFromTakenComponents) {
    World world{navigation, speech};
    auto desk = world.connect(), hall = world.connect();
    EXPECT_EQ(desk.bind_any(equal("component_ref", "gripper")), "UNSUPPORTED");
    EXPECT_EQ(desk.bind_any(both({equal("component_ref", "speech"), equal("component_ref", "navigation")})), "UNSUPPORTED");
    EXPECT_EQ(desk.bind_any(equal("status", "WARNING")), "OUT_OF_RESOURCES") << "the status may still change";
    EXPECT_EQ(desk.bind_any(equal("component_ref", "speech")), "speech");
    EXPECT_EQ(hall.bind_any(equal("component_ref", "speech")), "OUT_OF_RESOURCES");
    EXPECT_EQ(hall.bind_any(both({equal("component_ref", "speech"), equal("status", "READY")})), "OUT_OF_RESOURCES");
    EXPECT_EQ(hall.bind_any(equal("status", "READY")), "navigation") << "speech is BUSY for the hall";
    EXPECT_EQ(hall.bind_any(equal("colour", "red")), "BAD_PARAMETER");
    EXPECT_EQ(hall.bind_any(not_understood("what is this")), "BAD_PARAMETER");
}

TEST(BindAny, InAnEngineWithoutComponentsIsUnsupported) {
    World world{std::vector<Part>{}, {}};
    EXPECT_EQ(world.connect().bind_any(), "UNSUPPORTED");
}

TEST(Binding, IsRequiredForCommands) {
    World world{navigation};
    auto desk = world.connect(), hall = world.connect();
    hall.bind("navigation");
    hall.received();
    EXPECT_EQ(desk.get_parameter("navigation").return_code, ReturnCode::error);
    EXPECT_THAT(desk.get_parameter("navigation").reason, HasSubstr("is not bound by this session"));
    EXPECT_EQ(desk.set_parameter("navigation", {integer("time_limit", 7)}).return_code, ReturnCode::error);
    EXPECT_EQ(desk.execute(go("go")).return_code, ReturnCode::error);
    EXPECT_THAT(world["navigation"].calls, IsEmpty());
    EXPECT_EQ(in_words(hall.get_parameter("navigation").parameters), "time_limit=0 routing_policy=time");
    EXPECT_EQ(desk.get_parameter("gripper").return_code, ReturnCode::bad_parameter);
    EXPECT_EQ(desk.set_parameter("gripper", {}).return_code, ReturnCode::bad_parameter);
}

TEST(Release, StopsTheRunningAction) {
    World world{navigation, speech};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.bind("speech");
    desk.execute(go("go"), say("arrived"));
    desk.execute(say("meanwhile"));
    EXPECT_EQ(desk.release("navigation"), ReturnCode::ok);
    EXPECT_THAT(world["navigation"].calls, ElementsAre("start", "halt", "parameters_changed"));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go ABORT", "2 completed arrived ABORT"));
    EXPECT_EQ(desk.result_of("meanwhile"), "RUNNING") << "a component that stays bound is not affected";
    EXPECT_EQ(world.connect().bind("navigation"), ReturnCode::ok);
}

TEST(Release, StopsACommandOfTheComponentsOwn) {
    World world{navigation};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.execute(named("dock", command("dock", "navigation")));
    desk.release("navigation");
    EXPECT_THAT(world["navigation"].calls, ElementsAre("dock", "halt"));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed dock ABORT"));
}

TEST(Profile, ListsTheComponentsAndTheirEngines) {
    World world{navigation, in_engine("sub1", speech), in_engine("sub1", navigation)};
    auto desk = world.connect();
    auto const reply = desk.ask(GetProfile{});
    EXPECT_THAT(reply.profile->components, ElementsAre("navigation"));
    ASSERT_EQ(reply.profile->sub_profiles.size(), 1U);
    EXPECT_EQ(reply.profile->sub_profiles.front().object.name, "sub1");
    EXPECT_THAT(reply.profile->sub_profiles.front().components, ElementsAre("sub1.speech", "sub1.navigation"));
    ASSERT_EQ(reply.components.size(), 3U);
    EXPECT_EQ(reply.components[0].type, "urn:x-rois:def:component:OMG::Navigation");
    EXPECT_EQ(reply.components[2].ref, "sub1.speech");
    EXPECT_EQ(reply.components[2].engine, "sub1");
}

TEST(Profile, OfTheComponentsOfOneSubEngineIsTheProfileOfThatEngine) {
    World world{navigation, in_engine("sub1", speech), in_engine("sub1", navigation), in_engine("sub2", speech)};
    auto desk = world.connect();
    auto const engine = [&](Condition condition) {
        auto const profile = desk.ask(GetProfile{std::move(condition)}).profile;
        return profile->sub_profiles.empty() ? profile->object.name : "main";
    };
    EXPECT_EQ(engine(equal("engine", "sub1")), "sub1");
    EXPECT_EQ(engine(both({equal("component_type", speech.profile.object.identifier), equal("engine", "sub2")})), "sub2");
    EXPECT_EQ(engine(equal("component_type", speech.profile.object.identifier)), "main") << "two engines have such a component";
    EXPECT_EQ(engine(equal("engine", "main")), "main");
    EXPECT_EQ(engine(equal("engine", "")), "main");
    EXPECT_EQ(engine(equal("name", "navigation")), "main");
    EXPECT_EQ(engine(equal("engine", "nowhere")), "main");
    EXPECT_EQ(desk.ask(GetProfile{equal("engine", "sub1")}).profile->components.size(), 2U);
}

TEST(Profile, OfTheWholeEngineIsTheProfileOfTheMainEngineAlsoWithASingleRobot) {
    World world{in_engine("robot1", navigation), in_engine("robot1", speech)};
    auto desk = world.connect();
    for (auto const& whole : {QueryExpression{}, QueryExpression{equal("engine", "main")}, QueryExpression{equal("engine", "")}})
        EXPECT_EQ(desk.ask(GetProfile{whole}).profile->object.name, "main");
    EXPECT_EQ(desk.ask(GetProfile{equal("engine", "robot1")}).profile->object.name, "robot1");
    EXPECT_THAT(desk.ask(GetProfile{}).profile->components, IsEmpty());
}

// Decision 31: the other attributes of a component_ref must be those of the component.
TEST(ComponentRef, OfAForeignCodebookOrAuthorityIsRefusedByAllOperations) {
    World world{named("speech_synthesis", speech)};
    auto desk = world.connect();
    auto ref = Application::identifier("speech_synthesis");
    auto const bind = [&] { return desk.ask(Bind{ref}); };
    ref.codebook_ref = "urn:x-test:Other";
    EXPECT_EQ(bind().return_code, ReturnCode::bad_parameter);
    EXPECT_EQ(bind().reason,
              "the component_ref 'speech_synthesis' has the codebook_ref 'urn:x-test:Other', which is not the "
              "component's; expected one of " +
                  speech.profile.object.identifier);
    EXPECT_EQ(desk.ask(Release{ref}).reason, bind().reason);
    EXPECT_EQ(desk.ask(GetParameter{ref}).reason, bind().reason);
    EXPECT_EQ(desk.ask(SetParameter{ref, {}}).reason, bind().reason);
    auto message = start("speech_synthesis");
    std::get<CommandMessage>(message.unit).component_ref = ref;
    EXPECT_EQ(desk.execute(message).reason, "command_unit_list[1]: " + bind().reason);
    ref.codebook_ref = lower_case(speech.profile.object.identifier);
    EXPECT_EQ(bind().return_code, ReturnCode::ok);
    ref.codebook_ref = "urn:x-rois:def:codebook:ComponentType";
    EXPECT_EQ(bind().return_code, ReturnCode::ok) << "as in Annex B.2";
    ref.authority = "somebody";
    EXPECT_EQ(bind().reason,
              "the component_ref 'speech_synthesis' has the authority 'somebody', which is not the component's; "
              "expected one of OMG");
}

}  // namespace rois
