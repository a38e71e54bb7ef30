#include "simulation/robot/drive.hpp"

#include "simulation/world_stage.hpp"

#include <gtest/gtest.h>

namespace rois::simulation {
namespace {

// A person who stands at a point for a long time.
Role standing_at(Point const& p) { return tanaka({{Walk{{p}}, {}}, {Wait{3'600}, {}}}); }

TEST(Drive, KeepsItsLimits) {
    Hall hall{divided_hall(), nobody(), 1};
    Drive& drive = hall.drive(robot1);
    auto const go = drive.begin("navigation", GoTo{{{Point{8, 2}, from_degrees(0)}}});
    Twist before;
    MetresPerSecond fastest = 0;
    ASSERT_TRUE(runs_until(hall, 60, [&] {
        Twist const now = drive.twist();
        EXPECT_LE(std::abs(now.linear - before.linear), drive.plan().max_acceleration * 0.02 + 1e-9);
        EXPECT_LE(std::abs(now.angular - before.angular), drive.plan().max_turn_acceleration * 0.02 + 1e-9);
        EXPECT_LE(std::abs(now.linear), drive.plan().max_speed + 1e-9);
        EXPECT_LE(std::abs(now.angular), drive.plan().max_turn_rate + 1e-9);
        EXPECT_GE(hall.plan().clearance(drive.pose().position), drive.plan().radius);
        fastest = std::max(fastest, now.linear);
        before = now;
        return over(state(hall, robot1, *go));
    }));
    EXPECT_EQ(state(hall, robot1, *go), MotionState::arrived);
    EXPECT_GT(fastest, 0.85) << "uses the full speed";
}

TEST(Drive, ATargetInAWallIsUnreachableAndTheRobotStays) {
    Hall hall{divided_hall(), nobody(), 1};
    auto const go = hall.drive(robot1).begin("navigation", GoTo{{{Point{5, 3}, {}}}});
    hall.step();
    EXPECT_EQ(state(hall, robot1, *go), MotionState::unreachable);
    run(hall, 2);
    EXPECT_EQ(hall.robot(robot1).pose.position, Point(2, 4));
}

TEST(Drive, HasOneOwnerAtATime) {
    Hall hall{plain_hall(), nobody(), 1};
    Drive& drive = hall.drive(robot1);
    EXPECT_EQ(drive.owner(), "");
    EXPECT_FALSE(drive.current());
    auto const first = drive.begin("navigation", GoTo{{{Point{8, 4}, {}}}});
    EXPECT_EQ(drive.owner(), "navigation");
    EXPECT_FALSE(drive.begin("move", Line{0.5, 0})) << "busy";
    auto const second = drive.begin("navigation", GoTo{{{Point{4, 4}, {}}}});
    ASSERT_TRUE(second);
    EXPECT_EQ(state(hall, robot1, *first), MotionState::ended);
    drive.stop(*first);
    EXPECT_EQ(drive.owner(), "navigation") << "stop() ignores an old motion";
    drive.stop(*second);
    EXPECT_EQ(drive.owner(), "");
    EXPECT_TRUE(drive.begin("move", Line{0.5, 0}));
}

// How far the robot rolls if it is stopped like this at full speed. Fails unless it stands within 0.3 s.
Metres rolls_after(std::function<void(Drive&, MotionId)> const& stopped) {
    Hall hall{plain_hall(), nobody(), 1};
    Drive& drive = hall.drive(robot1);
    auto const line = drive.begin("move", Line{5, 0});
    run(hall, 3);
    EXPECT_GT(drive.twist().linear, 0.85);
    Point const there = drive.pose().position;
    stopped(drive, *line);
    run(hall, RobotPlan::time_to_stop);
    EXPECT_TRUE(drive.stands());
    EXPECT_FALSE(drive.is_stopping());
    return distance(there, drive.pose().position);
}

TEST(Drive, StandsWithinThreeTenthsOfASecondWhenStoppedHeldOrBraked) {
    EXPECT_NEAR(rolls_after([](Drive& drive, MotionId line) { drive.stop(line); }), 0.13, 0.02);
    EXPECT_NEAR(rolls_after([](Drive& drive, MotionId line) { drive.hold(line); }), 0.13, 0.02);
    EXPECT_NEAR(rolls_after([](Drive& drive, MotionId) { drive.brake(true); }), 0.13, 0.02);
    EXPECT_NEAR(rolls_after([](Drive& drive, MotionId line) {
                    drive.limit_speed(0.1);
                    drive.stop(line);
                }),
                0.13, 0.02);
}

TEST(Drive, StopsTurningWithinThreeTenthsOfASecond) {
    Hall hall{plain_hall(), nobody(), 1};
    Drive& drive = hall.drive(robot1);
    auto const turn = drive.begin("move", Line{0, from_degrees(170)});
    run(hall, 0.8);
    ASSERT_GT(drive.twist().angular, 1.5);
    drive.stop(*turn);
    run(hall, RobotPlan::time_to_stop);
    EXPECT_TRUE(drive.stands());
}

TEST(Drive, AMotionThatBeginsWhileTheRobotIsStoppingWaitsUntilItStands) {
    Hall hall{plain_hall(), nobody(), 1};
    Drive& drive = hall.drive(robot1);
    auto const line = drive.begin("navigation", Line{5, 0});
    run(hall, 3);
    drive.stop(*line);
    EXPECT_TRUE(drive.is_stopping());
    auto const next = drive.begin("move", Line{1, 0});
    ASSERT_TRUE(next);
    ASSERT_TRUE(runs_until(hall, RobotPlan::time_to_stop, [&] { return drive.stands(); }));
    EXPECT_FALSE(drive.is_stopping());
    ASSERT_TRUE(runs_until(hall, 10, [&] { return state(hall, robot1, *next) == MotionState::arrived; }));
}

TEST(Drive, ALineIsATurnAndThenADistance) {
    Hall hall{plain_hall(), nobody(), 1};
    auto const line = hall.drive(robot1).begin("move", Line{-1, from_degrees(-270)});
    Radians turned = 0, before = 0;
    ASSERT_TRUE(runs_until(hall, 20, [&] {
        Radians const heading = hall.robot(robot1).pose.heading;
        turned += wrapped(heading - before);
        before = heading;
        return over(state(hall, robot1, *line));
    }));
    EXPECT_EQ(state(hall, robot1, *line), MotionState::arrived);
    EXPECT_LT(distance(hall.robot(robot1).pose.position, Point{2, 3}), 0.02);
    EXPECT_NEAR(to_degrees(turned), -270, 0.5);
}

TEST(Drive, ACurveThroughAWallIsNotBegun) {
    Hall hall{plain_hall(), nobody(), 1};
    auto const curve = hall.drive(robot1).begin("move", Curve{4, from_degrees(180)});
    run(hall, 1);
    EXPECT_EQ(state(hall, robot1, *curve), MotionState::unreachable);
    EXPECT_EQ(hall.robot(robot1).pose.position, Point(2, 4));
}

TEST(Drive, StopsBeforeAPersonAndDrivesOnWhenTheyHaveLeft) {
    Role role = tanaka({{Walk{{Point{6, 4}}}, {}}, {Ignore{}, {}}, {Wait{40}, {}}, {Leave{}, {}}});
    Hall hall{plain_hall(), only(role), 1};
    ASSERT_TRUE(runs_until(hall, 20, [&] { return !hall.people().empty() && hall.people()[0].pose.position.x() < 6.2; }));
    auto const line = hall.drive(robot1).begin("move", Line{6, 0});
    ASSERT_TRUE(runs_until(hall, 20, [&] { return state(hall, robot1, *line) == MotionState::obstructed; }));
    Metres const gap = distance(hall.robot(robot1).pose.position, hall.people()[0].pose.position) - person_radius - 0.28;
    EXPECT_GT(gap, 0.05);
    EXPECT_LT(gap, 0.25);
    ASSERT_TRUE(runs_until(hall, 90, [&] { return state(hall, robot1, *line) == MotionState::arrived; }));
    EXPECT_NEAR(hall.robot(robot1).pose.position.x(), 8, 0.03);
}

TEST(Drive, DrivesAroundAPersonWhoStandsInTheWay) {
    Hall hall{plain_hall(), only(standing_at(Point{5, 4})), 1};
    run(hall, 10);
    auto const go = hall.drive(robot1).begin("navigation", GoTo{{{Point{8, 4}, {}}}});
    Metres nearest = 9;
    ASSERT_TRUE(runs_until(hall, 40, [&] {
        nearest = std::min(nearest, distance(hall.robot(robot1).pose.position, hall.people()[0].pose.position));
        return over(state(hall, robot1, *go));
    }));
    EXPECT_EQ(state(hall, robot1, *go), MotionState::arrived);
    EXPECT_GT(nearest, 0.28 + person_radius);
}

TEST(Drive, AnOccupiedTargetIsReachedAtAPoliteDistanceFacingTheOccupant) {
    Hall hall{plain_hall(), only(standing_at(Point{6, 5})), 1};
    run(hall, 10);
    auto const go = hall.drive(robot1).begin("navigation", GoTo{{{Point{6.1, 4.95}, 0}}});
    ASSERT_TRUE(runs_until(hall, 40, [&] { return over(state(hall, robot1, *go)); }));
    EXPECT_EQ(state(hall, robot1, *go), MotionState::arrived);
    Person const& person = hall.people()[0];
    EXPECT_NEAR(distance(hall.robot(robot1).pose.position, person.pose.position), polite_distance, 0.1);
    EXPECT_NEAR(bearing(hall.robot(robot1).pose, person.pose.position), 0, from_degrees(5));
}

TEST(Drive, FollowsAPersonAtADistance) {
    Role role = tanaka({{Walk{{Point{5, 4}}}, {}}, {Wait{20}, {}}, {Walk{{Point{5, 1}}}, {}}, {Wait{20}, {}}, {Leave{}, {}}});
    Hall hall{plain_hall(), only(role), 1};
    run(hall, 6);
    PersonId const whom = hall.people()[0].id;
    auto const follow = hall.drive(robot1).begin("follow", KeepDistance{entity_id(whom), 1.2});
    Metres nearest = 9;
    auto watch = [&](Seconds duration) {
        runs_until(hall, duration, [&] {
            if (Person const* person = hall.person(whom))
                nearest = std::min(nearest, distance(person->pose.position, hall.robot(robot1).pose.position));
            return false;
        });
    };
    watch(12);
    EXPECT_NEAR(distance(hall.person(whom)->pose.position, hall.robot(robot1).pose.position), 1.2, 0.27);
    EXPECT_NEAR(bearing(hall.robot(robot1).pose, hall.person(whom)->pose.position), 0, from_degrees(6));
    ASSERT_TRUE(runs_until(hall, 60, [&] { return hall.person(whom)->pose.position.y() < 1.3; })) << "the visitor goes on";
    watch(10);
    EXPECT_NEAR(distance(hall.person(whom)->pose.position, hall.robot(robot1).pose.position), 1.2, 0.27);
    EXPECT_EQ(state(hall, robot1, *follow), MotionState::moving) << "following never ends by itself";
    EXPECT_GT(nearest, 0.9);
    ASSERT_TRUE(runs_until(hall, 120, [&] { return over(state(hall, robot1, *follow)); }));
    EXPECT_EQ(state(hall, robot1, *follow), MotionState::lost) << "the visitor has left";
}

TEST(Drive, TwoRobotsMeetingHeadOnPassEachOther) {
    Hall hall{hall_with_two_robots(), nobody(), 1};
    auto const to_right = hall.drive(robot1).begin("navigation", GoTo{{{Point{8, 4}, {}}}});
    auto const to_left = hall.drive(robot2).begin("navigation", GoTo{{{Point{2, 4}, {}}}});
    Metres nearest = 9;
    ASSERT_TRUE(runs_until(hall, 90, [&] {
        nearest = std::min(nearest, distance(hall.robot(robot1).pose.position, hall.robot(robot2).pose.position));
        return over(state(hall, robot1, *to_right)) && over(state(hall, robot2, *to_left));
    }));
    EXPECT_EQ(state(hall, robot1, *to_right), MotionState::arrived);
    EXPECT_EQ(state(hall, robot2, *to_left), MotionState::arrived);
    EXPECT_GT(nearest, 0.56);
}

}  // namespace
}  // namespace rois::simulation
