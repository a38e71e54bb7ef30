// Navigation, follow and move on a body of fakes.
#include <gmock/gmock.h>

#include "basic/fake_body.hpp"

namespace rois::basic::stage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class NavigationOfABody : public FakeRobot {
protected:
    Operated& start(std::vector<std::string> targets) {
        auto& navigation = (*this)["navigation"];
        navigation.start({positions("target_position", std::move(targets), "")});
        return navigation;
    }
};

TEST_F(NavigationOfABody, DrivesToItsTargetsAndReportsEach) {
    auto& navigation = start({"1000, 2000", "desk"});
    EXPECT_EQ(body->wheels.owner, "navigation");
    auto const& way = body->wheels.last<GoTo>();
    ASSERT_EQ(way.targets.size(), 2U);
    EXPECT_EQ(way.targets[0].position, (Point{1, 2}));
    EXPECT_EQ(way.targets[1].position, (Point{3, 2}));
    EXPECT_DOUBLE_EQ(way.targets[1].heading.value(), from_degrees(90));
    body->wheels.now.targets_reached = 1;
    step();
    EXPECT_EQ(value(navigation.events("reached_target").at(0).results, "target"), "1000, 2000");
    body->wheels.now = {MotionState::arrived, 2};
    step();
    EXPECT_EQ(value(navigation.events("reached_target").at(1).results, "is_final_target"), "true");
    EXPECT_EQ(navigation.ended(), "OK");
}

TEST_F(NavigationOfABody, SuspendHoldsTheMotionAndStopsTheTimeLimit) {
    auto& navigation = (*this)["navigation"];
    navigation.start({positions("target_position", {"door"}, ""), integer("time_limit", 1000)});
    navigation.suspend();
    EXPECT_EQ(body->wheels.now.state, MotionState::held);
    step(WorldTime{5'000});
    EXPECT_FALSE(navigation.ended());
    navigation.resume();
    EXPECT_EQ(body->wheels.now.state, MotionState::moving);
    step(WorldTime{999});
    EXPECT_FALSE(navigation.ended());
    step(WorldTime{1});
    EXPECT_EQ(navigation.ended(), "TIMEOUT");
}

TEST_F(NavigationOfABody, ConfirmsAHaltWhenTheRobotStands) {
    auto& navigation = start({"door"});
    body->wheels.brakes_slowly = true;
    EXPECT_EQ(navigation.stop(), Halted::not_yet);
    step();
    EXPECT_THAT(navigation.words(), ElementsAre("started"));
    body->wheels.report.stopping = false;
    step();
    EXPECT_THAT(navigation.words(), ElementsAre("started", "halted"));
}

TEST_F(NavigationOfABody, GivesUpABlockedWay) {
    auto& navigation = start({"door"});
    body->wheels.now.state = MotionState::obstructed;
    step();
    EXPECT_EQ(navigation.status(), ComponentStatus::warning);
    step(WorldTime{29'000});
    EXPECT_FALSE(navigation.ended());
    step(WorldTime{1'000});
    EXPECT_EQ(navigation.ended(), "ERROR");
    EXPECT_EQ(navigation.reason(), "a person or robot is in the way");
}

TEST_F(NavigationOfABody, EndsWithTheReasonOfTheBaseForARejection) {
    body->wheels.rejection = Rejection{CompletedStatus::out_of_resources, "the wheels are busy with move"};
    EXPECT_EQ(start({"door"}).ended(), "OUT_OF_RESOURCES");
    EXPECT_EQ((*this)["navigation"].reason(), "the wheels are busy with move");
    body->wheels.rejection = Rejection{.reason = "is in a wall", .target = 1};
    EXPECT_EQ(start({"desk", "door"}).ended(), "ERROR");
    EXPECT_EQ((*this)["navigation"].reason(), "'door' is in a wall");
}

TEST_F(NavigationOfABody, RefusesBadParameters) {
    EXPECT_THAT(refusal("navigation", "start", {}), HasSubstr("'target_position' is mandatory"));
    EXPECT_THAT(refusal("navigation", "start", {positions("target_position", {"attic"}, "")}), HasSubstr("desk, door"));
    EXPECT_THAT(refusal("navigation", "set_parameter", {text("routing_policy", "beauty")}), HasSubstr("'beauty'"));
    EXPECT_THAT(refusal("navigation", "set_parameter", {integer("time_limit", -1)}), HasSubstr("must be 0 or more, not -1"));
    EXPECT_EQ(refusal("navigation", "start", {positions("target_position", {"1, 2, 3"}, "")}), "accepted");
}

class MoveOfABody : public FakeRobot {};

TEST_F(MoveOfABody, DrivesALineOrACurve) {
    auto& move = (*this)["move"];
    move.start({integers("line", "1000 90"), integer("time", 2000)});
    auto const& line = body->wheels.last<Line>();
    EXPECT_DOUBLE_EQ(line.distance, 1);
    EXPECT_DOUBLE_EQ(line.turn, from_degrees(90));
    EXPECT_EQ(line.duration, 2.0);
    body->wheels.now.state = MotionState::arrived;
    step();
    EXPECT_EQ(move.ended(), "OK");
    move.start({integers("curve", "500 -90")});
    EXPECT_DOUBLE_EQ(body->wheels.last<Curve>().radius, 0.5);
    EXPECT_EQ(move.stop(), Halted::confirmed);
    EXPECT_EQ(body->wheels.now.state, MotionState::ended);
}

TEST_F(MoveOfABody, GivesUpBeforeAWallAtOnce) {
    auto& move = (*this)["move"];
    move.start({integers("line", "1000 0")});
    body->wheels.now.state = MotionState::unreachable;
    step();
    EXPECT_EQ(move.ended(), "ERROR");
    EXPECT_EQ(move.reason(), "a wall or desk is in the way");
}

TEST_F(MoveOfABody, WaitsForTheBrakes) {
    auto& move = (*this)["move"];
    body->wheels.brake(true);
    move.start({integers("line", "1000 0")});
    EXPECT_EQ(move.status(), ComponentStatus::warning);
    step(WorldTime{10'000});
    EXPECT_EQ(move.reason(), "the brakes of the robot are on");
}

TEST_F(MoveOfABody, RefusesBadParameters) {
    EXPECT_THAT(refusal("move", "start", {}), HasSubstr("mandatory"));
    EXPECT_THAT(refusal("move", "start", {integers("line", "1")}), HasSubstr("two numbers"));
    EXPECT_THAT(refusal("move", "start", {integers("line", "1 2"), integer("time", -5)}), HasSubstr("must be 0 or more, not -5"));
}

class FollowOfABody : public FakeRobot {
protected:
    Operated& start(std::string whom) {
        auto& follow = (*this)["follow"];
        follow.start({reference("target_object_ref", std::move(whom)), integer("distance", 1200)});
        return follow;
    }
};

TEST_F(FollowOfABody, KeepsItsDistanceUntilItIsStopped) {
    body->senses.names["person-3"] = EntityId{3};
    auto& follow = start("person-3");
    EXPECT_EQ(body->wheels.last<KeepDistance>().whom, EntityId{3});
    EXPECT_DOUBLE_EQ(body->wheels.last<KeepDistance>().distance, 1.2);
    step();
    EXPECT_EQ(body->wheels.motions.size(), 1U) << "the motion goes on";
    EXPECT_EQ(follow.description().status_when_stopped, CompletedStatus::ok);
    body->wheels.brakes_slowly = true;
    EXPECT_EQ(follow.stop(), Halted::not_yet);
    body->wheels.report.stopping = false;
    step();
    EXPECT_EQ(follow.words().back(), "halted");
}

TEST_F(FollowOfABody, WaitsForAMissingTargetAndFollowsItWhenItComesBack) {
    body->senses.names["person-3"] = EntityId{3};
    auto& follow = start("person-3");
    body->senses.names.clear();
    step();
    EXPECT_TRUE(std::holds_alternative<Stay>(body->wheels.motions.back()));
    EXPECT_EQ(follow.status(), ComponentStatus::warning);
    body->senses.names["person-3"] = EntityId{4};
    step();
    EXPECT_EQ(body->wheels.last<KeepDistance>().whom, EntityId{4});
    EXPECT_EQ(follow.status(), ComponentStatus::ready);
}

TEST_F(FollowOfABody, GivesUpAnUnknownTargetAfterFiveSeconds) {
    auto& follow = start("ghost");
    step(WorldTime{4'000});
    EXPECT_FALSE(follow.ended());
    step(WorldTime{5'000});
    EXPECT_EQ(follow.ended(), "ERROR");
    EXPECT_THAT(follow.reason(), HasSubstr("'ghost' is unknown"));
}

TEST_F(FollowOfABody, IsReadyAfterARejection) {
    body->wheels.rejection = Rejection{CompletedStatus::out_of_resources, "the wheels are busy with move"};
    auto& follow = start("ghost");
    EXPECT_EQ(follow.ended(), "OUT_OF_RESOURCES");
    EXPECT_EQ(follow.status(), ComponentStatus::ready);
    EXPECT_THAT(body->wheels.motions, IsEmpty());
}

TEST_F(FollowOfABody, RefusesBadParameters) {
    body->senses.names["fake"] = body->self();
    EXPECT_THAT(refusal("follow", "start", {reference("target_object_ref", "fake"), integer("distance", 1)}),
                HasSubstr("cannot follow itself"));
    EXPECT_THAT(refusal("follow", "start", {integer("distance", 1)}), HasSubstr("'target_object_ref' is mandatory"));
    EXPECT_THAT(refusal("follow", "start", {reference("target_object_ref", "x"), integer("distance", -1)}),
                HasSubstr("must be 0 or more, not -1"));
}

TEST(BatteryOfABody, IsAParameterOfTheComponentsThatDrive) {
    auto const body = std::make_shared<FakeBody>();
    body->charge = 41.7;
    std::vector<std::string> refs;
    for (auto const& component : robot_components({.bodies = {body}, .media = std::make_shared<FakeMedia>()}, own_profiles())) {
        auto const& [ref, profile] = std::tie(component->description().ref.code, component->description().profile);
        auto const* reading = find_message(*profile, MessageKind::query, "get_parameter");
        if (reading != nullptr && find_parameter(reading->results, "battery") != nullptr) refs.push_back(ref);
    }
    EXPECT_THAT(refs, testing::UnorderedElementsAre("navigation", "follow", "move"));
}

}  // namespace
}  // namespace rois::basic::stage
