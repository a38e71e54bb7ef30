#include "simulation/plan/planner.hpp"

#include "simulation/world_stage.hpp"

#include <gtest/gtest.h>

namespace rois::simulation {
namespace {

constexpr Metres radius = 0.28;

constexpr Agility robots{.speed = 0.9, .acceleration = 0.8, .turn_rate = 1.6, .turn_acceleration = 3.0};

Planner planner_of(FloorPlan const& plan) { return {plan, radius, robots}; }

// Whether every leg keeps clear of walls and desks.
void expect_free(FloorPlan const& plan, Point from, std::vector<Point> const& way) {
    for (Point const& corner : way) {
        EXPECT_TRUE(plan.can_go_straight(from, corner, radius - 0.01)) << from.transpose() << " to " << corner.transpose();
        from = corner;
    }
}

TEST(Planner, GoesStraightWithoutObstacles) {
    FloorPlan const plan = plain_hall();
    auto const way = planner_of(plan).way({Point{2, 4}, 0}, Point{8, 2}, RoutingPolicy::time);
    ASSERT_TRUE(way);
    EXPECT_EQ(*way, std::vector<Point>{Point(8, 2)});
}

TEST(Planner, GoesThroughTheDoor) {
    FloorPlan const plan = divided_hall();
    auto const planner = planner_of(plan);
    auto const way = planner.way({Point{2, 2}, 0}, Point{8, 2}, RoutingPolicy::distance);
    ASSERT_TRUE(way);
    EXPECT_EQ(way->back(), Point(8, 2));
    expect_free(plan, Point{2, 2}, *way);
    EXPECT_GT(length(Point{2, 2}, *way), 10);
    EXPECT_LT(length(Point{2, 2}, *way), 11.5) << "the path is smoothed";
}

TEST(Planner, FindsNoWayThroughWalls) {
    FloorPlan plan = plain_hall();
    plan.walls = {{Point{5, 0}, Point{5, 8}}};
    EXPECT_FALSE(planner_of(plan).way({Point{2, 2}, 0}, Point{8, 2}, RoutingPolicy::time));
}

TEST(Planner, FindsNoWayThroughADoorThatIsTooNarrow) {
    FloorPlan plan = plain_hall();
    plan.walls = {{Point{5, 0}, Point{5, 4}}, {Point{5, 4.5}, Point{5, 8}}};
    EXPECT_FALSE(planner_of(plan).way({Point{2, 2}, 0}, Point{8, 2}, RoutingPolicy::time));
}

TEST(Planner, FindsNoWayIntoADeskAWallOrOutOfTheHall) {
    FloorPlan plan = plain_hall();
    plan.desks = {{Point{4, 4}, Point{6, 5}}};
    auto const planner = planner_of(plan);
    for (Point const& to : {Point(5, 4.5), Point(5, 5.2), Point(0.1, 4), Point(11, 4), Point(1e12, 4)})
        EXPECT_FALSE(planner.way({Point{2, 2}, 0}, to, RoutingPolicy::time)) << to.transpose();
}

TEST(Planner, GoesAroundObstacles) {
    FloorPlan const plan = plain_hall();
    std::vector<Disc> const somebody{{Point{5, 4}, 0.25}};
    auto const way = planner_of(plan).way({Point{2, 4}, 0}, Point{8, 4}, RoutingPolicy::time, somebody);
    ASSERT_TRUE(way);
    Point from{2, 4};
    for (Point const& corner : *way) {
        EXPECT_GT(distance(Segment{from, corner}, somebody[0].centre), radius + 0.25);
        from = corner;
    }
}

TEST(Planner, LeavesAPlaceThatIsTooNearToAnObstacle) {
    FloorPlan const plan = plain_hall();
    std::vector<Disc> const beside{{Point{2.55, 4}, 0.25}};
    EXPECT_TRUE(planner_of(plan).way({Point{2, 4}, 0}, Point{8, 4}, RoutingPolicy::time, beside));
}

// From (1, 4) to (11, 4), a slalom between screens is shorter; the corridor above them has fewer turns.
FloorPlan slalom() {
    FloorPlan plan = plain_hall();
    plan.bounds = {Point{0, 0}, Point{12, 9}};
    plan.walls = {{Point{2, 7}, Point{10, 7}}};
    for (int i = 0; i < 6; ++i) {
        double const x = 2.5 + 1.4 * i;
        plan.walls.push_back(i % 2 == 0 ? Segment{Point{x, 0}, Point{x, 4.3}} : Segment{Point{x, 3.7}, Point{x, 7}});
    }
    return plan;
}

TEST(Planner, PolicyTimeSparesTurnsAndPolicyDistanceSparesMetres) {
    FloorPlan const plan = slalom();
    Agility slow_to_turn = robots;
    slow_to_turn.turn_rate = 0.5;
    Planner const planner{plan, radius, slow_to_turn};
    Pose const from{Point{1, 4}, from_degrees(90)};
    auto const fastest = planner.way(from, Point{11, 4}, RoutingPolicy::time);
    auto const shortest = planner.way(from, Point{11, 4}, RoutingPolicy::distance);
    ASSERT_TRUE(fastest && shortest);
    EXPECT_LT(duration(from, *fastest, slow_to_turn), duration(from, *shortest, slow_to_turn));
    EXPECT_GT(length(from.position, *fastest), length(from.position, *shortest));
}

TEST(Planner, FindsRoomBesideAnObstacle) {
    FloorPlan plan = plain_hall();
    plan.walls = {{Point{4.6, 0}, Point{4.6, 8}}};
    auto const planner = planner_of(plan);
    auto const room = planner.beside(Point{5, 4}, 1.0, Point{2, 4});
    ASSERT_TRUE(room) << "not on the other side of the wall";
    EXPECT_NEAR(distance(*room, Point{5, 4}), 1.0, 1e-9);
    EXPECT_GT(room->x(), 4.6 + radius);
    EXPECT_FALSE(planner.beside(Point{5, 4}, 20.0, Point{2, 4}));
}

}  // namespace
}  // namespace rois::simulation
