// Robots that report and accept positions in their own frame.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "basic/body/wire_units.hpp"
#include "simulation/component_stage.hpp"

namespace rois::simulation::stage {
namespace {

using testing::ElementsAre;
using testing::SizeIs;

// The second robot stands at (2000, 6000). Its map has the origin (2000, 5000) and is turned to the left by 90 degrees: (x, y) of
// the hall is (y - 5000, 2000 - x) in the map.
FloorPlan with_map() {
    auto plan = reception_with_two_robots();
    plan.robots[1].frame = RobotFrame{.crs = "map", .origin = {Point{2, 5}, from_degrees(90)}};
    return plan;
}

std::vector<Role> guests() { return {visitor("guest", {does(Walk{at(5, 5)}), does(Face{at("robot2")}), does(Wait{1000})})}; }

Located sighting(FloorPlan plan, std::string& text) {
    Stage stage{guests(), std::move(plan)};
    stage.run(15);
    stage["robot2.person_localization"].start();
    stage.step();
    auto const events = stage["robot2.person_localization"].events("person_localized");
    text = value(events.at(0).results, "position_data");
    EXPECT_EQ(codebook_of(events.at(0).results, "position_data"), events.at(0).results.located.at(0).crs);
    return events.at(0).results.located.at(0);
}

TEST(RobotFrames, DefaultToTheFrameOfTheHall) {
    Stage stage{{}, with_map()};
    EXPECT_EQ(stage["navigation"].description().crs, "");
    EXPECT_EQ(stage["robot2.navigation"].description().crs, "map");
    EXPECT_EQ(stage["navigation"].location()->crs, "urn:x-rois:def:crs:simulation::hall");
}

TEST(RobotFrames, ApplyToTheRobotsPosition) {
    Stage stage{{}, with_map()};
    auto const here = *stage["robot2.navigation"].location();
    EXPECT_EQ(here.crs, "map");
    EXPECT_THAT(here.position, ElementsAre(1'000, 0, 0));
    EXPECT_THAT(here.orientation, ElementsAre(0, 0, -90));
}

TEST(RobotFrames, ApplyToSensedPositions) {
    std::string in_hall, in_map;
    auto const hall = sighting(reception_with_two_robots(), in_hall), map = sighting(with_map(), in_map);
    EXPECT_EQ(map.crs, "map");
    EXPECT_NEAR(map.position[0], hall.position[1] - 5'000, 0.01);
    EXPECT_NEAR(map.position[1], 2'000 - hall.position[0], 0.01);
    EXPECT_NEAR(std::remainder(map.orientation[2] - hall.orientation[2] + 90, 360), 0, 0.01);
    EXPECT_EQ(map.certainty, hall.certainty) << "the noise is the same along both axes";
    auto const seen = target_from_wire(in_map);
    ASSERT_TRUE(seen);
    EXPECT_NEAR(seen->position.x() * 1000, map.position[0], 0.51);
    EXPECT_NEAR(seen->position.y() * 1000, map.position[1], 0.51);
}

// (2000, -1000) in the map is (2000 + 1000, 5000 + 2000) in the hall.
TEST(RobotFrames, ApplyToTargets) {
    Stage stage{{}, with_map()};
    auto& navigation = stage["robot2.navigation"];
    navigation.start({positions("target_position", {"2000, -1000, -90", "start"}, "map")});
    ASSERT_TRUE(stage.run_until([&] { return !navigation.events("reached_target").empty(); }));
    EXPECT_NEAR(distance(stage.robot(1).position, Point{3, 7}), 0, 0.1);
    EXPECT_NEAR(stage.robot(1).heading, 0, 0.1);
    EXPECT_EQ(stage.outcome("robot2.navigation"), "OK");
    EXPECT_NEAR(distance(stage.robot(1).position, Point{2, 4}), 0, 1.1)
        << "names of places are the same in all frames: in front of the robot there";
    auto const reached = navigation.events("reached_target");
    ASSERT_THAT(reached, SizeIs(2));
    EXPECT_EQ(value(reached[0].results, "target"), "2000, -1000, -90");
    EXPECT_EQ(codebook_of(reached[0].results, "target"), "map");
}

}  // namespace
}  // namespace rois::simulation::stage
