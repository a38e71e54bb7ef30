#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "basic/base/codebooks.hpp"
#include "simulation/component_stage.hpp"

namespace rois::simulation::stage {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

Parameter whom(std::string ref) { return reference("target_object_ref", std::move(ref)); }

Role walker() {
    return visitor("guest",
                   {does(Walk{at(6, 4)}), does(Face{at("robot")}), does(Wait{12}), does(Walk{at(6, 1)}), does(Wait{1000})});
}

TEST(Follow, KeepsItsDistanceUntilItIsStopped) {
    Stage stage{{walker()}};
    stage.run(6);
    stage["follow"].start({whom("person-1"), integer("distance", 1500)});
    stage.run(60);
    EXPECT_THAT(stage["follow"].words(), ElementsAre("started"));
    Point const target = stage.hall().people().front().pose.position;
    EXPECT_LT(target.y(), 2);  // has gone on
    EXPECT_NEAR(distance(stage.robot().position, target), 1.5, 0.1);
    EXPECT_EQ(stage["follow"].description().status_when_stopped, CompletedStatus::ok);
    stage["follow"].stop();
    EXPECT_THAT(stage["follow"].words(), ElementsAre("started"));
}

TEST(Follow, AcceptsThePermanentIdOfAnIdentifiedPerson) {
    Stage stage{{known(visitor(
        "tanaka", {does(Walk{at(4, 4)}), does(Face{at("robot")}), does(Wait{10}), does(Walk{at(8, 2)}), does(Wait{1000})}))}};
    stage["person_identification"].start();
    ASSERT_TRUE(stage.run_until([&] { return !stage["person_identification"].events("person_identified").empty(); }, 20));
    stage["follow"].start({whom("tanaka"), integer("distance", 1000)});
    stage.run(60);
    EXPECT_THAT(stage["follow"].words(), ElementsAre("started"));
    Point const target = stage.hall().people().front().pose.position;
    EXPECT_GT(target.x(), 7);  // has gone on
    EXPECT_NEAR(distance(stage.robot().position, target), 1.0, 0.1);
}

TEST(Follow, AcceptsAnotherRobot) {
    Stage stage{{}, reception_with_two_robots()};
    stage["follow"].start({whom("robot2"), integer("distance", 1000)});
    stage["robot2.navigation"].start({texts("target_position", {"7000, 4000"})});
    EXPECT_EQ(stage.outcome("robot2.navigation"), "OK");
    stage.run(10);
    EXPECT_NEAR(distance(stage.robot(0).position, stage.robot(1).position), 1.0, 0.4);
}

TEST(Follow, WaitsForAKnownTargetThatIsNotInTheHallYet) {
    Stage stage{{known(visitor("tanaka", {does(Walk{at(4, 4)}), does(Face{at("robot")}), does(Wait{1000})}, 10))}};
    stage.step();
    auto& follow = stage["follow"];
    follow.start({whom("tanaka"), integer("distance", 1000)});
    auto const start = stage.robot().position;
    stage.run(9);
    EXPECT_THAT(follow.words(), ElementsAre("started"));
    EXPECT_EQ(follow.status(), ComponentStatus::warning);
    EXPECT_EQ(distance(stage.robot().position, start), 0) << "the robot stands";
    stage["move"].start({integers("line", "500 0")});
    EXPECT_EQ(stage["move"].ended(), "OUT_OF_RESOURCES") << "and keeps the wheels";
    stage.run(30);
    EXPECT_THAT(follow.words(), ElementsAre("started"));
    EXPECT_EQ(follow.status(), ComponentStatus::ready);
    EXPECT_NEAR(distance(stage.robot().position, stage.hall().people().front().pose.position), 1.0, 0.25);
}

TEST(Follow, FailsIfItsTargetIsUnknown) {
    for (auto const* unknown : {"ghost", "person-1", "person-99", "person-", "stranger-1"}) {
        Stage stage;
        stage.step();
        auto& follow = stage["follow"];
        follow.start({whom(unknown), integer("distance", 1000)});
        stage.run(4.9);
        EXPECT_THAT(follow.words(), ElementsAre("started")) << unknown;
        EXPECT_EQ(follow.status(), ComponentStatus::warning) << unknown;
        stage.run(0.2);
        EXPECT_EQ(follow.ended(), "ERROR") << unknown;
        EXPECT_THAT(follow.reason(), AllOf(HasSubstr("'target_object_ref'"), HasSubstr(unknown), HasSubstr("is unknown")));
        EXPECT_EQ(follow.status(), ComponentStatus::ready) << unknown;
        stage["move"].start({integers("line", "500 0")});
        EXPECT_EQ(stage.outcome("move"), "OK") << "the wheels are free again";
    }
}

TEST(Follow, FailsWhenItsTargetDoesNotComeBack) {
    Stage stage{{visitor("guest", {does(Walk{at(6, 4)}), does(Wait{3}), does(Leave{})})}};
    stage.run(6);
    auto& follow = stage["follow"];
    follow.start({whom("person-1"), integer("distance", 1000)});
    ASSERT_TRUE(stage.run_until([&] { return stage.hall().people().empty(); }, 120));
    stage.run(29);
    EXPECT_THAT(follow.words(), ElementsAre("started")) << "waits for a while";
    EXPECT_EQ(follow.status(), ComponentStatus::warning);
    stage.run(2);
    EXPECT_EQ(follow.ended(), "ERROR");
    EXPECT_EQ(follow.reason(), "'person-1' has not been seen for 30000 ms");
    EXPECT_EQ(follow.status(), ComponentStatus::ready);
}

TEST(Follow, DoesNotGiveUpWhileSuspended) {
    Stage stage;
    stage["follow"].start({whom("ghost"), integer("distance", 1000)});
    stage.run(1);
    stage["follow"].suspend();
    stage.run(20);
    EXPECT_FALSE(stage["follow"].ended());
    stage["follow"].resume();
    stage.run(6);
    EXPECT_EQ(stage["follow"].ended(), "ERROR");
}

// Decision 31: "robot2" is the name of a robot, not a temporary name.
TEST(Follow, LooksForItsTargetInTheCodebookOnly) {
    Stage stage{{}, reception_with_two_robots()};
    auto const follow = [&](std::string_view codebook) {
        stage["follow"].start({reference("target_object_ref", "robot2", std::string{codebook}), integer("distance", 1000)});
        stage.step();
        return stage["follow"].status();
    };
    EXPECT_EQ(follow(codebook::track), ComponentStatus::warning) << "waits for a track of this name";
    EXPECT_EQ(follow(codebook::robot), ComponentStatus::ready);
    EXPECT_EQ(follow(codebook::visitor), ComponentStatus::warning);
    EXPECT_EQ(follow(codebook::entity), ComponentStatus::ready);
}

TEST(Follow, KeepsItsTimeLimitWhileItWaits) {
    Stage stage;
    stage["follow"].start({whom("person-9"), integer("distance", 1000), integer("time_limit", 3000)});
    EXPECT_EQ(stage.outcome("follow"), "TIMEOUT");
    EXPECT_NEAR(in_seconds(stage.hall().now()), 3, 0.05);
    EXPECT_EQ(stage["follow"].reason(), "'person-9' has not been seen within time_limit, 3000 ms");
}

TEST(Follow, ContinuesWhenAPermanentIdIsIdentifiedAgain) {
    FloorPlan plan = reception();
    plan.robots[0].sensors.people.range = plan.robots[0].sensors.faces.range = plan.robots[0].sensors.sound.range = 2.5;
    // The target walks away while the robot is held.
    Stage stage{{known(visitor("tanaka", {does(Walk{at(4, 4)}), does(Face{at("robot")}), does(Wait{5}), does(Ignore{}),
                                          does(Walk{at(10, 2)}), does(Wait{20}), does(Walk{at(4, 4)}), does(Face{at("robot")}),
                                          does(Wait{1000})}))},
                plan};
    ASSERT_TRUE(stage.run_until([&] { return stage.hall().find("tanaka").has_value(); }));
    stage["follow"].start({whom("tanaka"), integer("distance", 1000)});
    stage["follow"].suspend();
    ASSERT_TRUE(stage.run_until([&] { return !stage.hall().find("tanaka"); }));
    stage["follow"].resume();
    stage.step();
    EXPECT_EQ(stage["follow"].status(), ComponentStatus::warning);
    ASSERT_TRUE(stage.run_until([&] { return stage.hall().find("tanaka").has_value(); }, 120));
    stage.run(10);
    EXPECT_THAT(stage["follow"].words(), ElementsAre("started"));
    EXPECT_EQ(stage["follow"].status(), ComponentStatus::ready);
    EXPECT_NEAR(distance(stage.robot().position, stage.hall().people().front().pose.position), 1.0, 0.2);
}

TEST(Follow, KeepsItsTimeLimit) {
    Stage stage{{walker()}};
    stage.run(6);
    stage["follow"].start({whom("person-1"), integer("distance", 1000), integer("time_limit", 3000)});
    auto const begun = stage.hall().now();
    EXPECT_EQ(stage.outcome("follow"), "TIMEOUT");
    EXPECT_NEAR(in_seconds(stage.hall().now() - begun), 3, 0.05);
}

TEST(Follow, StandsStillWhileSuspended) {
    Stage stage{{walker()}};
    stage.run(6);
    stage["follow"].start({whom("person-1"), integer("distance", 1000)});
    stage.run(1);
    stage["follow"].suspend();
    stage.run(2);
    auto const held = stage.robot().position;
    stage.run(10);
    EXPECT_EQ(distance(held, stage.robot().position), 0);
    stage["follow"].resume();
    stage.run(20);
    EXPECT_GT(distance(held, stage.robot().position), 1);
    EXPECT_THAT(stage["follow"].words(), ElementsAre("started"));
}

TEST(Follow, RefusesMissingAndInvalidParameters) {
    Stage stage;
    auto& follow = stage["follow"];
    EXPECT_THAT(follow.refusal("start", {integer("distance", 1000)}).value_or(""), HasSubstr("target_object_ref"));
    EXPECT_THAT(follow.refusal("start", {whom("person-1")}).value_or(""), HasSubstr("distance"));
    EXPECT_THAT(follow.refusal("set_parameter", {whom("robot")}).value_or(""), HasSubstr("itself"));
    EXPECT_TRUE(follow.refusal("set_parameter", {integer("distance", -1)}));
    EXPECT_TRUE(follow.refusal("set_parameter", {integer("time_limit", -1)}));
    EXPECT_FALSE(follow.refusal("set_parameter", {}));
}

}  // namespace
}  // namespace rois::simulation::stage
