#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/component_stage.hpp"

namespace rois::simulation::stage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Parameter to(std::vector<std::string> targets) { return texts("target_position", std::move(targets)); }

TEST(Navigation, ReportsTheReachedTargetBeforeItCompletes) {
    Stage stage;
    stage["navigation"].start({to({"5000, 4000, 90"})});
    EXPECT_EQ(stage.outcome("navigation"), "OK");
    EXPECT_THAT(stage["navigation"].words(), ElementsAre("started", "reached_target", "completed OK"));
    auto const reached = stage["navigation"].events("reached_target").at(0).results;
    EXPECT_EQ(value(reached, "target"), "5000, 4000, 90");
    EXPECT_EQ(value(reached, "is_final_target"), "true");
    EXPECT_NEAR(stage.robot().position.x(), 5, 0.1);
    EXPECT_NEAR(stage.robot().position.y(), 4, 0.1);
    EXPECT_NEAR(to_degrees(stage.robot().heading), 90, 5);
}

TEST(Navigation, VisitsItsTargetsInOrder) {
    Stage stage;
    stage["navigation"].start({to({"desk", "6000, 2000", "start"})});
    EXPECT_EQ(stage.outcome("navigation"), "OK");
    auto const reached = stage["navigation"].events("reached_target");
    ASSERT_THAT(reached, SizeIs(3));
    EXPECT_EQ(value(reached[0].results, "target"), "desk");
    EXPECT_EQ(value(reached[0].results, "is_final_target"), "false");
    EXPECT_EQ(value(reached[1].results, "target"), "6000, 2000");
    EXPECT_EQ(value(reached[2].results, "target"), "start");
    EXPECT_EQ(value(reached[2].results, "is_final_target"), "true");
    EXPECT_NEAR(distance(stage.robot().position, Point{2, 4}), 0, 0.1);
}

TEST(Navigation, RefusesInvalidPositions) {
    Stage stage;
    auto& navigation = stage["navigation"];
    for (auto target : {"the moon", "1, 2, 3, 4", "1", "", "nan, 1", "inf, 2"})
        EXPECT_TRUE(navigation.refusal("set_parameter", {to({"desk", target})})) << target;
    EXPECT_THAT(navigation.refusal("start", {to({"the moon"})}).value_or(""), HasSubstr("desk"));
    EXPECT_THAT(navigation.refusal("start", {}).value_or(""), HasSubstr("mandatory"));
    EXPECT_THAT(navigation.refusal("start", {to({})}).value_or(""), HasSubstr("mandatory"));
    EXPECT_TRUE(navigation.refusal("start", {to(std::vector<std::string>(101, "desk"))}));
    EXPECT_FALSE(navigation.refusal("start", {to({"desk", "1000, 2000", "1000, 2000, -90"})}));
}

TEST(Navigation, RefusesOtherPoliciesAndLimits) {
    Stage stage;
    auto& navigation = stage["navigation"];
    EXPECT_THAT(navigation.description().positions, ElementsAre("target_position")) << "the engine converts other frames";
    EXPECT_TRUE(navigation.refusal("set_parameter", {text("routing_policy", "scenery")}));
    EXPECT_FALSE(navigation.refusal("set_parameter", {text("routing_policy", "distance")}));
    EXPECT_TRUE(navigation.refusal("set_parameter", {integer("time_limit", -1)}));
}

TEST(Navigation, FailsWhenATargetIsOutsideOfTheHall) {
    Stage stage;
    for (auto target : {"-1000, 4000", "5000, 90000", "1e300, 0", "8000, 7000"}) {
        stage["navigation"].start({to({"desk", target})});
        EXPECT_EQ(stage.outcome("navigation", 1), "ERROR") << target;
        EXPECT_EQ(stage["navigation"].reason(),
                  "'" + std::string{target} + "' is outside of the hall, in a wall or in furniture");
    }
    EXPECT_THAT(stage["navigation"].events("reached_target"), IsEmpty());
}

TEST(Navigation, FailsWhenWallsLeaveNoWay) {
    Stage stage;
    stage["navigation"].start({to({"desk", "10000, 7000"})});  // behind the walls of the corner
    EXPECT_EQ(stage.outcome("navigation"), "ERROR");
    EXPECT_THAT(stage["navigation"].words(), ElementsAre("started", "reached_target", "completed ERROR"));
    EXPECT_EQ(stage["navigation"].reason(), "no way leads to '10000, 7000'");
}

TEST(Navigation, FailsWhenAPersonStaysInTheWay) {
    FloorPlan plan = reception();
    plan.walls = {{Point{6, 0}, Point{6, 3.5}}, {Point{6, 4.5}, Point{6, 8}}};  // a door, and a person who stands in it
    Stage stage{{visitor("guest", {does(Walk{at(6, 4)}), does(Wait{1000})})}, plan};
    stage.run(12);
    auto const begun = stage.hall().now();
    stage["navigation"].start({to({"10000, 4000"})});
    bool warned = false;
    stage.run_until(
        [&] {
            warned = warned || stage["navigation"].status() == ComponentStatus::warning;
            return stage["navigation"].ended().has_value();
        },
        120);
    EXPECT_EQ(stage["navigation"].ended(), "ERROR");
    EXPECT_EQ(stage["navigation"].reason(), "a person or robot is in the way");
    EXPECT_GE(stage.hall().now() - begun, WorldTime{30'000});
    EXPECT_TRUE(warned);
    EXPECT_LT(stage.robot().position.x(), 6);
    EXPECT_EQ(stage["navigation"].status(), ComponentStatus::ready);
}

TEST(Navigation, KeepsItsTimeLimit) {
    Stage stage;
    stage["navigation"].start({to({"11000, 4000"}), integer("time_limit", 2000)});
    EXPECT_EQ(stage.outcome("navigation"), "TIMEOUT");
    EXPECT_EQ(stage["navigation"].reason(), "target not reached within time_limit, 2000 ms");
    EXPECT_NEAR(in_seconds(stage.hall().now()), 2, 0.05);
    EXPECT_LT(stage.robot().position.x(), 5);
    auto const stood = (stage.run(2), stage.robot().position);
    stage.run(2);
    EXPECT_EQ(distance(stood, stage.robot().position), 0);
}

TEST(Navigation, ItsTimeLimitAppliesToAllTargetsTogether) {
    Stage stage;
    stage["navigation"].start({to({"4000, 4000", "2000, 4000", "4000, 4000", "2000, 4000"}), integer("time_limit", 10'000)});
    EXPECT_EQ(stage.outcome("navigation"), "TIMEOUT");
    EXPECT_NEAR(in_seconds(stage.hall().now()), 10, 0.05);
    EXPECT_GE(stage["navigation"].events("reached_target").size(), 1U) << "at least one target is reached in time";
}

TEST(Navigation, HasNoTimeLimitWhenItIsZero) {
    Stage stage;
    stage["navigation"].start({to({"10000, 4000"}), integer("time_limit", 0)});
    EXPECT_EQ(stage.outcome("navigation"), "OK");
}

TEST(Navigation, StandsStillWhileSuspendedAndItsTimeLimitToo) {
    Stage stage;
    stage["navigation"].start({to({"5000, 4000"}), integer("time_limit", 15'000)});
    stage.run(1);
    stage["navigation"].suspend();
    stage.run(2);
    auto const held = stage.robot().position;
    stage.run(30);
    EXPECT_EQ(distance(held, stage.robot().position), 0);
    EXPECT_FALSE(stage["navigation"].ended());
    stage["navigation"].resume();
    EXPECT_EQ(stage.outcome("navigation"), "OK");
}

TEST(Navigation, ConfirmsAHaltWhenTheRobotStands) {
    Stage stage;
    stage["navigation"].start({to({"10000, 4000"})});
    stage.run(2);
    EXPECT_EQ(stage["navigation"].stop(), Halted::not_yet);
    EXPECT_EQ(stage["navigation"].stop(), Halted::not_yet) << "also after a second stop";
    EXPECT_EQ(stage["move"].stop(), Halted::not_yet) << "all components share the drive";
    auto const is_confirmed = [&](auto ref) { return !stage[ref].events("halted").empty(); };
    ASSERT_TRUE(stage.run_until([&] { return is_confirmed("navigation"); }, 0.4));
    EXPECT_TRUE(is_confirmed("move"));
    auto const stood = stage.robot().position;
    stage.run(5);
    EXPECT_EQ(distance(stood, stage.robot().position), 0);
    EXPECT_THAT(stage["navigation"].words(), ElementsAre("started", "halted"));
    EXPECT_EQ(stage["navigation"].stop(), Halted::confirmed) << "the robot stands";
}

TEST(Navigation, ConfirmsAHaltAtOnceWhileNoTimePasses) {
    Stage stage{{}, reception(), {}, 0};
    stage["navigation"].start({to({"10000, 4000"})});
    stage.run(2);
    EXPECT_EQ(stage["navigation"].stop(), Halted::confirmed);
}

TEST(Navigation, AcceptsANewTargetWithANewStart) {
    Stage stage;
    stage["navigation"].start({to({"10000, 4000"})});
    stage.run(2);
    stage["navigation"].start({to({"start"})});
    EXPECT_EQ(stage.outcome("navigation"), "OK");
    EXPECT_NEAR(distance(stage.robot().position, Point{2, 4}), 0, 0.1);
}

TEST(Wheels, ObeyOneComponentAtATime) {
    Stage stage;
    stage["navigation"].start({to({"10000, 4000"})});
    stage.run(1);
    stage["move"].start({integers("line", "100 0")});
    EXPECT_THAT(stage["move"].words(), ElementsAre("completed OUT_OF_RESOURCES"));
    stage["follow"].start({reference("target_object_ref", "person-1"), integer("distance", 1000)});
    EXPECT_THAT(stage["follow"].words(), ElementsAre("completed OUT_OF_RESOURCES"));
    stage["navigation"].stop();
    stage["move"].start({});
    EXPECT_EQ(stage.outcome("move"), "OK");
}

TEST(Wheels, AreIndependentOfOtherRobots) {
    Stage stage{{}, reception_with_two_robots()};
    stage["navigation"].start({to({"6000, 4000"})});
    stage["robot2.move"].start({integers("line", "1000 0")});
    EXPECT_EQ(stage.outcome("robot2.move"), "OK");
    EXPECT_EQ(stage.outcome("navigation"), "OK");
    EXPECT_NEAR(stage.robot(1).position.x(), 3, 0.05);
    EXPECT_NEAR(stage.robot(0).position.x(), 6, 0.1);
}

}  // namespace
}  // namespace rois::simulation::stage
