// A low battery is a reason to leave a member.
#include "choosing/team.hpp"

namespace rois::choosing::test {

namespace {

using testing::Contains;
using testing::Not;

// A navigation with the read-only parameters `name` and `mode`.
Part with_reading(std::string const& robot, std::string const& name) {
    auto part = Team::driving(robot);
    auto& reading = part.profile.messages.emplace_back();
    reading.kind = MessageKind::query;
    reading.name = "get_parameter";
    for (auto const& each : {name, std::string{"mode"}}) {
        auto& result = reading.results.emplace_back();
        result.name = each;
        result.data_type_ref.code = "int";
    }
    return part;
}

class TwoBatteries : public testing::Test {
protected:
    TwoBatteries() {
        for (auto const* robot : {"robot1", "robot2"}) {
            team.world.change({robot + std::string{".navigation"}}, {with_reading(robot, "battery")});
            charge(robot, 90);
        }
        team.place("robot1", 0, 0);
        team.place("robot2", 10'000, 0);
    }
    void charge(std::string const& robot, int percent) {
        team.drive(robot).reads = ParameterList{integer("battery", percent)};
        team.look();
    }

    Team team{{"robot1", "robot2"}};
    Application desk = team.world.connect();
};

std::string parameters(Application& application) {
    application.bind("navigation");
    return in_words(application.ask(GetParameter{Application::identifier("navigation")}).parameters);
}

}  // namespace

TEST_F(TwoBatteries, AreShownByTheLogicalComponent) { EXPECT_THAT(parameters(desk), HasSubstr("battery=90")); }

TEST_F(TwoBatteries, AreNotShownIfAMemberHasNone) {
    team.world.change({"robot2.navigation"}, {with_reading("robot2", "mileage")});
    team.drive("robot1").reads = ParameterList{integer("battery", 90), integer("mode", 7)};
    team.look();
    EXPECT_THAT(team.log, Contains("navigation is offered without the parameter 'battery', which robot2.navigation lacks"));
    EXPECT_THAT(parameters(desk), AllOf(HasSubstr("mode=7"), Not(HasSubstr("battery"))));
}

TEST(AThirdRobotWithoutABattery, EndsNoCommandWhenItGoesOrReturns) {
    Team team{{"robot1", "robot2", "robot3"}};
    for (auto const* robot : {"robot1", "robot2"})
        team.world.change({robot + std::string{".navigation"}}, {with_reading(robot, "battery")});
    for (auto const* robot : {"robot1", "robot2", "robot3"}) team.place(robot, 0, 0);
    auto desk = team.world.connect();
    EXPECT_THAT(parameters(desk), Not(HasSubstr("battery")));
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    team.go("robot3");
    EXPECT_EQ(desk.result_of("go"), "RUNNING");
    team.come("robot3");
    EXPECT_EQ(desk.result_of("go"), "RUNNING");
    team.drive("robot1").finishes();
    EXPECT_EQ(desk.result_of("go"), "OK");
}

TEST_F(TwoBatteries, AreLeftForAnotherIfTheyGetLow) {
    bind(desk, "navigation", Switching::restart);
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    charge("robot1", 20);
    EXPECT_EQ(team.starts_of("robot2"), 0);
    charge("robot1", 19);
    EXPECT_EQ(team.starts_of("robot2"), 1);
    EXPECT_THAT(desk.received(), Contains("2 switched navigation from robot1.navigation to robot2.navigation"));
    EXPECT_EQ(desk.last_received<Switched>().reason, "the battery of robot1.navigation is low");
    desk.execute(drive_to("next", {"1000, 0, 0"}));
    EXPECT_EQ(team.starts_of("robot2"), 2) << "robot1 is nearer, but its battery is low";
}

TEST_F(TwoBatteries, AreUsedWhileThereIsNoBetterOne) {
    charge("robot2", 10);
    bind(desk, "navigation", Switching::restart);
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    charge("robot1", 5);
    EXPECT_EQ(team.starts_of("robot2"), 0);
    team.drive("robot1").finishes();
    EXPECT_EQ(desk.result_of("go"), "OK");
    desk.execute(drive_to("next", {"1000, 0, 0"}));
    charge("robot1", 4);
    EXPECT_EQ(desk.result_of("next"), "RUNNING") << "it was low when the command began";
}

TEST_F(TwoBatteries, EndTheCommandIfThatWasAgreed) {
    bind(desk, "navigation", Switching::abort);
    desk.execute(drive_to("go", {"1000, 0, 0"}));
    charge("robot1", 19);
    EXPECT_EQ(desk.result_of("go"), "ABORT");
    EXPECT_EQ(desk.reason_of("go"), "the battery of robot1.navigation is low");
}

}  // namespace rois::choosing::test
