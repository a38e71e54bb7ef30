// Units whose placement is wrong are found, and no others.
#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>
#include <ostream>

#include "choosing/simulator.hpp"

namespace rois::choosing::stage {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr double degrees = std::numbers::pi / 180;

SimulatedUnit unit(std::string name, double deviation = 0.05) {
    SimulatedUnit made;
    made.name = std::move(name);
    made.noise = made.claimed = deviation;
    made.period = 0.2;
    return made;
}

std::function<bool(Vector const&)> between(double from, double to) {
    return [=](Vector const& p) { return p.x() >= from && p.x() <= to; };
}

std::vector<std::string> misplaced(Simulator const& world) {
    std::vector<std::string> names;
    for (auto const& each : world.fusion.misplaced()) names.push_back(each.unit);
    return names;
}

// Returns the time until the unit is reported, in seconds; the limit if it is not reported.
double detection_time(Simulator& world, std::string const& name, double limit) {
    std::optional<double> found;
    while (!found && world.time < limit) {
        world.run(1);
        if (std::ranges::count(misplaced(world), name) > 0) found = world.time;
    }
    return found.value_or(limit);
}

struct Wrong {
    std::string title;
    double turned = 0;
    Vector shifted = Vector::Zero();
    double deviation = 0.05;
    double period = 0.2;
    double reports_from = 0;
    int walkers = 4;
};
std::ostream& operator<<(std::ostream& out, Wrong const& wrong) { return out << wrong.title; }

class WrongPlacement : public testing::TestWithParam<Wrong> {
protected:
    static SimulatedUnit made(std::string name) {
        SimulatedUnit made = unit(std::move(name), GetParam().deviation);
        made.period = GetParam().period;
        made.reports_from = GetParam().reports_from;
        return made;
    }
    static SimulatedUnit wrong(std::string name) {
        SimulatedUnit unit = made(std::move(name));
        unit.turned = GetParam().turned;
        unit.shifted = GetParam().shifted;
        unit.delay = 0.06;
        return unit;
    }
};

TEST_P(WrongPlacement, IsFoundWithinAMinute) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
        Simulator world{seed};
        world.add(made("right"));
        world.add(wrong("wrong"));
        world.add_walkers(GetParam().walkers);
        EXPECT_LT(detection_time(world, "wrong", 120), 60) << "seed " << seed;
    }
}

TEST_P(WrongPlacement, OfThreeUnitsOnlyTheWrongOneIsReported) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        Simulator world{seed};
        world.add(made("right"));
        world.add(wrong("wrong"));
        world.add(made("also-right"));
        world.add_walkers(GetParam().walkers);
        world.run(60);
        EXPECT_EQ(misplaced(world), std::vector<std::string>{"wrong"}) << "seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(Each, WrongPlacement,
                         testing::Values(Wrong{.title = "TenDegrees", .turned = 10 * degrees},
                                         Wrong{.title = "TenDegreesTheOtherWay", .turned = -10 * degrees, .walkers = 2},
                                         Wrong{.title = "TenDegreesPoorSensors", .turned = 10 * degrees, .deviation = 0.2},
                                         Wrong{.title = "TenDegreesOnePerSecond", .turned = 10 * degrees, .period = 1},
                                         Wrong{.title = "TenDegreesOnChange", .turned = 10 * degrees, .reports_from = 0.2},
                                         Wrong{.title = "EightDecimetresBeside", .shifted = {0.8, 0}},
                                         Wrong{.title = "HalfAMetreBeside", .shifted = {0.3, 0.4}, .walkers = 8}),
                         [](auto const& each) { return each.param.title; });

TEST(Placement, TheReportSaysHowFarThePersonsLieBeside) {
    Simulator world{1};
    world.add(unit("robot1"));
    SimulatedUnit robot2 = unit("robot2");
    robot2.shifted = {0, 0.8};
    world.add(robot2);
    world.add_walkers(4);
    world.run(60);
    auto const reports = world.fusion.misplaced();
    ASSERT_THAT(reports, SizeIs(2)) << "of two units, either may be wrong";
    EXPECT_EQ(reports[1].unit, "robot2");
    EXPECT_EQ(reports[1].text, "robot2 senses persons 0.8 m away from where robot1 senses them: check where it is placed");
    EXPECT_NEAR(reports[1].displacement.distance, 0.8, 0.05);
}

TEST(Placement, TheReportSaysHowMuchThePersonsAreTurned) {
    Simulator world{1};
    world.add(unit("robot1"));
    world.add(unit("robot2"));
    SimulatedUnit robot3 = unit("robot3");
    robot3.turned = 10 * degrees;
    robot3.place = {12, 0};
    world.add(robot3);
    world.add_walkers(4);
    world.run(60);
    auto const reports = world.fusion.misplaced();
    ASSERT_THAT(reports, SizeIs(1));
    EXPECT_THAT(reports[0].text, AllOf(HasSubstr("robot3 senses persons"), HasSubstr("turned by 10 degrees")));
}

// Two units, of which the second is turned by 10 degrees, after a minute.
Simulator world_with_a_turned_unit() {
    Simulator world{2};
    world.add(unit("robot1"));
    world.add(unit("robot2"));
    world.units[1].turned = 10 * degrees;
    world.add_walkers(4);
    world.run(60);
    return world;
}

TEST(Placement, AUnitThatIsPlacedRightAgainIsNoLongerReported) {
    auto world = world_with_a_turned_unit();
    ASSERT_THAT(misplaced(world), SizeIs(2));
    world.units[1].turned = 0;
    world.run(60);
    EXPECT_THAT(misplaced(world), IsEmpty());
}

TEST(Placement, ALostUnitIsForgotten) {
    auto world = world_with_a_turned_unit();
    ASSERT_THAT(misplaced(world), SizeIs(2));
    world.units[1].works = false;
    world.fusion.lost("robot2", world.when());
    EXPECT_THAT(misplaced(world), IsEmpty());
}

TEST(Placement, TwoFriendsOfWhomEachUnitSeesOneAreNoEvidence) {
    Fusion fusion;
    for (int i = 0; i < 200; ++i) {
        fusion.sensed("robot1", after(i * 0.1), std::vector<Sighting>{{"p", {i * 0.12, 2}}});
        fusion.sensed("robot2", after(i * 0.1), std::vector<Sighting>{{"q", {i * 0.12, 2.8}}});
    }
    EXPECT_THAT(fusion.misplaced(), IsEmpty());
}

// An hour with rightly placed units.
struct Hour {
    std::string title;
    double deviation = 0.05;
    double from = 0, to = 12;  // the view of robot1 ends at `to`, that of robot2 begins at `from`
    double bias = 0;           // part of the deviation that is constant
    double reports_from = 0;
    int walkers = 6;
};
std::ostream& operator<<(std::ostream& out, Hour const& hour) { return out << hour.title; }

class RightPlacement : public testing::TestWithParam<Hour> {};

TEST_P(RightPlacement, GivesNoFalseAlarmInAnHour) {
    Hour const& hour = GetParam();
    std::mt19937 random{7};
    std::normal_distribution<double> normal;
    double const bias = hour.deviation * hour.bias;
    Simulator world{7};
    for (std::string const name : {"robot1", "robot2", "room"}) {
        SimulatedUnit made = unit(name, hour.deviation);
        made.noise *= std::sqrt(1 - hour.bias * hour.bias);
        made.bias = {bias * normal(random), bias * normal(random)};
        made.reports_from = hour.reports_from;
        made.period = 0.24;
        if (name == "robot1") made.sees = between(0, hour.to);
        if (name == "robot2") made.sees = between(hour.from, 12);
        if (name == "room") made.sees = between(3, 9);
        world.add(made);
    }
    world.add_walkers(hour.walkers);
    world.walkers[1].follows = 0;  // two friends, of whom a robot may see only one
    for (int second = 0; second < 3600; ++second) {
        world.run(1);
        ASSERT_THAT(misplaced(world), IsEmpty()) << "after " << second << " s";
    }
}

INSTANTIATE_TEST_SUITE_P(Each, RightPlacement,
                         testing::Values(Hour{.title = "OneCommonView"}, Hour{.title = "ViewsThatOverlap", .from = 5, .to = 7},
                                         Hour{.title = "ViewsThatTouch", .from = 6, .to = 6, .walkers = 8},
                                         Hour{.title = "OnChange", .from = 4, .to = 8, .reports_from = 0.2},
                                         Hour{.title = "CalibrationErrors", .deviation = 0.1, .from = 4, .to = 8, .bias = 0.7},
                                         Hour{.title = "PoorSensors", .deviation = 0.3, .from = 4, .to = 8, .walkers = 8}),
                         [](auto const& each) { return each.param.title; });

}  // namespace
}  // namespace rois::choosing::stage
