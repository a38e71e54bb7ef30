#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/component_stage.hpp"

namespace rois::simulation::stage {
namespace {

using testing::HasSubstr;

Parameter line(std::string numbers) { return integers("line", std::move(numbers)); }
Parameter curve(std::string numbers) { return integers("curve", std::move(numbers)); }

// The duration of a motion in world time.
Seconds duration(ParameterList const& parameters) {
    Stage stage;
    stage["move"].start(parameters);
    EXPECT_EQ(stage.outcome("move"), "OK");
    return in_seconds(stage.hall().now());
}

// A motion from (6, 4) with heading 30 degrees: its end in the robot's frame before the motion.
struct MotionCase {
    Parameter motion;
    double ahead, left;  // mm
    double turned;       // degrees
};
void PrintTo(MotionCase const& motion, std::ostream* out) { *out << motion.motion.name << " " << motion.motion.values.front(); }

class MoveEnds : public testing::TestWithParam<MotionCase> {};

TEST_P(MoveEnds, AtThePoseThatItsProfileDescribes) {
    FloorPlan plan = reception();
    plan.robots[0].start = {Point{6, 4}, from_degrees(30)};
    Stage stage{{}, plan};
    stage["move"].start({GetParam().motion});
    EXPECT_EQ(stage.outcome("move"), "OK");
    Point const gone = 1000 * (frame(plan.robots[0].start).inverse() * stage.robot().position);
    EXPECT_NEAR(gone.x(), GetParam().ahead, 0.5);
    EXPECT_NEAR(gone.y(), GetParam().left, 0.5);
    EXPECT_NEAR(to_degrees(wrapped(stage.robot().heading - from_degrees(30 + GetParam().turned))), 0, 0.2);
}

INSTANTIATE_TEST_SUITE_P(Line, MoveEnds,
                         testing::Values(MotionCase{line("1500 0"), 1500, 0, 0}, MotionCase{line("-1500 0"), -1500, 0, 0},
                                         MotionCase{line("1500 90"), 0, 1500, 90}, MotionCase{line("1500 -90"), 0, -1500, -90},
                                         MotionCase{line("-1500 90"), 0, -1500, 90}, MotionCase{line("1000 180"), -1000, 0, 180},
                                         MotionCase{line("1000 -60"), 500, -866, -60}, MotionCase{line("0 -135"), 0, 0, -135},
                                         MotionCase{line("1000 450"), 0, 1000, 90}));
INSTANTIATE_TEST_SUITE_P(Curve, MoveEnds,
                         testing::Values(MotionCase{curve("1000 90"), 1000, 1000, 90},
                                         MotionCase{curve("1000 -90"), 1000, -1000, -90},
                                         MotionCase{curve("-1000 90"), -1000, -1000, 90},
                                         MotionCase{curve("-1000 -90"), -1000, 1000, -90},
                                         MotionCase{curve("1000 180"), 0, 2000, 180}, MotionCase{curve("500 360"), 0, 0, 0},
                                         MotionCase{curve("0 120"), 0, 0, 120}, MotionCase{curve("800 0"), 0, 0, 0}));

INSTANTIATE_TEST_SUITE_P(ShortLine, MoveEnds,
                         testing::Values(MotionCase{line("1 0"), 1, 0, 0}, MotionCase{line("-1 0"), -1, 0, 0},
                                         MotionCase{line("5 0"), 5, 0, 0}, MotionCase{line("-8 0"), -8, 0, 0},
                                         MotionCase{line("20 -90"), 0, -20, -90}, MotionCase{line("0 1"), 0, 0, 1}));
INSTANTIATE_TEST_SUITE_P(SmallCurve, MoveEnds,
                         testing::Values(MotionCase{curve("1 90"), 1, 1, 90}, MotionCase{curve("5 90"), 5, 5, 90},
                                         MotionCase{curve("-5 90"), -5, -5, 90}, MotionCase{curve("5 -90"), 5, -5, -90},
                                         MotionCase{curve("-5 -90"), -5, 5, -90}, MotionCase{curve("10 90"), 10, 10, 90},
                                         MotionCase{curve("20 90"), 20, 20, 90}, MotionCase{curve("-20 -90"), -20, 20, -90},
                                         MotionCase{curve("10 720"), 0, 0, 0}, MotionCase{curve("30 20"), 10.3, 1.8, 20},
                                         MotionCase{curve("100 6"), 10.5, 0.5, 6}, MotionCase{curve("-100 -6"), -10.5, 0.5, -6},
                                         MotionCase{curve("1000 1"), 17.5, 0.2, 1}, MotionCase{curve("0 -1"), 0, 0, -1}));

// The length of the robot's path, in mm.
double way(Parameter const& motion) {
    Stage stage;
    stage["move"].start({motion});
    double sum = 0;
    for (Point before = stage.robot().position; !stage["move"].ended(); before = stage.robot().position) {
        stage.step();
        sum += 1000 * distance(before, stage.robot().position);
    }
    return sum;
}

TEST(Move, DrivesAnArcOfTheLengthThatItsProfileDescribes) {
    EXPECT_NEAR(way(curve("1000 90")), 1571, 20);
    EXPECT_NEAR(way(curve("-1000 -90")), 1571, 20);
    EXPECT_NEAR(way(curve("500 -720")), 6283, 40);
    EXPECT_NEAR(way(line("-1200 90")), 1200, 20);
}

TEST(Move, TurnsBeforeItDrivesALine) {
    Stage stage;
    stage["move"].start({line("1500 90")});
    ASSERT_TRUE(stage.run_until([&] { return stage.robot().position != Point(2, 4); }));
    EXPECT_NEAR(to_degrees(stage.robot().heading), 90, 1.5);
    EXPECT_EQ(stage.outcome("move"), "OK");
}

TEST(Move, StaysWhereAWallIsInTheDirectionOfTheLine) {
    FloorPlan plan = reception();
    plan.robots[0].start = {Point{6, 7}, 0};
    Stage stage{{}, plan};
    stage["move"].start({line("1500 90")});
    EXPECT_EQ(stage.outcome("move"), "ERROR");
    EXPECT_EQ(stage.robot().position, Point(6, 7));
    EXPECT_EQ(stage.robot().heading, 0);
    stage["move"].start({line("1500 -90")});
    EXPECT_EQ(stage.outcome("move"), "OK");
}

TEST(Move, IsRejectedAtOnceWhenItsEndIsTooNearAWall) {
    Stage stage;  // 1720 mm behind the robot are free; it keeps 15 mm to the wall
    auto const outcome = [&](Parameter const& motion) {
        auto const begun = stage.hall().now();
        stage["move"].start({motion});
        auto const ended = stage.outcome("move");
        if (ended != "OK") {
            EXPECT_LT(in_seconds(stage.hall().now() - begun), 0.1) << motion.values.front();
        }
        return ended;
    };
    EXPECT_EQ(outcome(line("-1710 0")), "ERROR");
    EXPECT_EQ(stage.robot().position, Point(2, 4));
    EXPECT_EQ(outcome(line("-1700 0")), "OK");
    EXPECT_EQ(outcome(line("-3 0")), "OK");
    EXPECT_EQ(outcome(line("-5 0")), "ERROR");
    EXPECT_EQ(outcome(line("10 0")), "OK");
    EXPECT_NEAR(stage.robot().position.x(), 0.307, 0.001);
    EXPECT_EQ(outcome(curve("0 90")), "OK");
    EXPECT_EQ(outcome(curve("20 90")), "ERROR");
    EXPECT_EQ(outcome(curve("10 90")), "OK");
}

TEST(Move, TakesTheGivenTime) {
    EXPECT_LT(duration({line("1000 0")}), 4);
    EXPECT_NEAR(duration({line("1000 0"), integer("time", 8000)}), 8, 0.5);
    EXPECT_NEAR(duration({curve("1000 90"), integer("time", 9000)}), 9, 0.5);
    EXPECT_NEAR(duration({line("0 90"), integer("time", 8000)}), 8, 0.5);
    EXPECT_NEAR(duration({curve("0 90"), integer("time", 6000)}), 6, 0.5);
    EXPECT_GT(duration({line("1000 0"), integer("time", 1)}), 1);  // not faster than the robot's limits
}

TEST(Move, TakesTheGivenTimeForASmallOrSlowMotion) {
    EXPECT_NEAR(duration({line("5 0"), integer("time", 5000)}), 5, 0.3);
    EXPECT_NEAR(duration({line("50 0"), integer("time", 30'000)}), 30, 0.3) << "1.7 mm/s does not count as standing";
    EXPECT_NEAR(duration({curve("10 90"), integer("time", 10'000)}), 10, 0.3);
    EXPECT_NEAR(duration({curve("1000 3"), integer("time", 30'000)}), 30, 0.3);
}

TEST(Move, DrivesTheLastMotion) {
    Stage stage;
    auto& move = stage["move"];
    move.set_parameter({line("1000 0")});
    move.set_parameter({curve("1000 90")});
    EXPECT_EQ(find(move.stored(), "line"), nullptr);
    move.set_parameter({line("1000 0")});
    EXPECT_EQ(find(move.stored(), "curve"), nullptr);
}

TEST(Move, RefusesInvalidMotions) {
    Stage stage;
    auto& move = stage["move"];
    EXPECT_THAT(move.refusal("start", {}).value_or(""), HasSubstr("mandatory"));
    EXPECT_THAT(move.refusal("set_parameter", {line("1000 0"), curve("1000 90")}).value_or(""), HasSubstr("set only one"));
    EXPECT_THAT(move.refusal("set_parameter", {line("1000")}).value_or(""), HasSubstr("two numbers"));
    EXPECT_THAT(move.refusal("set_parameter", {curve("1000 90 3")}).value_or(""), HasSubstr("two numbers"));
    EXPECT_TRUE(move.refusal("set_parameter", {integer("time", -1)}));
    EXPECT_FALSE(move.refusal("start", {line("0 0")}));
}

TEST(Move, FailsWhenAPersonStaysInTheWay) {
    Stage stage{{visitor("guest", {does(Walk{at(5, 4)}), does(Wait{1000})})}};
    stage.run(12);
    stage["move"].start({line("6000 0")});
    bool warned = false;
    stage.run_until([&] {
        warned = warned || stage["move"].status() == ComponentStatus::warning;
        return stage["move"].ended().has_value();
    });
    EXPECT_EQ(stage["move"].ended(), "ERROR");
    EXPECT_TRUE(warned);
    EXPECT_EQ(stage["move"].status(), ComponentStatus::ready);
}

TEST(Move, ResumesWhereItWasSuspended) {
    Stage stage;
    stage["move"].start({line("2000 0")});
    stage.run(1);
    stage["move"].suspend();
    stage.run(10);
    EXPECT_FALSE(stage["move"].ended());
    stage["move"].resume();
    EXPECT_EQ(stage.outcome("move"), "OK");
    EXPECT_NEAR(stage.robot().position.x(), 4, 0.05);
}

}  // namespace
}  // namespace rois::simulation::stage
