// Decision 18: a query goes to the component that can answer it best.
#include "engine/conditions/conditions.hpp"
#include "engine/world.hpp"

namespace rois {

TEST(Query, AnswerNamesTheComponent) {
    World world{navigation, speech};
    auto desk = world.connect();
    auto const reply = desk.query("route");
    EXPECT_EQ(reply.return_code, ReturnCode::ok);
    EXPECT_EQ(reply.component_ref, (Identifier{"navigation", "OMG", {}, {}}));
    EXPECT_EQ(in_words(reply.results.parameters), "length=2.5");
}

TEST(Query, PrefersAReadyComponentThenTheLowestRef) {
    World world{named("robot_a", navigation), named("robot_b", navigation), named("robot_c", navigation)};
    auto desk = world.connect(), hall = world.connect();
    EXPECT_EQ(desk.query("route").component_ref.code, "robot_a");
    hall.bind("robot_a");
    EXPECT_EQ(desk.query("route").component_ref.code, "robot_b");
    EXPECT_EQ(hall.query("route").component_ref.code, "robot_a");
    world["robot_b"].status_now = ComponentStatus::warning;
    EXPECT_EQ(desk.query("route").component_ref.code, "robot_c");
    world["robot_c"].status_now = ComponentStatus::error;
    EXPECT_EQ(desk.query("route").component_ref.code, "robot_a") << "when none is READY";
}

namespace {

Results route(std::string length, std::string to) {
    return {{value("length", "double", {std::move(length)}), value("to", "string", {std::move(to)})}, {}};
}

}  // namespace

TEST(Query, IsAnsweredWithTheFirstRowThatMatches) {
    World world{navigation};
    auto desk = world.connect();
    world["navigation"].knows = {route("2.5", "desk"), route("7", "door"), route("9", "door")};
    EXPECT_EQ(in_words(desk.query("route").results.parameters), "length=2.5 to=desk") << "without a condition, the first";
    EXPECT_EQ(in_words(desk.query("route", equal("to", "door")).results.parameters), "length=7 to=door");
    EXPECT_EQ(in_words(desk.query("route", equal("Result/length", "9.0")).results.parameters), "length=9 to=door");
    EXPECT_EQ(in_words(desk.query("route", sorted(reference("length"), SortOrder::descending)).results.parameters),
              "length=9 to=door");
    auto const none = desk.query("route", equal("to", "moon"));
    EXPECT_EQ(none.return_code, ReturnCode::unsupported);
    EXPECT_EQ(none.reason, "no component that matches the condition answers query 'route'");
}

TEST(Query, FindsTheComponentThatHasTheRow) {
    World world{named("robot_a", navigation), named("robot_b", navigation), named("robot_c", navigation)};
    auto desk = world.connect();
    world["robot_a"].knows = {route("1", "desk")};
    world["robot_b"].knows = {route("5", "desk"), route("3", "door")};
    world["robot_c"].knows = {route("2", "door")};
    EXPECT_EQ(desk.query("route", equal("to", "door")).component_ref.code, "robot_b");
    EXPECT_EQ(desk.query("route", both({equal("to", "door"), equal("component_ref", "robot_c")})).component_ref.code, "robot_c");
    auto nearest_door = sorted(reference("length"));
    nearest_door.filter = equal("to", "door");
    EXPECT_EQ(desk.query("route", nearest_door).component_ref.code, "robot_c");
    world["robot_b"].status_now = ComponentStatus::warning;
    EXPECT_EQ(desk.query("route", equal("to", "door")).component_ref.code, "robot_c") << "a READY one comes first";
    world["robot_c"].throws_in = {"query"};
    EXPECT_EQ(desk.query("route", equal("to", "door")).component_ref.code, "robot_b") << "a component that fails has no rows";
}

TEST(Query, AsksOnlyComponentsThatMayMatch) {
    World world{named("robot_a", navigation), named("robot_b", navigation)};
    auto desk = world.connect();
    world["robot_a"].throws_in = {"query"};
    EXPECT_EQ(desk.query("route", both({equal("name", "robot_b"), equal("length", "2.5")})).component_ref.code, "robot_b");
    EXPECT_EQ(desk.query("component_status", equal("name", "robot_a")).results.parameters.front(),
              status_of("status", ComponentStatus::ready))
        << "robot_a was never asked";
}

TEST(Query, ThatNeedsNoResultsToChooseAsksOnlyTheChosenComponent) {
    World world{named("robot_a", navigation), named("robot_b", navigation), named("robot_c", navigation)};
    auto desk = world.connect();
    world["robot_a"].status_now = ComponentStatus::warning;
    world["robot_a"].throws_in = world["robot_c"].throws_in = {"query"};
    EXPECT_EQ(desk.query("route").component_ref.code, "robot_b");
    EXPECT_EQ(world.engine->statistics().errors, 0U);
}

TEST(Query, WithAConditionOnItsResultsAsksAllCandidates) {
    World world{named("robot_a", navigation), named("robot_b", navigation), named("robot_c", navigation)};
    auto desk = world.connect();
    world["robot_a"].status_now = ComponentStatus::warning;
    world["robot_c"].throws_in = {"query"};
    EXPECT_EQ(desk.query("route", equal("length", "2.5")).component_ref.code, "robot_b");
    EXPECT_EQ(world.engine->statistics().errors, 1U) << "robot_c was asked, and failed";
}

// A query finds the same component, however the condition names it.
TEST(Query, FindsTheComponentsThatTheConditionNames) {
    World world{named("robot_a", navigation), named("robot_b", navigation), named("robot_c", navigation), speech};
    auto desk = world.connect();
    auto const found = [&](QueryExpression const& condition) { return desk.query("route", condition).component_ref.code; };
    auto const a = equal("component_ref", "robot_a"), b = equal("name", " robot_b "), speaker = equal("name", "speech");
    EXPECT_EQ(found(either({b, a})), "robot_a") << "the lowest ref";
    EXPECT_EQ(found(either({b, speaker})), "robot_b");
    EXPECT_EQ(found(both({either({a, b}), contrary(a)})), "robot_b");
    EXPECT_EQ(found(both({a, b})), "");
    EXPECT_EQ(found(either({b, equal("bound", "true")})), "robot_b") << "the condition does not name one";
    EXPECT_EQ(found(Condition{PropertyComparison{Comparator::equal, literal("robot_c"), reference("component_ref")}}), "robot_c");
    EXPECT_EQ(found(Condition{PropertyComparison{Comparator::equal, reference("component_ref"), literal("ROBOT_C"), false}}),
              "robot_c");
    EXPECT_EQ(found(Condition{PropertyComparison{Comparator::not_equal, reference("component_ref"), literal("robot_a")}}),
              "robot_b");
    EXPECT_EQ(found(contrary(a)), "robot_b");
    EXPECT_EQ(found(equal("component_ref/@authority", "OMG")), "robot_a");
    EXPECT_EQ(found(Condition{ResourceId{"robot_c"}}), "robot_c");
    EXPECT_EQ(found(either({Condition{ResourceId{"robot_c"}}, b})), "robot_b");
}

TEST(Query, NamesReferToComponentsBeforeResults) {
    World world{navigation, speech};
    auto desk = world.connect();
    world["navigation"].status_now = ComponentStatus::warning;
    EXPECT_EQ(desk.query("component_status", equal("Result/status", "WARNING")).component_ref.code, "navigation");
    EXPECT_EQ(desk.query("component_status", equal("status", "WARNING")).component_ref.code, "navigation");
    EXPECT_EQ(desk.query("get_parameter", equal("volume", "50")).component_ref.code, "speech");
    EXPECT_EQ(desk.query("get_parameter", equal("Result/volume", "50")).component_ref.code, "speech");
    EXPECT_THAT(desk.query("route", equal("weight", "1")).reason, HasSubstr("length, to"));
}

TEST(Query, OfAnUnknownTypeIsUnsupported) {
    World world{navigation};
    auto const reply = world.connect().query("weather");
    EXPECT_EQ(reply.return_code, ReturnCode::unsupported);
    EXPECT_THAT(reply.reason, HasSubstr("'weather'"));
    EXPECT_EQ(world.connect().query("dock").return_code, ReturnCode::unsupported) << "a command is not a query";
}

TEST(Query, ThatCannotBeAnsweredNowIsAnError) {
    World world{navigation};
    world["navigation"].throws_in = {"nothing known"};
    auto const reply = world.connect().query("route");
    EXPECT_EQ(reply.return_code, ReturnCode::error);
    EXPECT_EQ(reply.reason, "the component 'navigation' could not answer");
}

// --- System information belongs to the engine (7.6.1) ---

namespace {

ParameterProfile result(std::string name, std::string type) {
    return {.name = std::move(name), .data_type_ref = {std::move(type), {}, {}, {}}, .default_value = {}, .description = {}};
}

// Answers `robot_position` and `engine_status`.
Part system_of(std::string const& robot) {
    auto part = in_engine(robot, named("system", navigation));
    part.profile.object.identifier = "urn:x-rois:def:component:OMG::SystemInformation";
    auto const query = [](std::string name, std::vector<ParameterProfile> results) {
        return MessageProfile{
            .kind = MessageKind::query, .name = std::move(name), .results = std::move(results), .arguments = {}, .timeout = {}};
    };
    part.profile.messages = {query("robot_position", {result("timestamp", "DateTime"), result("robot_ref", "RoISIdentifier[]"),
                                                      result("position_data", "string[]")}),
                             query("engine_status", {result("status", "Component_Status"), result("operable_time", "DateTime")})};
    part.profile.parameters.clear();
    part.mandatory.clear();
    return part;
}

Results position(std::string time, std::string robot, std::string where) {
    return {{value("timestamp", "DateTime", {"2026-11-20T12:00:0" + time + ".000Z"}),
             value("robot_ref", "RoISIdentifier[]", {robot}), value("position_data", "string[]", {std::move(where)})},
            {Located{"position_data", robot, "", {1, 2, 0}, {}, {}}}};
}

Results engine_status(std::string status, std::string since) {
    Results results;
    results.parameters.push_back(value("status", "Component_Status", {std::move(status)}));
    if (!since.empty())
        results.parameters.push_back(value("operable_time", "DateTime", {"2026-11-20T12:00:0" + since + ".000Z"}));
    return results;
}

struct TwoRobots : testing::Test {
    World world{system_of("robot2"), system_of("robot1"), detection};
    Application desk = world.connect();
    ScriptedComponent& one = world["robot1.system"];
    ScriptedComponent& other = world["robot2.system"];

    std::string status() { return in_words(desk.query("engine_status").results.parameters); }
};

}  // namespace

TEST_F(TwoRobots, ReportTheirPositionsInOneAnswer) {
    one.knows = {position("4", "robot1", "1, 2, 0")};
    other.knows = {position("3", "robot2", "3, 4, 0")};
    for (auto const& whole :
         {QueryExpression{}, QueryExpression{equal("engine", "")}, QueryExpression{equal("engine", "main")}}) {
        auto const reply = desk.query("robot_position", whole);
        EXPECT_EQ(reply.component_ref.code, "robot1.system");
        EXPECT_EQ(in_words(reply.results.parameters),
                  "timestamp=2026-11-20T12:00:03.000Z robot_ref=robot1|robot2 position_data=1, 2, 0|3, 4, 0")
            << "the time of the oldest";
        ASSERT_EQ(reply.results.located.size(), 2U);
        EXPECT_EQ(reply.results.located[1].ref, "robot2");
    }
    desk.bind("robot2.system");
    EXPECT_EQ(desk.query("robot_position").component_ref.code, "robot1.system") << "whatever the session has bound";
}

TEST_F(TwoRobots, AreChosenByACondition) {
    one.knows = {position("4", "robot1", "1, 2, 0")};
    other.knows = {position("3", "robot2", "3, 4, 0")};
    auto const robots = [&](QueryExpression condition) {
        auto const reply = desk.query("robot_position", std::move(condition));
        return reply.component_ref.code + " " + find(reply.results.parameters, "robot_ref")->values.front();
    };
    EXPECT_EQ(robots(equal("engine", "robot2")), "robot2.system robot2");
    EXPECT_EQ(robots(equal("component_ref", "robot1.system")), "robot1.system robot1");
    EXPECT_EQ(robots(equal("Result/robot_ref", "robot2")), "robot2.system robot2");
    EXPECT_EQ(robots(sorted(reference("component_ref"), SortOrder::descending)), "robot2.system robot2");
}

TEST_F(TwoRobots, HaveTheWorstOfTheirStatuses) {
    one.knows = {engine_status("READY", "1")};
    other.knows = {engine_status("READY", "2")};
    EXPECT_EQ(status(), "READY operable_time=2026-11-20T12:00:02.000Z") << "since both of them operate";
    one.knows = {engine_status("WARNING", "1")};
    EXPECT_EQ(status(), "WARNING operable_time=2026-11-20T12:00:02.000Z");
    other.knows = {engine_status("UNINITIALIZED", "")};
    EXPECT_EQ(status(), "UNINITIALIZED") << "not both of them operate";
    one.knows = {engine_status("ERROR", "1")};
    EXPECT_EQ(status(), "ERROR");
    one.knows = {engine_status("READY", "1")};
    EXPECT_EQ(in_words(desk.query("engine_status", equal("engine", "robot1")).results.parameters),
              "READY operable_time=2026-11-20T12:00:01.000Z");
}

TEST_F(TwoRobots, AreNotSilencedByOneThatFails) {
    one.throws_in = {"query"};
    other.knows = {position("3", "robot2", "3, 4, 0")};
    auto const reply = desk.query("robot_position");
    EXPECT_EQ(reply.component_ref.code, "robot2.system");
    EXPECT_EQ(find(reply.results.parameters, "robot_ref")->values, std::vector<std::string>{"robot2"});
    other.knows = {engine_status("READY", "1")};
    EXPECT_EQ(status(), "ERROR");
    other.throws_in = {"query"};
    EXPECT_EQ(desk.query("robot_position").return_code, ReturnCode::error) << "none has a position";
}

}  // namespace rois
