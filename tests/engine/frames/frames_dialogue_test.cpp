// Decision 27: an application, and components with their own frames.
#include "engine/conditions/conditions.hpp"
#include "engine/world.hpp"

namespace rois {

namespace {

Part with_map(Part part) {
    part.crs = "map";
    return part;
}

Part driving(Part part) {
    part.positions = {"target_position"};
    return part;
}

ParameterList target(std::string text, std::string crs = "") {
    return {positions("target_position", {std::move(text)}, std::move(crs))};
}

Located at(double x, double y, std::string crs, std::vector<double> rows = {}) {
    Located made{.of = "position_data",
                 .ref = "person-1",
                 .crs = std::move(crs),
                 .position = {x, y, 0},
                 .orientation = {},
                 .certainty = {}};
    if (!rows.empty()) made.certainty = Located::Covariance{std::move(rows)};
    return made;
}

// The engine's frame is the hall. The origin of robot2's map is at (1000, 2000) of the hall, and its x axis is the hall's y axis:
// (3000, 0) in the map is (1000, 5000) in the hall.
struct TwoFrames : testing::Test {
    World world{driving(navigation), in_engine("robot2", with_map(driving(navigation))),
                in_engine("robot2", with_map(localization))};
    Application desk = world.connect();
    ScriptedComponent& far = world["robot2.navigation"];
    ScriptedComponent& eyes = world["robot2.localization"];

    TwoFrames() {
        world.engine->describe(
            {.frames =
                 {"hall",
                  {{.crs = "map", .base = "hall", .position = {1'000, 2'000, 0}, .orientation = {0, 0, 90}, .covariance = {}}}},
             .all = {{"desk", box(0, 4'000, 2'000, 6'000, "hall")}}});
        for (auto const* ref : {"navigation", "robot2.navigation"}) desk.bind(ref);
    }

    void see(std::string point, std::string crs, std::vector<Located> located = {}) {
        eyes.fires("person_localized", {positions("position_data", {std::move(point)}, std::move(crs))}, std::move(located));
    }
    std::string reason(QueryExpression condition) { return desk.ask(Search{std::move(condition)}).reason; }
};

}  // namespace

TEST_F(TwoFrames, EventsAreConvertedToTheEnginesFrame) {
    desk.subscribe("person_localized", {}, true);
    see("3000, 0, 30", "map", {at(3'000, 0, "map", {100, 0, 0, 400})});
    EXPECT_THAT(desk.received(), ElementsAre("1 person_localized robot2.localization position_data=1000, 5000, 120"));
    auto const results = *desk.last_received<ReceiveEvent>().results;
    EXPECT_EQ(results.parameters.front().data_type_ref.codebook_ref, "hall");
    EXPECT_THAT(results.located, ElementsAre(at(1'000, 5'000, "hall", {400, 0, 0, 100})));
}

TEST_F(TwoFrames, PositionsInAnUnknownFrameAreReportedUnchanged) {
    desk.subscribe("person_localized", {}, true);
    see("3000, 0", "street", {at(3'000, 0, "street")});
    EXPECT_THAT(desk.received(), ElementsAre("1 person_localized robot2.localization position_data=3000, 0"));
    EXPECT_THAT(desk.last_received<ReceiveEvent>().results->located, ElementsAre(at(3'000, 0, "street")));
}

TEST_F(TwoFrames, EventsThatCannotBeConvertedAreDropped) {
    desk.subscribe("person_localized");
    see("3000, 0", "map", {at(3'000, 0, "map", {1, 2, 3})});
    EXPECT_THAT(desk.received(), ElementsAre("1 COMPONENT_INTERNAL_ERROR robot2.localization"));
    auto const detail = desk.detail_of(desk.last_received<ReceiveError>().error_id);
    EXPECT_THAT(in_words(detail.results.parameters), HasSubstr("a covariance of 3 numbers"));
}

TEST_F(TwoFrames, ResultsOfCommandsAreConvertedToTheEnginesFrame) {
    desk.execute(named("dock", command("dock", "robot2.navigation")));
    far.finishes(CompletedStatus::ok, {{integer("charge", 80)}, {at(3'000, 0, "map")}});
    EXPECT_EQ(desk.result_of("dock"), "OK charge=80");
    EXPECT_THAT(desk.ask(GetCommandResult{{"dock"}, {}}).results.located, ElementsAre(at(1'000, 5'000, "hall")));
}

TEST_F(TwoFrames, ACommandWhoseResultsCannotBeConvertedFails) {
    desk.execute(named("dock", command("dock", "robot2.navigation")));
    far.finishes(CompletedStatus::ok, {{integer("charge", 80)}, {at(3'000, 0, "map", {1, 2, 3})}});
    EXPECT_EQ(desk.result_of("dock"), "ERROR");
    EXPECT_THAT(desk.received(), ElementsAre("1 completed dock ERROR", "2 COMPONENT_INTERNAL_ERROR robot2.navigation"));
}

TEST_F(TwoFrames, TargetsAreConvertedToTheComponentsFrame) {
    desk.execute(start("robot2.navigation", target("1000, 5000, 120")));
    EXPECT_EQ(far.started_with.front(), target("3000, 0, 30", "map").front());
    desk.execute(start("robot2.navigation", target("1000, 5000, 120", "hall")));
    EXPECT_EQ(far.started_with.front(), target("3000, 0, 30", "map").front());
    desk.execute(start("robot2.navigation", target("3000, 0", "MAP")));
    EXPECT_EQ(far.started_with.front().values, std::vector<std::string>{"3000, 0"});
    desk.execute(start("navigation", target("3000, 0, 30", "map")));
    EXPECT_EQ(world["navigation"].started_with.front(), target("1000, 5000, 120", "hall").front());
    desk.execute(start("robot2.navigation", target("desk")));
    EXPECT_EQ(far.started_with.front().values, std::vector<std::string>{"desk"});
}

TEST_F(TwoFrames, TargetsAreReadBackAsTheApplicationWroteThem) {
    desk.set_parameter("robot2.navigation", target("1000, 5000, 120", "hall"));
    EXPECT_EQ(*find(desk.get_parameter("robot2.navigation").parameters, "target_position"),
              target("1000, 5000, 120", "hall").front());
    desk.execute(start("robot2.navigation"));
    EXPECT_EQ(find(far.started_with, "target_position")->values, std::vector<std::string>{"3000, 0, 30"});
}

// As if it did not exist.
TEST_F(TwoFrames, TargetsMustBeInAFrameThatTheClientSees) {
    Belongings of_two{.profiles = {},
                      .frames = {{.crs = "two.lab", .base = "hall", .position = {}, .orientation = {}, .covariance = {}}},
                      .places = {}};
    world.change({}, {named("two.speech", in_engine("two", speech))});
    world.engine->change({{}, {}, std::move(of_two), "two"}, world.now);
    auto stranger = world.connect_as(
        std::make_shared<Rights const>("desk", std::vector<std::string>{"navigation"}, std::vector<std::string>{"*"}));
    desk.release("navigation");
    stranger.bind("navigation");
    auto const reason = [&](std::string const& frame) {
        auto const set = stranger.set_parameter("navigation", target("1, 2", frame));
        EXPECT_EQ(set.return_code, ReturnCode::bad_parameter);
        return set.reason;
    };
    EXPECT_THAT(reason("two.lab"), HasSubstr("the frame 'two.lab' is not known here; expected one of hall"));
    EXPECT_THAT(reason("two.lab"), testing::Not(HasSubstr("two.lab,")));
    EXPECT_THAT(reason("no.lab"), HasSubstr("the frame 'no.lab' is not known here; expected one of hall"));
    stranger.leave();
    desk.bind("navigation");
    EXPECT_EQ(desk.set_parameter("navigation", target("1, 2", "two.lab")).return_code, ReturnCode::ok) << "it sees all";
}

TEST_F(TwoFrames, TargetsMustBeInAKnownFrame) {
    auto const started = desk.execute(start("navigation", target("1, 2", "street")));
    EXPECT_EQ(started.return_code, ReturnCode::bad_parameter);
    EXPECT_EQ(
        started.reason,
        "command_unit_list[1]: parameter 'target_position': the frame 'street' is not known here; expected one of hall, map");
    auto const set = desk.set_parameter("robot2.navigation", target("1, 2", "street"));
    EXPECT_EQ(set.return_code, ReturnCode::bad_parameter);
    EXPECT_THAT(set.reason, HasSubstr("expected one of hall, map"));
    EXPECT_THAT(far.calls, IsEmpty());
}

TEST_F(TwoFrames, ConditionsFindARobotThatReportsInItsOwnFrame) {
    far.where = at(3'000, 0, "map");
    EXPECT_THAT(desk.search(within("location", literal("desk"))), ElementsAre("robot2.navigation"));
    EXPECT_THAT(desk.search(equal("location", "desk")), ElementsAre("robot2.navigation"));
}

TEST_F(TwoFrames, ConditionsMayUseEitherFrame) {
    world["navigation"].where = at(1'000, 4'900, "hall");
    far.where = at(3'000, 5'000, "map");  // (-4000, 5000) in the hall
    EXPECT_THAT(desk.search(within("location", {box(2'901, -100, 3'100, 100, "map")})), IsEmpty());
    EXPECT_THAT(desk.search(within("location", {box(2'800, -100, 3'100, 100, "map")})), ElementsAre("navigation"));
    EXPECT_THAT(desk.search(near("location", {spot(3'000, 0, "map")}, 100)), ElementsAre("navigation"));
    EXPECT_THAT(desk.search(near("location", {spot(3'000, 0, "map")}, 99)), IsEmpty());
    EXPECT_THAT(reason(within("location", {box(0, 0, 1, 1, "street")})),
                HasSubstr("'street', which is not known here; expected one of hall, map"));
}

TEST_F(TwoFrames, EventsAreSelectedByTheirPositionInEitherFrame) {
    desk.subscribe("person_localized", within("position_data", {box(2'900, -100, 3'100, 100, "map")}), true);
    see("3000, 0", "map");
    see("1000, 5000", "map");
    see("1000, 5000", "hall");
    EXPECT_THAT(desk.received(), ElementsAre("1 person_localized robot2.localization position_data=1000, 5000",
                                             "2 person_localized robot2.localization position_data=1000, 5000"));
}

TEST_F(TwoFrames, TwoBoxesOfAConditionMustShareAFrame) {
    EXPECT_THAT(reason(spatial(SpatialRelation::intersects, {{box(0, 0, 1, 1, "map")}, literal("desk")})),
                HasSubstr("a geometry in the frame 'map' to one in 'hall': use one frame for both"));
    EXPECT_EQ(reason(spatial(SpatialRelation::intersects, {{box(0, 0, 1, 1)}, literal("desk")})), "");
}

}  // namespace rois
