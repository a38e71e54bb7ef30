// The effect of actions in the hall, as an application observes it through messages.
#include <cmath>
#include <numbers>
#include <sstream>

#include "server/conversation.hpp"

namespace rois::test {
namespace {

struct Acting : Conversation {
    struct Pose {
        double x = 0, y = 0, th = 0;  // mm, degrees
    };

    static Pose read_pose(std::string text) {
        std::ranges::replace(text, ',', ' ');
        std::istringstream in{text};
        Pose pose;
        in >> pose.x >> pose.y >> pose.th;
        return pose;
    }

    Pose where() { return read_pose(desk.query("robot_position").values()["position_data"].at(0)); }
};
ROIS_OVER_BOTH_WAYS(Acting);

// The end of a motion of Move, in the robot's frame before the motion.
struct Motion {
    std::string name, numbers;
    double ahead, left, turned;  // mm, degrees
};

TEST_P(Acting, MoveEndsWhereItsProfileSays) {
    desk.bind("navigation");
    desk.execute(Command{.component = "navigation", .id = "to the middle", .arguments = {target_position({"8000, 6000, 30"})}});
    EXPECT_EQ(desk.status_of("to the middle"), "OK");
    desk.release("navigation");
    desk.bind("move");
    for (auto const& motion : {Motion{"line", "800 90", 0, 800, 90}, Motion{"line", "-800 0", -800, 0, 0},
                               Motion{"line", "800 -90", 0, -800, -90}, Motion{"curve", "700 90", 700, 700, 90},
                               Motion{"curve", "700 -90", 700, -700, -90}, Motion{"curve", "-700 -90", -700, 700, -90}}) {
        auto const before = where();
        auto const id = motion.name + " " + motion.numbers;
        desk.execute(Command{.component = "move", .id = id, .arguments = {{motion.name, "int[]", {motion.numbers}}}});
        ASSERT_EQ(desk.status_of(id), "OK") << id;
        auto const after = where();
        double const th = before.th * std::numbers::pi / 180;
        double const dx = after.x - before.x, dy = after.y - before.y;
        EXPECT_NEAR(dx * std::cos(th) + dy * std::sin(th), motion.ahead, 100) << id;
        EXPECT_NEAR(dy * std::cos(th) - dx * std::sin(th), motion.left, 100) << id;
        EXPECT_NEAR(std::remainder(after.th - before.th - motion.turned, 360), 0, 5) << id;
    }
}

}  // namespace
}  // namespace rois::test
