#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "simulation/component_stage.hpp"

namespace rois::simulation::stage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Parameter line(std::string numbers) { return integers("line", std::move(numbers)); }
Parameter curve(std::string numbers) { return integers("curve", std::move(numbers)); }

// The world's time that a motion takes.
Seconds duration(ParameterList const& parameters) {
    Stage stage;
    stage["move"].start(parameters);
    EXPECT_EQ(stage.outcome("move"), "OK");
    return in_seconds(stage.hall().now());
}

TEST(Move, DrivesALineAndTurns) {
    Stage stage;
    stage["move"].start({line("1500 90")});
    EXPECT_THAT(stage["move"].words(), ElementsAre("started"));
    EXPECT_EQ(stage.outcome("move"), "OK");
    EXPECT_NEAR(stage.robot().position.x(), 3.5, 0.03);
    EXPECT_NEAR(stage.robot().position.y(), 4, 0.03);
    EXPECT_NEAR(to_degrees(stage.robot().heading), 90, 2);
}

TEST(Move, DrivesBackwards) {
    Stage stage;
    stage["move"].start({line("-500 0")});
    EXPECT_EQ(stage.outcome("move"), "OK");
    EXPECT_NEAR(stage.robot().position.x(), 1.5, 0.03);
}

TEST(Move, DrivesACurve) {
    Stage stage;
    stage["move"].start({curve("1000 90")});
    EXPECT_EQ(stage.outcome("move"), "OK");
    EXPECT_NEAR(stage.robot().position.x(), 3, 0.06);
    EXPECT_NEAR(stage.robot().position.y(), 5, 0.06);
    EXPECT_NEAR(to_degrees(stage.robot().heading), 90, 3);
}

TEST(Move, TakesTheTimeThatIsGiven) {
    EXPECT_LT(duration({line("1000 0")}), 4);
    EXPECT_NEAR(duration({line("1000 0"), integer("time", 8000)}), 8, 0.5);
    EXPECT_NEAR(duration({curve("1000 90"), integer("time", 9000)}), 9, 0.5);
    EXPECT_GT(duration({line("1000 0"), integer("time", 1)}), 1);  // no faster than the wheels can
}

TEST(Move, DrivesTheMotionThatCameLast) {
    Stage stage;
    auto& move = stage["move"];
    move.set_parameter({line("1000 0")});
    move.set_parameter({curve("1000 90")});
    EXPECT_EQ(find(move.stored(), "line"), nullptr);
    move.set_parameter({line("1000 0")});
    EXPECT_EQ(find(move.stored(), "curve"), nullptr);
}

TEST(Move, RefusesWhatIsNoMotion) {
    Stage stage;
    auto& move = stage["move"];
    EXPECT_THAT(move.refusal("start", {}).value_or(""), HasSubstr("mandatory"));
    EXPECT_THAT(move.refusal("set_parameter", {line("1000 0"), curve("1000 90")}).value_or(""), HasSubstr("not both"));
    EXPECT_THAT(move.refusal("set_parameter", {line("1000")}).value_or(""), HasSubstr("two numbers"));
    EXPECT_THAT(move.refusal("set_parameter", {curve("1000 90 3")}).value_or(""), HasSubstr("two numbers"));
    EXPECT_TRUE(move.refusal("set_parameter", {integer("time", -1)}));
    EXPECT_FALSE(move.refusal("start", {line("0 0")}));
}

TEST(Move, FailsWhenItIsBlockedForGood) {
    Stage stage;
    stage["move"].start({line("-5000 0")});  // the wall is 2 m behind
    EXPECT_EQ(stage.outcome("move"), "ERROR");
    EXPECT_GT(stage.robot().position.x(), 0.2);
}

TEST(Move, FailsWhenSomebodyStaysInTheWay) {
    Stage stage{{visitor("guest", {does(Walk{at(5, 4)}), does(Wait{1000})})}};
    stage.run(12);
    stage["move"].start({line("6000 0")});
    bool warned = false;
    stage.run_until([&] {
        warned = warned || stage["move"].component().status() == ComponentStatus::warning;
        return stage["move"].ended().has_value();
    });
    EXPECT_EQ(stage["move"].ended(), "ERROR");
    EXPECT_TRUE(warned);
    EXPECT_EQ(stage["move"].component().status(), ComponentStatus::ready);
}

TEST(Move, GoesOnWhereItWasHeld) {
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
