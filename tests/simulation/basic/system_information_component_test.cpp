#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/component_stage.hpp"

namespace rois::simulation::stage {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::SizeIs;

TEST(SystemInformation, ReportsThePositionOfTheRobot) {
    Stage stage;
    stage.run(1);
    auto const results = stage["system_information"].query("robot_position");
    EXPECT_EQ(value(results, "timestamp"), to_text(stage.now().utc));
    EXPECT_THAT(values(results, "robot_ref"), ElementsAre("robot"));
    auto const point = target_from_wire(value(results, "position_data"));
    ASSERT_TRUE(point);
    EXPECT_NEAR(point->position.x(), 2, 0.06);
    EXPECT_NEAR(point->position.y(), 4, 0.06);
    ASSERT_THAT(results.located, SizeIs(1));
    EXPECT_EQ(results.located[0].of, "position_data");
    EXPECT_EQ(results.located[0].ref, "robot");
    auto const& covariance = std::get<Located::Covariance>(results.located[0].certainty).rows;
    ASSERT_THAT(covariance, SizeIs(9));
    EXPECT_THAT(covariance[0], DoubleNear(100, 0.01));
    EXPECT_THAT(covariance[8], DoubleNear(0.25, 0.001));
}

TEST(RobotComponents, HaveThePositionOfTheirRobot) {
    Stage stage{{}, reception_with_two_robots()};
    auto const here = stage["navigation"].location();
    ASSERT_TRUE(here);
    EXPECT_EQ(here->ref, "robot");
    EXPECT_EQ(here->crs, "urn:x-rois:def:crs:simulation::hall");
    EXPECT_EQ(here->position, (std::array<double, 3>{2'000, 4'000, 0}));
    auto const there = stage["robot2.speech_synthesis"].location();
    ASSERT_TRUE(there);
    EXPECT_EQ(there->ref, "robot2");
    EXPECT_EQ(there->position, (std::array<double, 3>{2'000, 6'000, 0}));
}

TEST(SystemInformation, ReportsTheSameTwiceWithinAStep) {
    Stage stage;
    stage.run(1);
    auto const first = stage["system_information"].query("robot_position");
    auto const second = stage["system_information"].query("robot_position");
    EXPECT_EQ(first.parameters, second.parameters);
    EXPECT_EQ(first.located, second.located);
}

TEST(SystemInformation, ReportsTheStatusOfTheEngine) {
    Stage stage;
    EXPECT_EQ(value(stage["system_information"].query("engine_status"), "status"), "UNINITIALIZED");
    stage.step();
    auto const begun = stage.now().utc;
    stage.run(5);
    auto const results = stage["system_information"].query("engine_status");
    EXPECT_EQ(value(results, "status"), "READY");
    EXPECT_EQ(value(results, "operable_time"), to_text(begun));
}

TEST(SystemInformation, WarnsWhileTheRobotIsObstructed) {
    Stage stage{{visitor("guest", {does(Walk{at(5, 4)}), does(Wait{1000})})}};
    stage.run(12);
    stage["move"].start({integers("line", "6000 0")});
    EXPECT_TRUE(
        stage.run_until([&] { return value(stage["system_information"].query("engine_status"), "status") == "WARNING"; }, 20));
}

TEST(SystemInformation, AnswersNoOtherQuery) {
    Stage stage;
    stage.step();
    EXPECT_THAT(stage["system_information"].rows("weather"), testing::IsEmpty());
}

TEST(SystemInformation, ReportsOnlyItsOwnRobot) {
    Stage stage{{}, reception_with_two_robots()};
    stage.step();
    EXPECT_THAT(values(stage["robot2.system_information"].query("robot_position"), "robot_ref"), ElementsAre("robot2"));
}

}  // namespace
}  // namespace rois::simulation::stage
