#include "simulation/plan/routing.hpp"

#include <gtest/gtest.h>

#include "simulation/world_stage.hpp"

namespace rois::simulation {
namespace {

constexpr Agility robots{.speed = 0.9, .acceleration = 0.8, .turn_rate = 1.6, .turn_acceleration = 3.0};

TEST(Routing, ALegIsSlowerWithStopsAtItsEnds) {
    EXPECT_NEAR(leg_duration(9, 0.9, 0.9, robots), 10, 1e-9);
    EXPECT_NEAR(leg_duration(9, 0, 0, robots), 10 + 0.9 / 0.8, 1e-9);
    EXPECT_NEAR(leg_duration(0.2, 0, 0, robots), 1, 1e-9) << "too short for full speed";
}

TEST(Routing, BendsAreTakenOnTheWayAndSharpCornersOnTheSpot) {
    EXPECT_NEAR(corner_speed(0, robots), 0.9, 1e-9);
    EXPECT_NEAR(corner_speed(-sharpest_bend / 2, robots), 0.45, 1e-9);
    EXPECT_GT(passing_speed(0.3, robots), corner_speed(0.3, robots)) << "passes before the corner itself";
    EXPECT_EQ(passing_speed(1.5, robots), 0);
    EXPECT_EQ(corner_duration(0.3, robots), 0);
    std::vector<Point> const straight{{4, 0}, {8, 0}}, sharp{{4, 0}, {4, 4}};
    Seconds const stopping = 0.9 / 0.8;
    EXPECT_NEAR(duration({Point{0, 0}, 0}, straight, robots), 8 / 0.9 + stopping, 1e-9);
    EXPECT_NEAR(duration({Point{0, 0}, 0}, sharp, robots), 8 / 0.9 + 2 * stopping + corner_duration(from_degrees(90), robots),
                1e-9);
}

// The real drive of a robot between two places of the shipped hall, without obstacles.
struct Journey {
    Seconds took = 0;
    Metres gone = 0;
};

Journey journey(std::string const& from, std::string const& to, RoutingPolicy policy) {
    FloorPlan plan = shipped_plan("reception-hall.xml");
    plan.robots[0].start = plan.place(from)->pose;
    Hall hall{plan, nobody(), 1};
    Place const& target = *plan.place(to);
    auto const go = hall.drive(robot1).begin("navigation", GoTo{{{target.pose.position, target.pose.heading}}, policy});
    Journey made;
    Point at = hall.robot(robot1).pose.position;
    EXPECT_TRUE(runs_until(hall, 120,
                           [&] {
                               made.gone += distance(at, hall.robot(robot1).pose.position);
                               at = hall.robot(robot1).pose.position;
                               return state(hall, robot1, *go) == MotionState::arrived;
                           }))
        << from << " to " << to;
    made.took = in_seconds(hall.now());
    return made;
}

TEST(Routing, PolicyTimeIsTheFasterOneAndPolicyDistanceTheShorterOneInTheShippedHall) {
    FloorPlan const plan = shipped_plan("reception-hall.xml");
    Seconds saved = 0;
    for (Place const& from : plan.places) {
        for (Place const& to : plan.places) {
            if (from.name == to.name) continue;
            Journey const fast = journey(from.name, to.name, RoutingPolicy::time);
            Journey const brief = journey(from.name, to.name, RoutingPolicy::distance);
            EXPECT_LE(fast.took, brief.took + 0.1) << from.name << " to " << to.name;
            EXPECT_LE(brief.gone, fast.gone + 0.05) << from.name << " to " << to.name;
            saved += brief.took - fast.took;
        }
    }
    EXPECT_GT(saved, 10) << "seconds over all pairs";
}

}  // namespace
}  // namespace rois::simulation
