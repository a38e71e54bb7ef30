// Space and time in conditions: positions of components, positions and times of events, and the nearest one.
#include "engine/conditions/conditions.hpp"
#include "engine/world.hpp"

namespace rois {

namespace {

Located at(double x, double y, std::string robot, std::string crs = "hall") {
    return {.of = "location",
            .ref = std::move(robot),
            .crs = std::move(crs),
            .position = {x, y, 0},
            .orientation = {},
            .certainty = {}};
}

// Robots in the hall: `near` at the desk, `far` by the wall; the position of `lost` is unknown.
struct Hall : testing::Test {
    World world{named("far", navigation), named("lost", navigation), named("near", navigation), localization};
    Application desk = world.connect();

    Hall() {
        world.engine->describe({.frames = {"hall"},
                                .all = {{"hall", box(0, 0, 10'000, 10'000, "hall")}, {"desk", box(0, 0, 2'000, 1'000, "hall")}}});
        world["near"].where = at(1'000, 1'000, "robot1");
        world["far"].where = at(9'000, 7'000, "robot2");
    }

    std::vector<std::string> found(QueryExpression condition) { return desk.search(std::move(condition)); }
    std::string reason(QueryExpression condition) { return desk.ask(Search{std::move(condition)}).reason; }
};

TEST_F(Hall, WithinIncludesTheEdge) {
    EXPECT_THAT(found(within("location", {box(0, 0, 1'000, 1'000)})), ElementsAre("near"));
    EXPECT_THAT(found(within("location", {box(0, 0, 999.9, 1'000)})), IsEmpty());
    EXPECT_THAT(found(within("Property/location", {box(0, 0, 9'000, 7'000, "hall")})), ElementsAre("far", "near"));
}

TEST_F(Hall, AGeometryMayStandFirst) {
    EXPECT_THAT(found(spatial(SpatialRelation::within, {{box(0, 0, 1'000, 1'000)}, reference("location")})), ElementsAre("near"));
}

TEST_F(Hall, IntersectsAndDisjointAreOpposites) {
    EXPECT_THAT(found(spatial(SpatialRelation::intersects, {reference("location"), {box(9'000, 0, 9'500, 7'000)}})),
                ElementsAre("far"));
    EXPECT_THAT(found(spatial(SpatialRelation::disjoint, {reference("location"), {box(9'000, 0, 9'500, 7'000)}})),
                ElementsAre("near"))
        << "without a position, neither matches";
}

TEST_F(Hall, OneOperandIsComparedWithThePositionOfTheComponent) {
    EXPECT_THAT(found(spatial(SpatialRelation::intersects, {{box(0, 0, 5'000, 5'000)}})), ElementsAre("near"));
}

TEST_F(Hall, DistancesAreToTheNearestEdge) {
    EXPECT_THAT(found(near("location", {spot(4'000, 5'000)}, 5'000)), ElementsAre("near")) << "a triangle with sides 3, 4 and 5";
    EXPECT_THAT(found(near("location", {spot(4'000, 5'000)}, 4'999.9)), IsEmpty());
    EXPECT_THAT(found(near("location", {box(4'000, 0, 5'000, 5'000)}, 3, "m")), ElementsAre("near"));
    EXPECT_THAT(found(beyond("location", {spot(4'000, 5'000)}, 5'000)), ElementsAre("far"));
    EXPECT_THAT(found(near("location", {spot(1'000, 1'000)}, 0.001, "km")), ElementsAre("near"));
    EXPECT_THAT(found(near("location", {spot(1'000, 1'001)}, 0.1, "cm")), ElementsAre("near"));
}

TEST_F(Hall, HeightCountsWhenBothHaveOne) {
    Geometry const upstairs{.crs = "", .low = {0, 0, 3'000}, .high = {10'000, 10'000, 6'000}, .dimensions = 3};
    EXPECT_THAT(found(within("location", {upstairs})), IsEmpty());
}

TEST_F(Hall, NamesOfPlacesStandForTheirAreas) {
    EXPECT_THAT(found(within("location", literal(" desk "))), ElementsAre("near"));
    EXPECT_THAT(found(within("location", literal("hall"))), ElementsAre("far", "near"));
    EXPECT_THAT(found(near("location", literal("9000, 6000, 90"), 1'000)), ElementsAre("far"))
        << "or a point, as positions are written";
    EXPECT_EQ(reason(within("location", literal("attic"))),
              "the condition has the place 'attic', which is not known here; expected one of 'hall', 'desk'");
}

TEST_F(Hall, AsATextAPositionIsTheNamesOfThePlacesAroundIt) {
    EXPECT_THAT(found(equal("location", "desk")), ElementsAre("near"));
    EXPECT_THAT(found(like("location", "ha*")), ElementsAre("far", "near"));
    EXPECT_THAT(found(is_null("location")), ElementsAre("localization", "lost"));
    world["near"].where = at(-1, -1, "robot1");
    EXPECT_THAT(found(is_null("location")), ElementsAre("localization", "lost"))
        << "it has a position, although outside of named places";
}

TEST_F(Hall, ARobotIsKnownByItsName) {
    EXPECT_THAT(found(equal("RobotId", "robot2")), ElementsAre("far"));
    EXPECT_THAT(found(equal("location/@ref", "robot1")), ElementsAre("near"));
    EXPECT_THAT(found(equal("RobotId", "main")), ElementsAre("localization", "lost")) << "without a position, it is the engine";
}

TEST_F(Hall, FramesMustBeKnown) {
    EXPECT_THAT(found(within("location", {box(0, 0, 1'000, 1'000, "HALL")})), ElementsAre("near"));
    EXPECT_EQ(reason(within("location", {box(0, 0, 1, 1, "street")})),
              "the condition has the frame 'street', which is not known here; expected one of hall");
    world["far"].where = at(500, 500, "robot2", "street");
    EXPECT_THAT(found(within("location", {box(0, 0, 1'000, 1'000)})), ElementsAre("near"))
        << "coordinates of two frames cannot be compared";
    EXPECT_THAT(found(spatial(SpatialRelation::disjoint, {reference("location"), {box(0, 0, 1, 1)}})), ElementsAre("near"));
}

TEST_F(Hall, AComponentThatFailsToReportItsPositionHasNone) {
    world["near"].throws_in = {"location"};
    EXPECT_THAT(found(within("location", literal("desk"))), IsEmpty());
    EXPECT_EQ(desk.status_of("near"), "ERROR");
}

TEST_F(Hall, UnitsAndDistancesMustBeKnown) {
    EXPECT_THAT(reason(near("location", {spot(0, 0)}, 1, "ft")), HasSubstr("'ft'"));
    EXPECT_THAT(reason(near("location", {spot(0, 0)}, -1)), HasSubstr("a distance that is not a number of at least 0"));
    EXPECT_THAT(reason(within("component_ref", {spot(0, 0)})), HasSubstr("'component_ref'"));
    EXPECT_THAT(reason(within("time_limit", {spot(0, 0)})), HasSubstr("'time_limit'"));
    EXPECT_THAT(reason(within("location", {Period{}})), HasSubstr("is not a position"));
}

TEST_F(Hall, ParametersMayBePositions) {
    desk.bind("lost");
    desk.set_parameter("lost", {texts("target_position", {"5000, 0, 90", "8000, 8000, 0"})});
    EXPECT_THAT(found(within("Property/target_position", {box(7'000, 7'000, 9'000, 9'000)})), ElementsAre("lost"));
    EXPECT_THAT(found(within("Property/target_position[1]", {box(7'000, 7'000, 9'000, 9'000)})), IsEmpty());
    EXPECT_THAT(found(within("Property/target_positions[2]", literal("hall"))), ElementsAre("lost"))
        << "in the published spelling";
}

TEST_F(Hall, DistanceIsAlsoAValue) {
    auto const closer = [](double mm) {
        return Condition{
            PropertyComparison{Comparator::less, distance("location", literal("desk")), literal(std::to_string(mm))}};
    };
    EXPECT_THAT(found(closer(100)), ElementsAre("near"));
    EXPECT_THAT(found(closer(10'000)), ElementsAre("far", "near"));
    EXPECT_THAT(reason(Condition{PropertyComparison{Comparator::less, {Function{"area", {}}}, literal("1")}}),
                HasSubstr("'area'"));
    EXPECT_THAT(
        reason(Condition{PropertyComparison{Comparator::less, {Function{"distance", {reference("location")}}}, literal("1")}}),
        HasSubstr("two arguments"));
}

TEST_F(Hall, TheNearestComponentComesFirst) {
    EXPECT_THAT(found(sorted(distance("location", {spot(10'000, 10'000)}))), ElementsAre("far", "near", "localization", "lost"))
        << "a component without a position comes last";
    EXPECT_THAT(found(sorted(distance("location", {spot(10'000, 10'000)}), SortOrder::descending)),
                ElementsAre("near", "far", "localization", "lost"));
}

TEST_F(Hall, TheNearestFreeComponentIsBound) {
    auto const nearest = sorted(distance("location", literal("desk")));
    EXPECT_EQ(desk.bind_any(nearest), "near");
    auto hall = world.connect();
    EXPECT_EQ(hall.bind_any(nearest), "far");
    EXPECT_EQ(hall.bind_any({equal("name", "far"), nearest.sort_by}), "far") << "bound already";
}

TEST_F(Hall, SeveralPropertiesSortOneAfterTheOther) {
    desk.bind("lost");
    desk.set_parameter("lost", {value("time_limit", "int", {"1000"})});
    desk.bind("far");
    desk.set_parameter("far", {value("time_limit", "int", {"200"})});
    QueryExpression query{like("component_type", "*navigation")};
    query.sort_by = {{reference("Property/time_limit"), SortOrder::descending}, {reference("name")}};
    EXPECT_THAT(found(query), ElementsAre("lost", "far", "near")) << "as numbers";
    query.sort_by = {{reference("status")}, {reference("name"), SortOrder::descending}};
    EXPECT_THAT(found(query), ElementsAre("near", "lost", "far"));
}

TEST_F(Hall, SortByIsAcceptedOnlyWhereItIsSupported) {
    EXPECT_THAT(reason(sorted(reference("colour"))), HasSubstr("'colour'"));
    EXPECT_THAT(reason(sorted({Function{"area", {}}})), HasSubstr("'area'"));
    EXPECT_THAT(desk.subscribe("reached_target", sorted(reference("name"))).reason, HasSubstr("SortBy"));
    EXPECT_EQ(desk.query("route", sorted(reference("name"), SortOrder::descending)).component_ref.code, "near");
    EXPECT_EQ(desk.ask(GetProfile{sorted(reference("name"), SortOrder::descending)}).components.front().ref, "near");
}

TEST_F(Hall, APositionThatMayChangeIsNotRefused) {
    EXPECT_EQ(desk.bind_any(within("location", {box(5'000, 0, 6'000, 1'000)})), "OUT_OF_RESOURCES") << "robots move";
    EXPECT_EQ(desk.bind_any(both({equal("name", "ghost"), within("location", literal("hall"))})), "UNSUPPORTED");
}

// --- Events ---

ParameterList found_people(std::string const& time, std::vector<std::string> refs, std::vector<std::string> points) {
    return {value("timestamp", "DateTime", {time}), references("person_ref", std::move(refs)),
            positions("position_data", std::move(points), "hall")};
}

Located person(std::string ref, double x, double y) {
    return {.of = "position_data",
            .ref = std::move(ref),
            .crs = "hall",
            .position = {x, y, 1'700},
            .orientation = {},
            .certainty = {}};
}

struct People : Hall {
    // Returns whether a subscriber with this condition receives an event with these results.
    bool is_received(Condition condition, ParameterList results, std::vector<Located> located = {}) {
        auto const id = desk.subscribe("person_localized", std::move(condition));
        EXPECT_EQ(id.return_code, ReturnCode::ok) << id.reason;
        world["localization"].fires("person_localized", std::move(results), std::move(located));
        bool const arrived = !desk.received().empty();
        desk.unsubscribe(id.subscribe_id);
        return arrived;
    }

    std::string const noon = "2026-11-20T12:00:00Z";
    ParameterList two = found_people(noon, {"p-1", "p-2"}, {"1000, 1000, 0", "8000, 8000, 0"});
    std::vector<Located> both_of_them{person("p-1", 1'000.4, 1'000), person("p-2", 8'000, 8'000)};
};

TEST_F(People, OnePersonWithinTheBoxIsEnough) {
    EXPECT_TRUE(is_received(within("position_data", literal("desk")), two));
    EXPECT_FALSE(is_received(within("position_data", {box(3'000, 3'000, 4'000, 4'000)}), two));
    EXPECT_TRUE(is_received(within("position_data", {box(7'999, 7'999, 8'000, 8'000)}), two));
}

TEST_F(People, LocatedElementsTakePrecedenceOverTexts) {
    EXPECT_TRUE(is_received(within("position_data", {box(0, 0, 1'000, 1'000)}), two));
    EXPECT_FALSE(is_received(within("position_data", {box(0, 0, 1'000, 1'000)}), two, both_of_them));
    Geometry const at_head_height{.crs = "hall", .low = {0, 0, 1'600}, .high = {2'000, 2'000, 1'800}, .dimensions = 3};
    EXPECT_TRUE(is_received(within("position_data", {at_head_height}), two, both_of_them));
}

TEST_F(People, DisjointAndBeyondMustHoldForAllPositions) {
    EXPECT_FALSE(is_received(spatial(SpatialRelation::disjoint, {reference("position_data"), literal("desk")}), two));
    EXPECT_FALSE(is_received(beyond("position_data", literal("desk"), 100), two));
    EXPECT_TRUE(is_received(beyond("position_data", {spot(0, 9'999)}, 100), two));
}

TEST_F(People, APersonIsSelectedByTheirRef) {
    auto const first_at_desk = within("position_data[@ref='p-1']", literal("desk"));
    EXPECT_TRUE(is_received(first_at_desk, two, both_of_them));
    EXPECT_FALSE(is_received(within("position_data[@ref='p-2']", literal("desk")), two, both_of_them));
    EXPECT_TRUE(is_received(within("located[@ref='p-1']", literal("desk")), two, both_of_them));
    EXPECT_FALSE(is_received(within("located[@of='robot_position']", literal("hall")), two, both_of_them));
    EXPECT_TRUE(is_received(equal("person_ref", "p-2"), two));
    EXPECT_TRUE(is_received(equal("located/@ref", "p-2"), two, both_of_them));
    EXPECT_TRUE(is_received(equal("position_data[@ref='p-2']", "8000, 8000, 0"), two, both_of_them));
}

TEST_F(People, OneOperandIsComparedWithThePositionsOfTheEvent) {
    EXPECT_TRUE(is_received(spatial(SpatialRelation::intersects, {literal("desk")}), two, {person("p-1", 1, 1)}));
    EXPECT_FALSE(is_received(spatial(SpatialRelation::intersects, {literal("desk")}), two, {person("p-1", 5'000, 1)}));
}

TEST_F(People, ThePositionOfTheRobotCountsToo) {
    world["localization"].where = at(500, 500, "robot3");
    EXPECT_TRUE(is_received(within("location", literal("desk")), two));
    world["localization"].where = at(5'000, 500, "robot3");
    EXPECT_FALSE(is_received(within("location", literal("desk")), two));
}

// --- Time ---

struct Times : People {
    Period const morning{*to_utc("2026-11-20T09:00:00Z"), *to_utc("2026-11-20T12:00:00Z")};

    bool holds(TemporalRelation relation, Expression other, std::string const& time) {
        return is_received(temporal(relation, {reference("timestamp"), std::move(other)}), found_people(time, {}, {}));
    }
};

TEST_F(Times, DuringExcludesTheEnds) {
    EXPECT_TRUE(holds(TemporalRelation::during, {morning}, "2026-11-20T09:00:00.001Z"));
    EXPECT_TRUE(holds(TemporalRelation::during, {morning}, "2026-11-20T20:59:59+09:00"));
    EXPECT_FALSE(holds(TemporalRelation::during, {morning}, "2026-11-20T09:00:00Z"));
    EXPECT_FALSE(holds(TemporalRelation::during, {morning}, "2026-11-20T12:00:00Z"));
    EXPECT_TRUE(is_received(temporal(TemporalRelation::during, {{morning}, reference("timestamp")}),
                            found_people("2026-11-20T10:00:00Z", {}, {})))
        << "the period may be the first operand";
}

TEST_F(Times, AfterAndBeforeLookBeyondThePeriod) {
    EXPECT_TRUE(holds(TemporalRelation::after, {morning}, "2026-11-20T12:00:00.001Z"));
    EXPECT_FALSE(holds(TemporalRelation::after, {morning}, noon));
    EXPECT_TRUE(holds(TemporalRelation::before, {morning}, "2026-11-20T08:59:59Z"));
    EXPECT_FALSE(holds(TemporalRelation::before, {morning}, "2026-11-20T09:00:00Z"));
    EXPECT_TRUE(is_received(temporal(TemporalRelation::before, {{morning}, reference("timestamp")}),
                            found_people("2026-11-20T13:00:00Z", {}, {})))
        << "the morning is before 13:00";
}

TEST_F(Times, TEqualsIsTheSameMoment) {
    EXPECT_TRUE(holds(TemporalRelation::t_equals, literal("2026-11-20T21:00:00+09:00"), noon));
    EXPECT_FALSE(holds(TemporalRelation::t_equals, literal("2026-11-20"), noon)) << "a day is not a moment";
    EXPECT_TRUE(holds(TemporalRelation::during, literal("2026-11-20"), noon));
}

// ISO 19108: which of the thirteen relations holds, and AnyInteracts.
TEST_F(Times, PeriodsAndMomentsHaveOneRelationEach) {
    using enum TemporalRelation;
    static std::vector<std::pair<TemporalRelation, std::string>> const all{{after, "after"},
                                                                           {before, "before"},
                                                                           {during, "during"},
                                                                           {t_equals, "equals"},
                                                                           {begins, "begins"},
                                                                           {begun_by, "begun by"},
                                                                           {t_contains, "contains"},
                                                                           {ended_by, "ended by"},
                                                                           {ends, "ends"},
                                                                           {meets, "meets"},
                                                                           {met_by, "met by"},
                                                                           {t_overlaps, "overlaps"},
                                                                           {overlapped_by, "overlapped by"},
                                                                           {any_interacts, "+"}};
    auto const at = [](std::string const& hours) {  // "9-12" or "9"
        auto const time = [](std::string const& hour) {
            return *to_utc("2026-11-20T" + std::string(hour.size() < 2, '0') + hour + ":00:00Z");
        };
        auto const dash = hours.find('-');
        auto const begin = time(hours.substr(0, dash));
        return Period{begin, dash == hours.npos ? begin : time(hours.substr(dash + 1))};
    };
    auto const relations = [&](std::string const& one, std::string const& other) {
        std::string names;
        for (auto const& [relation, name] : all)
            if (!found(temporal(relation, {{at(one)}, {at(other)}})).empty()) names += (names.empty() ? "" : " ") + name;
        return names;
    };
    EXPECT_EQ(relations("9-12", "13-15"), "before");
    EXPECT_EQ(relations("13-15", "9-12"), "after");
    EXPECT_EQ(relations("9-12", "12-15"), "meets");
    EXPECT_EQ(relations("12-15", "9-12"), "met by");
    EXPECT_EQ(relations("9-12", "10-15"), "overlaps +");
    EXPECT_EQ(relations("10-15", "9-12"), "overlapped by +");
    EXPECT_EQ(relations("9-12", "9-15"), "begins +");
    EXPECT_EQ(relations("9-15", "9-12"), "begun by +");
    EXPECT_EQ(relations("12-15", "9-15"), "ends +");
    EXPECT_EQ(relations("9-15", "12-15"), "ended by +");
    EXPECT_EQ(relations("10-12", "9-15"), "during +");
    EXPECT_EQ(relations("9-15", "10-12"), "contains +");
    EXPECT_EQ(relations("9-15", "9-15"), "equals +");
    EXPECT_EQ(relations("8", "9-12"), "before");
    EXPECT_EQ(relations("9", "9-12"), "begins +");
    EXPECT_EQ(relations("10", "9-12"), "during +");
    EXPECT_EQ(relations("12", "9-12"), "ends +");
    EXPECT_EQ(relations("13", "9-12"), "after");
    EXPECT_EQ(relations("9-12", "8"), "after");
    EXPECT_EQ(relations("9-12", "9"), "begun by +");
    EXPECT_EQ(relations("9-12", "10"), "contains +");
    EXPECT_EQ(relations("9-12", "12"), "ended by +");
    EXPECT_EQ(relations("9", "9"), "equals +");
    EXPECT_EQ(relations("9", "10"), "before");
}

TEST_F(Times, OfEventsMeetEachOperator) {
    EXPECT_TRUE(holds(TemporalRelation::begins, {morning}, "2026-11-20T09:00:00Z"));
    EXPECT_TRUE(holds(TemporalRelation::ends, {morning}, noon));
    EXPECT_TRUE(holds(TemporalRelation::any_interacts, {morning}, noon));
    EXPECT_FALSE(holds(TemporalRelation::any_interacts, {morning}, "2026-11-20T12:00:00.001Z"));
    EXPECT_TRUE(is_received(temporal(TemporalRelation::t_contains, {{morning}, reference("timestamp")}),
                            found_people("2026-11-20T10:00:00Z", {}, {})));
    EXPECT_FALSE(holds(TemporalRelation::t_contains, {morning}, "2026-11-20T10:00:00Z")) << "a moment contains no period";
    EXPECT_FALSE(holds(TemporalRelation::meets, {morning}, "2026-11-20T09:00:00Z")) << "only periods meet";
}

TEST_F(Times, OneOperandIsComparedWithTheTimeOfTheEvent) {
    EXPECT_TRUE(is_received(temporal(TemporalRelation::during, {{morning}}), found_people("2026-11-20T10:00:00Z", {}, {})));
    EXPECT_THAT(reason(temporal(TemporalRelation::during, {{morning}})), HasSubstr("one operand"));
}

TEST_F(Times, AnInvalidTimeIsRefused) {
    auto const refused = [&](Condition condition) { return desk.subscribe("person_localized", std::move(condition)).reason; };
    EXPECT_THAT(refused(temporal(TemporalRelation::after, {reference("timestamp"), literal("teatime")})), HasSubstr("'teatime'"));
    EXPECT_THAT(refused(temporal(TemporalRelation::after, {reference("person_ref"), literal("2026")})),
                HasSubstr("'person_ref'"));
    EXPECT_THAT(refused(temporal(TemporalRelation::after, {reference("timestamp"), {spot(0, 0)}})), HasSubstr("is not a time"));
}

}  // namespace
}  // namespace rois
