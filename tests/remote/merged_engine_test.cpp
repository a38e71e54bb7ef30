// One engine of a sub engine, whose components belong to the main engine itself (`engine` in the engines file).
#include "engine/conditions/conditions.hpp"
#include "remote/two_engines.hpp"

namespace rois {

namespace {

using testing::Contains;

Part driver() {
    auto part = navigation;
    part.crs = "crs1";
    part.positions = {"target_position"};
    return part;
}

remote::SubEngine only_robot1() {
    auto settings = TwoEngines::hall_settings();
    settings.engine = "robot1";
    return settings;
}

struct AMergedEngine : testing::Test {
    std::unique_ptr<TwoEngines> engines;
    std::optional<Application> desk;

    // The hall has `speech` of its own, and the robots `robot1` and `robot2`. The component `detection` of robot1 has a plain
    // name.
    void begin(remote::SubEngine const& settings = only_robot1(), Places const& of_hall = {}) {
        auto plain = detection;
        plain.engine = "robot1";
        engines = std::make_unique<TwoEngines>(
            std::vector{speech, in_engine("robot1", driver()), plain, in_engine("robot2", driver())}, settings, of_hall);
        desk = engines->main.connect();
    }
    ScriptedComponent& robot() { return engines->hall["robot1.navigation"]; }
    std::vector<std::string> target(std::string const& text, std::string const& crs = "") {
        engines->bind(*desk, "navigation");
        engines->execute(*desk, start("navigation", {positions("target_position", {text}, crs)}));
        return find(robot().started_with, "target_position")->values;
    }
};

}  // namespace

TEST_F(AMergedEngine, GivesTheMainEngineItsComponents) {
    begin();
    EXPECT_THAT(desk->search(), ElementsAre("detection", "navigation"));
    EXPECT_THAT(desk->search(equal("engine", "main")), ElementsAre("detection", "navigation"));
    auto const profile = desk->ask(GetProfile{}).profile;
    EXPECT_THAT(profile->components, testing::UnorderedElementsAre("detection", "navigation"));
    EXPECT_THAT(profile->sub_profiles, IsEmpty());
    EXPECT_EQ(engines->shown.name, "hall");
    EXPECT_EQ(engines->shown.components, 2u);
}

TEST_F(AMergedEngine, MayGiveOnlySomeOfItsComponents) {
    auto settings = only_robot1();
    settings.components = {"robot1.navigation", "robot2.navigation"};
    begin(settings);
    EXPECT_THAT(desk->search(), ElementsAre("navigation"));
    EXPECT_THAT(engines->reported,
                Contains("it lacks robot2.navigation, which the engines file names in \"components\"").Times(1));
}

TEST_F(AMergedEngine, MayBeTheSubEngineItself) {
    auto settings = only_robot1();
    settings.engine = "main";  // the name of the hall's engine, too
    begin(settings);
    EXPECT_THAT(desk->search(), ElementsAre("speech"));
}

TEST_F(AMergedEngine, IsReportedIfItIsMissing) {
    auto settings = only_robot1();
    settings.engine = "robot3";
    begin(settings);
    EXPECT_THAT(desk->search(), IsEmpty());
    EXPECT_THAT(engines->reported, Contains("it lacks robot3, which the engines file names in \"engine\"").Times(1));
    engines->hall.change({}, {in_engine("robot3", localization)});
    engines->advance(1s);
    EXPECT_THAT(desk->search(), ElementsAre("localization"));
}

TEST_F(AMergedEngine, IsLeftIfOneOfItsRefsIsTaken) {
    auto settings = only_robot1();
    settings.engine = "robot3";
    begin(settings);
    engines->main.change({}, {localization});
    engines->hall.change({}, {in_engine("robot3", localization)});
    engines->advance(1s);
    EXPECT_THAT(engines->reported, Contains("there are two components with the ref 'localization'"));
    EXPECT_THAT(desk->search(), ElementsAre("localization"));
}

TEST_F(AMergedEngine, PerformsCommands) {
    begin();
    EXPECT_EQ(engines->bind(*desk, "navigation"), ReturnCode::ok);
    auto guard = engines->hall.connect();
    EXPECT_EQ(guard.bind("robot1.navigation"), ReturnCode::out_of_resources);
    EXPECT_EQ(guard.bind("robot2.navigation"), ReturnCode::ok);
    engines->execute(*desk, go("go", "navigation"));
    robot().finishes();
    engines->settle();
    EXPECT_THAT(desk->received(), Contains(HasSubstr("completed go OK")));
    desk->subscribe("reached_target", {}, true);
    for (auto const* each : {"robot1.navigation", "robot2.navigation"})
        engines->hall[each].fires("reached_target", {value("target", "string", {each})});
    engines->settle();
    EXPECT_THAT(desk->received(), ElementsAre(HasSubstr("reached_target navigation")));
}

TEST_F(AMergedEngine, HasNoErrorsOfOtherEngines) {
    begin();
    engines->bind(*desk, "navigation");
    engines->hall["robot2.navigation"].reports(ErrorType::user_defined_error, "the bumper was touched");
    robot().reports(ErrorType::user_defined_error, "a wheel is stuck");
    engines->settle();
    EXPECT_THAT(desk->received(), ElementsAre(HasSubstr("USER_DEFINED_ERROR navigation")));
    EXPECT_THAT(engines->reported, testing::Not(Contains("the bumper was touched")));
}

// The main engine is the robot.
TEST_F(AMergedEngine, HasTheMainEnginesNameInResults) {
    begin();
    robot().where = Located{};
    robot().where->of = "robot";
    robot().where->ref = "robot1";
    robot().where->crs = "crs1";
    engines->hall.connect();  // the engine looks
    engines->advance(500ms);
    EXPECT_THAT(desk->search(equal("RobotId", "main")), Contains("navigation"));
    remote::Translation const translation{"hall", "hall", "crs1", true, {}, {.there = "robot1", .here = "main"}};
    Results results{.parameters = {value("robot_ref", "RoISIdentifier[]", {"robot1", "robot2"})}, .located = {}};
    translation.to_here(results);
    EXPECT_THAT(results.parameters.at(0).values, ElementsAre("main", "hall.robot2"));
}

TEST_F(AMergedEngine, HasItsPositionsAndPlacesInOurFrame) {
    auto settings = only_robot1();
    settings.placement = {.position = {1'000, 0, 0}, .orientation = {0, 0, 90}, .covariance = {}};
    begin(settings, {.frames = {"crs1"}, .all = {{"lab", box(0, 0, 1'000, 1'000, "crs1")}}});
    EXPECT_THAT(target("1000, 100, 90", "here"), ElementsAre("100, 0, 0"));
    EXPECT_THAT(target("hall.lab"), ElementsAre("lab")) << "places have the name of the entry";
    EXPECT_THAT(target("lab"), ElementsAre("lab"));
}

TEST_F(AMergedEngine, LeavesAndReturnsWithItsSubEngine) {
    begin();
    engines->bind(*desk, "navigation");
    engines->execute(*desk, go("go", "navigation"));
    engines->cut();
    engines->advance(3100ms);
    EXPECT_THAT(desk->received(),
                testing::IsSupersetOf({HasSubstr("completed go ABORT"), HasSubstr("COMPONENT_NOT_RESPONDING navigation")}));
    EXPECT_EQ(desk->status_of("navigation"), "ERROR");
    EXPECT_THAT(robot().calls, Contains("halt"));
    engines->advance(30s);
    EXPECT_THAT(desk->search(), IsEmpty());
    engines->repair();
    engines->advance(31s);
    EXPECT_THAT(desk->search(), ElementsAre("detection", "navigation"));
}

TEST_F(AMergedEngine, IsStoppedWithItsWholeSubEngine) {
    begin();
    auto guard = engines->hall.connect();
    guard.bind("robot1.navigation");
    guard.execute(go("go", "robot1.navigation"));
    engines->main.engine->stop_everything(engines->main.now);
    EXPECT_THAT(engines->main.engine->not_halted(), Contains("navigation"));
    engines->advance(200ms);
    EXPECT_THAT(guard.received(), Contains(HasSubstr("completed go ABORT")));
    EXPECT_THAT(engines->main.engine->not_halted(), IsEmpty());
    EXPECT_TRUE(engines->hall.engine->everything_is_stopped());
}

TEST_F(AMergedEngine, IsRefusedInALoop) {
    begin();
    engines->instance_of_main = "instance1";  // that of the hall
    engines->hall.change({}, {localization});
    engines->advance(2s);
    EXPECT_THAT(desk->search(), IsEmpty());
    EXPECT_THAT(engines->reported, Contains(HasSubstr("loop")));
}

}  // namespace rois
