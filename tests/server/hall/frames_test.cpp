// Located data in the frames of robots (decision 27). robot2 has its own map, with the origin at (20000,
// 0) of the hall, turned to the left by 90 degrees: (x, y) of the hall is (y, 20000 - x) of the map. The uncertainty of the
// placement is 20 mm and 0.5 degrees.
#include <iterator>
#include <numbers>
#include <sstream>

#include "server/conversation.hpp"

namespace rois::test {
namespace {

using testing::Contains;
using testing::Pair;

std::string const hall_frame = "urn:x-rois:def:crs:simulation::hall";
std::string const map_frame = "urn:x-rois:def:crs:simulation::robot2_map";

struct FramesOfRobots : testing::TestWithParam<Transport> {
    static GatewayProcess& hall() {
        static GatewayProcess two{{"--floor-plan", ROIS_SOURCE_DIR "/components/simulation/data/two-robots.xml", "--scenario",
                                   ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml", "--sim-speed", "20", "--seed", "1"}};
        return two;
    }

    FramesOfRobots() {
        desk.connect();
        desk.bind("robot2.navigation");
    }

    Document drive_to(std::string const& point, std::string const& crs) {
        return desk.ask("set_parameter",
                        element("component_ref", {{"rois:code", "robot2.navigation"}}) +
                            element("parameters", element("parameter", {{"rois:name", "target_position"}},
                                                          element("rois:data_type_ref",
                                                                  {{"rois:code", "string[]"}, {"rois:codebook_ref", crs}}) +
                                                              text_element("rois:value", point))));
    }

    Application desk{GetParam(), hall()};
};
ROIS_OVER_BOTH_WAYS(FramesOfRobots);

std::vector<double> numbers(pugi::xml_node node) {
    std::istringstream text{node.text().get()};
    return {std::istream_iterator<double>{text}, {}};
}

TEST_P(FramesOfRobots, AreChangedIntoTheEnginesOwnWithTheirCertainty) {
    auto const answer = desk.query("robot_position", where(equal("component_ref", "robot2.system_information")));
    EXPECT_THAT(answer, IsOk());
    EXPECT_EQ(answer.root()
                  .select_node("results/result[@rois:name='position_data']/rois:data_type_ref")
                  .node()
                  .attribute("rois:codebook_ref")
                  .value(),
              hall_frame);
    auto const located = answer.root().child("results").child("located");
    EXPECT_EQ(located.attribute("crs").value(), hall_frame);
    auto const position = numbers(located.child("position"));
    auto const rows = numbers(located.child("covariance"));
    ASSERT_EQ(position.size(), 3U);
    ASSERT_EQ(rows.size(), 9U);
    // The sum of the robot's own uncertainty (10 mm and 0.5 degrees), that of the map's placement, and the effect of the map's
    // uncertain turn: pi / 180 mm a degree for each mm from its origin.
    double const across_x = -position[1] * std::numbers::pi / 180, across_y = (position[0] - 20'000) * std::numbers::pi / 180;
    EXPECT_NEAR(rows[0], 100 + 400 + across_x * across_x * 0.25, 0.1);
    EXPECT_NEAR(rows[4], 100 + 400 + across_y * across_y * 0.25, 0.1);
    EXPECT_NEAR(rows[1], across_x * across_y * 0.25, 0.1);
    EXPECT_NEAR(rows[2], across_x * 0.25, 0.01);
    EXPECT_NEAR(rows[5], across_y * 0.25, 0.01);
    EXPECT_NEAR(rows[8], 0.25 + 0.25, 0.001);
}

// (6000, 5000) of the map is (15000, 6000) of the hall.
TEST_P(FramesOfRobots, AreTakenFromApplications) {
    EXPECT_THAT(desk.subscribe("reached_target", "", true), IsOk());
    EXPECT_THAT(drive_to("6000, 5000", map_frame), IsOk());
    desk.execute(Command{.component = "robot2.navigation", .id = "go"});
    EXPECT_THAT(desk.next_event("reached_target").values(), Contains(Pair("target", ElementsAre("15000, 6000"))));
    EXPECT_EQ(desk.status_of("go"), "OK");
    auto const there = box("14900 5900", "15100 6100"), mapped = box("5900 4900", "6100 5100", map_frame);
    auto const within = [&](Xml const& where_) {
        return desk.search(where(both(equal("name", "robot2.navigation"), related("Within", "location", where_))));
    };
    EXPECT_THAT(within(there), ElementsAre("robot2.navigation"));
    EXPECT_THAT(within(mapped), ElementsAre("robot2.navigation"));
    EXPECT_THAT(within(box("0 0", "1 1", map_frame)), IsEmpty());
    EXPECT_THAT(drive_to("14000, 5000, 180", hall_frame), IsOk());
    desk.execute(Command{.component = "robot2.navigation", .id = "back"});
    EXPECT_EQ(desk.status_of("back"), "OK");
}

}  // namespace
}  // namespace rois::test
