#include "simulation/world_stage.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/plan/floor_map.hpp"

namespace rois::simulation {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::string plan_text(std::string const& places, std::string const& robots) {
    return "<floor_plan xmlns=\"urn:x-rois:simulation:hall:1\" name=\"test\">\n"
           "<bounds x=\"0\" y=\"0\" width=\"10000\" depth=\"8000\"/>\n"
           "<wall x1=\"5000\" y1=\"0\" x2=\"5000\" y2=\"6000\"/>\n" +
           places + robots + "</floor_plan>";
}
std::string const places =
    "<place name=\"entrance\" x=\"9000\" y=\"4000\" heading=\"180\"/>\n<place name=\"desk\" x=\"7000\" y=\"7000\"/>\n";
std::string const robots = "<robot name=\"robot1\" x=\"2000\" y=\"4000\"/>\n";

FloorPlan read_plan(std::string text) { return read_floor_plan(schemas(), "hall.xml", std::move(text)); }

// The error message for an invalid document.
template <class Read>
std::string complaint(Read read) {
    try {
        read();
    } catch (xml::BadDocument const& bad) {
        return bad.what();
    }
    return "nothing";
}

std::string complaint_of_scenario(std::string const& text) {
    return complaint([&] { read_scenario(schemas(), "day.xml", text, read_plan(plan_text(places, robots))); });
}

TEST(FloorPlanFile, IsReadIntoMetresAndRadians) {
    FloorPlan const plan = read_plan(plan_text(
        places,
        "<robot name=\"robot1\" x=\"2000\" y=\"4000\" heading=\"-90\" radius=\"300\" max_turn_rate=\"45\" battery=\"87.5\">"
        "<faces range=\"4000\" turned_within=\"30\" heading_sigma=\"2\"/></robot>"));
    EXPECT_EQ(plan.bounds.high, Point(10, 8));
    ASSERT_EQ(plan.walls.size(), 1u);
    EXPECT_EQ(plan.walls[0].to, Point(5, 6));
    ASSERT_TRUE(plan.place("entrance"));
    EXPECT_NEAR(plan.place("entrance")->pose.heading, from_degrees(180), 1e-12);
    RobotPlan const& robot = plan.robots.at(0);
    EXPECT_NEAR(robot.start.heading, from_degrees(-90), 1e-12);
    EXPECT_DOUBLE_EQ(robot.radius, 0.3);
    EXPECT_NEAR(robot.max_turn_rate, from_degrees(45), 1e-12);
    EXPECT_EQ(robot.battery, 87.5);
    EXPECT_DOUBLE_EQ(robot.max_speed, RobotPlan{}.max_speed) << "missing attributes have defaults";
    EXPECT_DOUBLE_EQ(robot.sensors.faces.range, 4);
    EXPECT_NEAR(robot.sensors.faces.turned_within, from_degrees(30), 1e-12);
}

// The robot's map has the origin (9000, 1000) and is turned by 90 degrees: (2000, 3000) of the hall is (2000, 7000) in the map.
TEST(FloorPlanFile, HasTheFramesOfRobots) {
    auto const robot = [](std::string const& frame) {
        return "<robot name=\"robot1\" x=\"2000\" y=\"4000\"><frame crs=\"" + frame +
               "\" x=\"9000\" y=\"1000\" heading=\"90\" sigma=\"20\" heading_sigma=\"0.5\"/></robot>\n";
    };
    FloorPlan const plan = read_plan(plan_text(places, robot("map")));
    auto const frames = named_places(plan).frames;
    EXPECT_THAT(frames.names(), testing::ElementsAre(plan.crs, "map"));
    auto target = positions("target_position", {"2000, 3000, 180"}, plan.crs);
    frames.change(target, "map", Frames::Rounding::thousandth);
    EXPECT_EQ(target, positions("target_position", {"2000, 7000, 90"}, "map"));
    Located origin{.of = "", .ref = "", .crs = "map", .position = {}, .orientation = {0, 0, 0}, .certainty = {}};
    origin.certainty = Located::Covariance{std::vector<double>(9, 0.0)};
    frames.change(origin, plan.crs);
    EXPECT_EQ(std::get<Located::Covariance>(origin.certainty).rows, (std::vector<double>{400, 0, 0, 0, 400, 0, 0, 0, 0.25}));
    EXPECT_THAT(complaint([&] { read_plan(plan_text(places, robot("URN:x-rois:def:crs:simulation::hall"))); }),
                testing::AllOf(StartsWith("hall.xml:6:1:"), HasSubstr("duplicate frame name 'URN:x-rois")));
    EXPECT_THAT(complaint([&] { read_plan(plan_text(places, robot(""))); }), StartsWith("hall.xml:6:"));
}

TEST(FloorPlanFile, HasAreasForConditions) {
    FloorPlan const plan =
        read_plan(plan_text("<place name=\"entrance\" x=\"9000\" y=\"4000\"/>\n"
                            "<place name=\"desk\" x=\"7000\" y=\"7000\" width=\"4000\" depth=\"1000\"/>\n",
                            robots));
    auto const known = named_places(plan);
    EXPECT_EQ(known.frames.own(), plan.crs);
    auto const area_of = [&](std::string const& name) {
        auto const* place = known.find(name);
        return place == nullptr ? Geometry{} : place->area;
    };
    EXPECT_EQ(area_of("desk"), (Geometry{.crs = plan.crs, .low = {5'000, 6'500, 0}, .high = {9'000, 7'500, 0}, .dimensions = 2}));
    EXPECT_EQ(area_of("entrance"),
              (Geometry{.crs = plan.crs, .low = {8'000, 3'000, 0}, .high = {10'000, 5'000, 0}, .dimensions = 2}))
        << "the default is 2 m by 2 m";
    EXPECT_EQ(area_of(plan.name).low, (std::array<double, 3>{0, 0, 0})) << "the hall is also a place";
    EXPECT_EQ(known.find("attic"), nullptr);
}

TEST(FloorPlanFile, HasFixedRobots) {
    auto const plan = read_plan(plan_text(places, robots + "<robot name=\"room\" fixed=\"true\" x=\"5000\" y=\"4000\"/>"));
    EXPECT_FALSE(plan.prefix_first);
    EXPECT_FALSE(plan.robots.front().fixed);
    EXPECT_TRUE(plan.robots.back().fixed) << "it may hang on a wall";
    EXPECT_THAT(
        complaint([] { read_plan(plan_text(places, robots + "<robot name=\"room\" fixed=\"true\" x=\"-1\" y=\"4000\"/>")); }),
        HasSubstr("'room' is outside of the hall"));
    EXPECT_THAT(complaint([] { read_plan(plan_text(places, "<robot name=\"room\" fixed=\"1\" x=\"5000\" y=\"4000\"/>")); }),
                HasSubstr("the floor plan has no robot: expected at least one that is not fixed"));
}

TEST(FloorPlanFile, ReportsThePlaceOfAnError) {
    EXPECT_THAT(complaint([] { read_plan("<floor_plan"); }), StartsWith("hall.xml:1:"));
    EXPECT_THAT(complaint([] { read_plan(plan_text(places, "<robot name=\"robot1\" x=\"two\" y=\"4000\"/>")); }),
                StartsWith("hall.xml:6:"));
    EXPECT_THAT(complaint([] { read_plan(plan_text(places + "<place name=\"desk\" x=\"6000\" y=\"7000\"/>", robots)); }),
                AllOf(StartsWith("hall.xml:6:1:"), HasSubstr("duplicate place name 'desk'")));
    EXPECT_THAT(complaint([] { read_plan(plan_text(places, "<robot name=\"robot1\" x=\"5100\" y=\"4000\"/>\n")); }),
                AllOf(StartsWith("hall.xml:6:1:"), HasSubstr("too near to a wall")));
    EXPECT_THAT(complaint([] { read_plan(plan_text("<place name=\"desk\" x=\"7000\" y=\"7000\"/>", robots)); }),
                AllOf(StartsWith("hall.xml:1:1:"), HasSubstr("the place 'entrance' is missing")));
}

TEST(ScenarioFile, IsReadWithAllItsActions) {
    FloorPlan const plan = read_plan(plan_text(places, robots));
    Scenario const scenario = read_scenario(schemas(), "day.xml", R"(
<scenario xmlns="urn:x-rois:simulation:hall:1" name="a day" round="120">
  <arrivals gap_least="10" gap_most="20" at_most="3"/>
  <person id="tanaka" known="true" language="ja" height="1720" speed="1200" enters="2.5">
    <answer to="name" language="en" gesture="nod">Tanaka.</answer>
    <answer reaction="9" gesture="bow" once="true"/>
    <walk to="desk"/><face to="robot1"/><say at="8">はじめまして。</say><gesture id="wave"/>
    <wait seconds="3"/><ignore/><wander seconds="4"/><walk to="6500, 2000"/><leave/>
  </person>
</scenario>)",
                                            plan);
    EXPECT_EQ(scenario.round, 120.0);
    ASSERT_TRUE(scenario.arrivals);
    EXPECT_EQ(scenario.arrivals->at_most, 3u);
    Role const& role = scenario.roles.at(0);
    EXPECT_TRUE(role.known);
    EXPECT_DOUBLE_EQ(role.height, 1.72);
    EXPECT_DOUBLE_EQ(role.speed, 1.2);
    EXPECT_DOUBLE_EQ(role.enters, 2.5);
    ASSERT_EQ(role.answers.size(), 2u);
    EXPECT_EQ(role.answers[0].text, "Tanaka.");
    EXPECT_TRUE(role.answers[1].once);
    ASSERT_EQ(role.actions.size(), 9u);
    EXPECT_EQ(std::get<std::string>(std::get<Walk>(role.actions[0].what).to.at), "desk");
    EXPECT_EQ(std::get<Say>(role.actions[2].what).language, "ja") << "the person's language";
    EXPECT_EQ(role.actions[2].at, 8.0);
    EXPECT_EQ(std::get<Point>(std::get<Walk>(role.actions[7].what).to.at), Point(6.5, 2));
    EXPECT_TRUE(std::holds_alternative<Leave>(role.actions[8].what));
}

TEST(ScenarioFile, ReadsGenderAndAge) {
    auto const scenario = [](std::string const& people) {
        return read_scenario(schemas(), "day.xml",
                             "<scenario xmlns=\"urn:x-rois:simulation:hall:1\" name=\"s\">\n" + people + "</scenario>",
                             read_plan(plan_text(places, robots)));
    };
    auto const roles = scenario(
                           "<person id=\"a\" gender=\"female\" age=\"34\"/><person id=\"b\" gender=\"male\"/>"
                           "<person id=\"c\" gender=\"not_applicable\"/><person id=\"d\"/>")
                           .roles;
    EXPECT_EQ(roles.at(0).gender, Gender::female);
    EXPECT_EQ(roles.at(0).age, 34);
    EXPECT_EQ(roles.at(1).gender, Gender::male);
    EXPECT_EQ(roles.at(1).age, std::nullopt);
    EXPECT_EQ(roles.at(2).gender, Gender::not_applicable);
    EXPECT_EQ(roles.at(3).gender, Gender::not_known);
    for (auto const* person :
         {"<person id=\"a\" gender=\"other\"/>", "<person id=\"a\" age=\"-1\"/>", "<person id=\"a\" age=\"131\"/>"})
        EXPECT_THAT(complaint([&] { scenario(person); }), StartsWith("day.xml:2:1: ")) << person;
}

TEST(ScenarioFile, ReportsThePlaceOfAnError) {
    auto day = [](std::string const& inside) {
        return "<scenario xmlns=\"urn:x-rois:simulation:hall:1\" name=\"day\" round=\"60\">\n<person id=\"a\">\n" + inside +
               "\n</person>\n</scenario>";
    };
    EXPECT_THAT(complaint_of_scenario(day("  <walk to=\"garden\"/>")), AllOf(StartsWith("day.xml:3:3:"), HasSubstr("garden")));
    EXPECT_THAT(complaint_of_scenario(day("<walk to=\"5000, 3000\"/>")), AllOf(StartsWith("day.xml:3:1:"), HasSubstr("stand")));
    EXPECT_THAT(complaint_of_scenario(day("<gesture id=\"yawn\"/>")), AllOf(StartsWith("day.xml:3:1:"), HasSubstr("wave")));
    EXPECT_THAT(complaint_of_scenario(day("<say language=\"English\">Hi</say>")),
                AllOf(StartsWith("day.xml:3:1:"), HasSubstr("639-1")));
    EXPECT_THAT(complaint_of_scenario(day("<answer>Hi</answer>")),
                AllOf(StartsWith("day.xml:3:1:"), HasSubstr("either 'to' or 'reaction'")));
    for (auto const* code : {"51", "0", "wave", "09"})
        EXPECT_THAT(complaint_of_scenario(day("<answer reaction=\"" + std::string{code} + "\">Hi</answer>")),
                    AllOf(StartsWith("day.xml:3:1:"), HasSubstr("'" + std::string{code} + "'"), HasSubstr("1 to 50")));
    EXPECT_THAT(complaint_of_scenario(day("</person>\n<person id=\"b\" message=\"nobody reads it\">")), StartsWith("day.xml:4:"));
    EXPECT_THAT(complaint_of_scenario(day("<dance/>")), StartsWith("day.xml:3:"));
    EXPECT_THAT(complaint_of_scenario(day("<wait seconds=\"-1\"/>")), StartsWith("day.xml:3:"));
    EXPECT_THAT(complaint_of_scenario(day("</person>\n<person id=\"a\">")),
                AllOf(StartsWith("day.xml:4:1:"), HasSubstr("duplicate person id")));
    EXPECT_THAT(complaint_of_scenario(day("</person>\n<person id=\"b\" enters=\"70\">")),
                AllOf(StartsWith("day.xml:4:1:"), HasSubstr("round")));
    EXPECT_THAT(complaint_of_scenario(plan_text(places, robots)), HasSubstr("not a scenario"));
}

TEST(ScenarioFile, RefusesFaultsOfUnknownComponents) {
    auto unwell = [](std::string const& fault) {
        return "<scenario xmlns=\"urn:x-rois:simulation:hall:1\" name=\"day\">\n" + fault + "\n</scenario>";
    };
    auto const scenario =
        read_scenario(schemas(), "day.xml", unwell("<fault component=\"move\" kind=\"failed\" from=\"2\" until=\"3.5\"/>"),
                      read_plan(plan_text(places, robots)));
    ASSERT_EQ(scenario.faults.size(), 1u);
    EXPECT_EQ(scenario.faults[0].component, "move");
    EXPECT_EQ(scenario.faults[0].kind, Fault::Kind::failed);
    EXPECT_EQ(scenario.faults[0].from, 2);
    EXPECT_EQ(scenario.faults[0].until, 3.5);
    EXPECT_THAT(complaint_of_scenario(unwell("<fault component=\"dishwasher\" kind=\"silent\"/>")),
                AllOf(StartsWith("day.xml:2:1:"), HasSubstr("dishwasher")));
    EXPECT_THAT(complaint_of_scenario(unwell("<fault component=\"move\" kind=\"silent\" from=\"5\" until=\"5\"/>")),
                AllOf(StartsWith("day.xml:2:1:"), HasSubstr("until")));
    EXPECT_THAT(complaint_of_scenario(unwell("<fault component=\"move\" kind=\"tired\"/>")), StartsWith("day.xml:2:"));
    auto const of_a_user = read_scenario(schemas(), "day.xml", unwell("<fault component=\"dishwasher\" kind=\"silent\"/>"),
                                         read_plan(plan_text(places, robots)), {"dishwasher"});
    EXPECT_EQ(of_a_user.faults.at(0).component, "dishwasher");
}

TEST(ShippedFiles, AreValid) {
    for (auto name : {"reception-hall.xml", "two-robots.xml"}) {
        FloorPlan const plan = shipped_plan(name);
        EXPECT_FALSE(flaw(plan)) << name;
        EXPECT_GE(reception_day(plan).roles.size(), 3u);
        EXPECT_EQ(plan.crs, "urn:x-rois:def:crs:simulation::hall");
    }
    EXPECT_EQ(shipped_plan("two-robots.xml").robots.size(), 2u);
}

TEST(ShippedFiles, EveryPlaceCanBeReached) {
    FloorPlan const plan = shipped_plan("reception-hall.xml");
    RobotPlan const& robot = plan.robots.at(0);
    Planner const planner{plan, robot.radius, {}};
    for (Place const& place : plan.places)
        EXPECT_TRUE(planner.way(robot.start, place.pose.position, RoutingPolicy::time)) << place.name;
}

}  // namespace
}  // namespace rois::simulation
