// Relations between points, boxes, lines, circles and polygons: each spatial operator with each pair of geometries.

#include <numbers>

#include "engine/conditions/conditions.hpp"
#include "engine/frames/frames.hpp"
#include "engine/frames/shapes.hpp"
#include "engine/frames/space.hpp"
#include "engine/world.hpp"

namespace rois {

namespace {

Geometry shape(Geometry::Shape kind, std::vector<Geometry::Points> paths, double radius = 0, std::string crs = "") {
    Geometry geometry{.crs = std::move(crs), .shape = kind, .paths = std::move(paths), .radius = radius};
    geometry.fit_corners();
    return geometry;
}
Geometry line(Geometry::Points points) { return shape(Geometry::Shape::line, {std::move(points)}); }
Geometry circle(double x, double y, double radius) { return shape(Geometry::Shape::circle, {{{x, y}}}, radius); }
Geometry polygon(Geometry::Points border, std::vector<Geometry::Points> holes = {}) {
    holes.insert(holes.begin(), std::move(border));
    return shape(Geometry::Shape::polygon, std::move(holes));
}

// The relations that hold in both directions, and those that hold from `a` to `b` only.
std::string relations(Geometry const& a, Geometry const& b) {
    static std::vector<std::pair<SpatialRelation, std::string>> const all{
        {SpatialRelation::equals, "equals"},    {SpatialRelation::disjoint, "disjoint"}, {SpatialRelation::touches, "touches"},
        {SpatialRelation::within, "within"},    {SpatialRelation::overlaps, "overlaps"}, {SpatialRelation::crosses, "crosses"},
        {SpatialRelation::contains, "contains"}};
    std::string names;
    for (auto const& [relation, name] : all)
        if (holds(relation, a, b)) names += (names.empty() ? "" : " ") + name;
    EXPECT_NE(holds(SpatialRelation::intersects, a, b), holds(SpatialRelation::disjoint, a, b));
    EXPECT_EQ(holds(SpatialRelation::within, a, b), holds(SpatialRelation::contains, b, a));
    for (auto const relation : {SpatialRelation::equals, SpatialRelation::intersects, SpatialRelation::touches,
                                SpatialRelation::overlaps, SpatialRelation::crosses})
        EXPECT_EQ(holds(relation, a, b), holds(relation, b, a)) << "the other way round";
    return names;
}

Geometry const square = box(0, 0, 1'000, 1'000);
Geometry const triangle = polygon({{0, 0}, {1'000, 0}, {0, 1'000}, {0, 0}});
Geometry const frame = polygon({{0, 0}, {1'000, 0}, {1'000, 1'000}, {0, 1'000}, {0, 0}},
                               {{{400, 400}, {600, 400}, {600, 600}, {400, 600}, {400, 400}}});
Geometry const disc = circle(0, 0, 500);

}  // namespace

TEST(Points, AreWithinTouchingOrDisjoint) {
    EXPECT_EQ(relations(spot(1, 2), spot(1, 2)), "equals within contains");
    EXPECT_EQ(relations(spot(1, 2), spot(1, 3)), "disjoint");
    for (auto const& area : {square, triangle, circle(0, 0, 1'000)}) EXPECT_EQ(relations(spot(100, 200), area), "within");
    for (auto const& area : {square, triangle, circle(2'000, 0, 1'000)})
        EXPECT_EQ(relations(spot(1'000, 0), area), "touches within") << "edges belong to an area, but not to its interior";
    for (auto const& area : {square, triangle, circle(500, 500, 500)}) EXPECT_EQ(relations(spot(1'001, 0), area), "disjoint");
    EXPECT_EQ(relations(spot(500, 0), line({{0, 0}, {1'000, 0}})), "within");
    EXPECT_EQ(relations(spot(0, 0), line({{0, 0}, {1'000, 0}})), "touches within") << "the end of a line is its edge";
    EXPECT_EQ(relations(spot(500, 500), frame), "disjoint") << "in the hole";
    EXPECT_EQ(relations(spot(500, 400), frame), "touches within") << "on the edge of the hole";
    EXPECT_EQ(relations(spot(500, 0), box(0, 0, 1'000, 0)), "within") << "a box without height is a line";
}

TEST(Boxes, HaveTheRelationsOfAreas) {
    EXPECT_EQ(relations(square, square), "equals within contains");
    EXPECT_EQ(relations(square, box(500, 500, 2'000, 2'000)), "overlaps");
    EXPECT_EQ(relations(square, box(1'000, 0, 2'000, 1'000)), "touches");
    EXPECT_EQ(relations(square, box(1'000, 1'000, 2'000, 2'000)), "touches") << "corner to corner";
    EXPECT_EQ(relations(square, box(0, 0, 500, 500)), "contains");
    EXPECT_EQ(relations(square, box(1'001, 0, 2'000, 500)), "disjoint");
    EXPECT_EQ(relations(box(-500, 500, 500, 500), square), "crosses") << "a line into the area";
    EXPECT_EQ(relations(box(0, 500, 500, 500), square), "within");
    EXPECT_EQ(relations(box(0, 0, 500, 0), square), "touches within") << "a line on the edge";
    EXPECT_EQ(relations(box(0, 500, 1'000, 500), box(500, 0, 500, 1'000)), "crosses") << "two lines";
    EXPECT_EQ(relations(box(0, 0, 600, 0), box(500, 0, 900, 0)), "overlaps");
    Geometry const low{.crs = "", .low = {0, 0, 0}, .high = {1'000, 1'000, 1'000}, .dimensions = 3};
    Geometry const high{.crs = "", .low = {0, 0, 1'000}, .high = {1'000, 1'000, 2'000}, .dimensions = 3};
    EXPECT_EQ(relations(low, high), "touches") << "one on top of the other";
    EXPECT_EQ(relations(low, square), "equals within contains") << "in the plane";
}

TEST(Polygons, HaveTheRelationsOfAreasToOtherGeometries) {
    EXPECT_EQ(relations(triangle, triangle), "equals within contains");
    EXPECT_EQ(relations(polygon({{1'000, 0}, {0, 0}, {0, 1'000}, {1'000, 0}}), triangle), "equals within contains")
        << "whatever the first point and the direction";
    EXPECT_EQ(relations(polygon({{0, 0}, {1'000, 0}, {1'000, 1'000}, {0, 1'000}, {0, 0}}), square), "equals within contains");
    EXPECT_EQ(relations(triangle, square), "within");
    EXPECT_EQ(relations(triangle, box(500, 500, 900, 900)), "touches") << "the corner of the box is on the slanted edge";
    EXPECT_EQ(relations(triangle, box(600, 600, 900, 900)), "disjoint");
    EXPECT_EQ(relations(triangle, box(100, 100, 900, 900)), "overlaps");
    EXPECT_EQ(relations(frame, box(400, 400, 600, 600)), "touches") << "it fills the hole";
    EXPECT_EQ(relations(frame, box(450, 450, 550, 550)), "disjoint") << "within the hole";
    EXPECT_EQ(relations(frame, square), "within");
}

TEST(Lines, CrossAreasAndOneAnother) {
    auto const diagonal = line({{-100, -100}, {1'100, 1'100}});
    EXPECT_EQ(relations(diagonal, square), "crosses");
    EXPECT_EQ(relations(diagonal, triangle), "crosses");
    EXPECT_EQ(relations(diagonal, frame), "crosses");
    EXPECT_EQ(relations(diagonal, disc), "crosses");
    EXPECT_EQ(relations(line({{0, 1'000}, {1'000, 0}}), diagonal), "crosses");
    EXPECT_EQ(relations(line({{100, 100}, {200, 200}}), square), "within");
    EXPECT_EQ(relations(line({{100, 100}, {200, 200}}), disc), "within");
    EXPECT_EQ(relations(line({{100, 100}, {200, 200}}), diagonal), "within");
    EXPECT_EQ(relations(line({{100, 100}, {2'000, 2'000}}), diagonal), "overlaps");
    EXPECT_EQ(relations(line({{500, 500}, {500, 0}}), diagonal), "touches") << "one ends on the other";
    EXPECT_EQ(relations(line({{0, -500}, {500, -500}}), disc), "touches");
    EXPECT_EQ(relations(line({{0, -600}, {500, -600}}), disc), "disjoint");
    EXPECT_EQ(relations(line({{1'000, -100}, {1'000, 1'100}}), square), "touches");
}

TEST(Circles, AreComparedExactlyAndNotAsPolygons) {
    double const at_45_degrees = 500 / std::numbers::sqrt2;
    EXPECT_EQ(relations(spot(at_45_degrees, at_45_degrees), disc), "touches within");
    EXPECT_EQ(relations(spot(at_45_degrees - 0.001, at_45_degrees), disc), "within");
    EXPECT_EQ(relations(spot(at_45_degrees + 0.001, at_45_degrees), disc), "disjoint");
    EXPECT_EQ(relations(disc, circle(0, 0, 500)), "equals within contains");
    EXPECT_EQ(relations(disc, circle(1'000, 0, 500)), "touches");
    EXPECT_EQ(relations(disc, circle(900, 0, 500)), "overlaps");
    EXPECT_EQ(relations(disc, circle(100, 0, 400)), "contains");
    EXPECT_EQ(relations(disc, circle(1'001, 0, 500)), "disjoint");
    EXPECT_EQ(relations(disc, box(-500, -500, 500, 500)), "within");
    EXPECT_EQ(relations(disc, box(500, -500, 600, 500)), "touches");
    EXPECT_EQ(relations(disc, box(-300, -300, 300, 300)), "contains");
    EXPECT_EQ(relations(disc, box(-400, -400, 400, 400)), "overlaps") << "its corners stand out";
    EXPECT_EQ(relations(disc, box(400, 400, 500, 500)), "disjoint") << "in the corner of the box around the circle";
    EXPECT_EQ(relations(circle(500, 500, 50), frame), "disjoint") << "in the hole";
    EXPECT_EQ(relations(circle(200, 200, 200), frame), "within");
    EXPECT_EQ(relations(circle(200, 200, 250), frame), "overlaps");
    EXPECT_EQ(relations(circle(500, 500, 100), frame), "touches") << "the hole from inside";
}

TEST(Distances, AreFromEdgeToEdge) {
    EXPECT_DOUBLE_EQ(distance(spot(800, 0), disc), 300);
    EXPECT_DOUBLE_EQ(distance(spot(100, 0), disc), 0);
    EXPECT_DOUBLE_EQ(distance(disc, circle(0, 2'000, 500)), 1'000);
    EXPECT_DOUBLE_EQ(distance(spot(500, 500), frame), 100) << "from the hole to its edge";
    EXPECT_DOUBLE_EQ(distance(line({{0, 2'000}, {0, 3'000}}), square), 1'000);
    EXPECT_DOUBLE_EQ(distance(triangle, box(1'300, 0, 2'000, 400)), 300);
}

TEST(Geometries, ThatAreInvalidReportTheReason) {
    EXPECT_EQ(why_invalid(triangle), std::nullopt);
    EXPECT_EQ(why_invalid(frame), std::nullopt);
    EXPECT_THAT(why_invalid(polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}, {0, 0}})).value_or(""), HasSubstr("edges cross or touch"));
    EXPECT_THAT(why_invalid(polygon({{0, 0}, {1, 1}, {2, 2}, {0, 0}})).value_or(""), HasSubstr("enclose no area"));
    EXPECT_THAT(why_invalid(polygon({{0, 0}, {2, 0}, {0, 2}, {0, 0}}, {{{5, 5}, {6, 5}, {5, 6}, {5, 5}}})).value_or(""),
                HasSubstr("holes are not inside"));
    EXPECT_THAT(why_invalid(line({{1, 1}, {1, 1}})).value_or(""), HasSubstr("all the same"));
    EXPECT_THAT(why_invalid(circle(0, 0, 0)).value_or(""), HasSubstr("radius is not above 0"));
    EXPECT_THAT(why_invalid(circle(0, 0, 1e13)).value_or(""), HasSubstr("beyond 1e12 mm"));
}

// The origin of the map is at (1000, 2000) of the hall, and its x axis is the hall's y axis.
TEST(Geometries, AreMovedIntoAnotherFrame) {
    Frame map{.crs = "map", .base = "hall", .position = {1'000, 2'000, 0}, .orientation = {0, 0, 90}, .covariance = {}};
    Frames const frames{"hall", {map}};
    auto area = triangle;
    area.crs = "map";
    auto const moved = frames.moved(area, "hall");
    ASSERT_TRUE(moved);
    EXPECT_THAT(moved->paths.front(), ElementsAre(Geometry::Point{1'000, 2'000}, Geometry::Point{1'000, 3'000},
                                                  Geometry::Point{0, 2'000}, Geometry::Point{1'000, 2'000}));
    EXPECT_EQ(moved->low, (std::array<double, 3>{0, 2'000, 0}));
    auto round = circle(100, 0, 50);
    round.crs = "map";
    EXPECT_EQ(frames.moved(round, "hall")->paths.front().front(), (Geometry::Point{1'000, 2'100}));
    EXPECT_DOUBLE_EQ(frames.moved(round, "hall")->radius, 50);
    map.orientation = {10, 0, 0};
    EXPECT_EQ(Frames("hall", {map}).moved(round, "hall"), std::nullopt) << "a tilted circle is not a circle";
}

namespace {

Located robot_at(double x, double y) {
    return {.of = "location", .ref = "robot1", .crs = "hall", .position = {x, y, 0}, .orientation = {}, .certainty = {}};
}

// Two robots: `inside` stands in the triangle, `edge` on its slanted edge.
struct Areas : testing::Test {
    World world{named("edge", navigation), named("inside", navigation)};
    Application desk = world.connect();

    Areas() {
        world.engine->describe({.frames = {"hall"}, .all = {{"desk", box(400, 400, 600, 600, "hall")}}});
        world["inside"].where = robot_at(100, 100);
        world["edge"].where = robot_at(500, 500);
    }
    std::vector<std::string> found(SpatialRelation relation, std::vector<Expression> operands) {
        return desk.search(spatial(relation, std::move(operands)));
    }
    std::string reason(Condition condition) { return desk.ask(Search{std::move(condition)}).reason; }
};

}  // namespace

TEST_F(Areas, ChooseComponentsByEachOperator) {
    Expression const here = reference("location");
    EXPECT_THAT(found(SpatialRelation::within, {here, {triangle}}), ElementsAre("edge", "inside"));
    EXPECT_THAT(found(SpatialRelation::contains, {{triangle}, here}), ElementsAre("edge", "inside"));
    EXPECT_THAT(found(SpatialRelation::contains, {here, {triangle}}), IsEmpty()) << "a point cannot contain an area";
    EXPECT_THAT(found(SpatialRelation::contains, {here, {spot(100, 100)}}), ElementsAre("inside"));
    EXPECT_THAT(found(SpatialRelation::touches, {here, {triangle}}), ElementsAre("edge"));
    EXPECT_THAT(found(SpatialRelation::equals, {here, literal("500, 500")}), ElementsAre("edge"));
    EXPECT_THAT(found(SpatialRelation::disjoint, {here, {circle(0, 0, 500)}}), ElementsAre("edge"));
    EXPECT_THAT(found(SpatialRelation::crosses, {here, {triangle}}), IsEmpty()) << "a point cannot cross";
    EXPECT_THAT(found(SpatialRelation::overlaps, {here, {triangle}}), IsEmpty());
    EXPECT_THAT(found(SpatialRelation::crosses, {literal("desk"), {line({{0, 500}, {500, 500}})}}), ElementsAre("edge", "inside"))
        << "constantly true";
    EXPECT_THAT(found(SpatialRelation::touches, {{triangle}}), ElementsAre("edge")) << "one operand: the component's own place";
}

TEST_F(Areas, ReportWhyTheyAreInvalid) {
    auto const where = [&](Geometry geometry) { return reason(within("location", {std::move(geometry)})); };
    EXPECT_EQ(where(polygon({{0, 0}, {1, 1}, {1, 0}, {0, 1}, {0, 0}})),
              "the condition has a polygon whose edges cross or touch one another");
    Geometry::Points many{{0, 0}};
    for (int i = 0; i <= 3'000; ++i) many.push_back({static_cast<double>(i), 1});
    many.push_back({0, 0});
    EXPECT_THAT(where(polygon(many)), HasSubstr("more than 256 predicates; 8 points of a line or polygon count as one"));
    EXPECT_EQ(reason(within("location", literal("14000  5000"))),
              "the condition has the position '14000  5000', which has no commas; write 'x, y' or 'x, y, th'");
}

TEST_F(Areas, ThatMeanTheSameAreOneSubscription) {
    auto const id = [&](SpatialRelation relation, std::vector<Expression> operands) {
        return desk.subscribe("reached_target", spatial(relation, std::move(operands))).subscribe_id.text;
    };
    auto const here = reference("location");
    EXPECT_EQ(id(SpatialRelation::contains, {{triangle}, here}), id(SpatialRelation::within, {here, {triangle}}));
    EXPECT_EQ(id(SpatialRelation::touches, {{triangle}, here}), id(SpatialRelation::touches, {here, {triangle}}));
    EXPECT_NE(id(SpatialRelation::touches, {{triangle}, here}), id(SpatialRelation::touches, {{square}, here}));
    EXPECT_NE(id(SpatialRelation::disjoint, {{triangle}, here}), id(SpatialRelation::intersects, {{triangle}, here}));
}

}  // namespace rois
