#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulation/component_stage.hpp"

namespace rois::simulation::stage {
namespace {

using testing::AllOf;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::Ge;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Le;
using testing::SizeIs;

constexpr auto crs = "urn:x-rois:def:crs:simulation::hall";

// Stands at (6, 4) from about the fifth second on.
Role standing() { return visitor("guest", {does(Walk{at(6, 4)}), does(Face{at("robot")}), does(Wait{1000})}); }

Stage& settled(Stage& stage) {
    stage.run(10);
    return stage;
}

TEST(Localization, ReportsThePositionOfAPersonInMillimetres) {
    Stage stage{{standing()}};
    settled(stage)["person_localization"].start();
    stage.step();
    auto const events = stage["person_localization"].events("person_localized");
    ASSERT_THAT(events, SizeIs(1));
    auto const& results = events[0].results;
    EXPECT_EQ(value(results, "timestamp"), to_text(stage.now().utc));
    EXPECT_THAT(values(results, "person_ref"), ElementsAre("person-1"));
    EXPECT_EQ(codebook_of(results, "person_ref"), "urn:x-rois:def:codebook:simulation::track");
    EXPECT_EQ(codebook_of(results, "position_data"), crs);
    auto const point = target_from_wire(value(results, "position_data"));
    ASSERT_TRUE(point);
    EXPECT_NEAR(point->position.x(), 6, 0.3);
    EXPECT_NEAR(point->position.y(), 4, 0.3);
}

TEST(Localization, ReportsWhoIsLeftWhenSomebodyIsGone) {
    Stage stage{
        {visitor("guest", {does(Walk{at(6, 4)}), does(Leave{})}), visitor("other", {does(Walk{at(5, 3)}), does(Wait{1000})}, 3)}};
    stage["person_localization"].start();
    auto const last = [&] {
        auto const events = stage["person_localization"].events("person_localized");
        return events.empty() ? std::vector<std::string>{"nothing"} : values(events.back().results, "person_ref");
    };
    EXPECT_TRUE(stage.run_until([&] { return last().size() == 2; }));
    EXPECT_TRUE(stage.run_until([&] { return last() == std::vector<std::string>{"person-2"}; }));

    Stage alone{{visitor("guest", {does(Walk{at(6, 4)}), does(Leave{})})}};
    alone["person_localization"].start();
    alone.run(60);
    EXPECT_THAT(values(alone["person_localization"].events("person_localized").back().results, "person_ref"), IsEmpty());
}

TEST(Localization, ReportsTheCovarianceOfEachPosition) {
    Stage stage{{standing()}};
    settled(stage)["person_localization"].start();
    stage.step();
    auto const events = stage["person_localization"].events("person_localized");
    ASSERT_THAT(events, SizeIs(1));
    ASSERT_THAT(events[0].results.located, SizeIs(1));
    auto const& entity = events[0].results.located[0];
    EXPECT_EQ(entity.of, "position_data");
    EXPECT_EQ(entity.ref, "person-1");
    EXPECT_EQ(entity.crs, crs);
    EXPECT_NEAR(entity.position[0], 6000, 300);
    EXPECT_EQ(entity.position[2], 0);
    ASSERT_THAT(entity.orientation, SizeIs(3));
    EXPECT_THAT(std::abs(entity.orientation[2]), AllOf(Ge(130), Le(180)));  // it looks at the robot
    auto const& covariance = std::get<Located::Covariance>(entity.certainty).rows;
    ASSERT_THAT(covariance, SizeIs(9));
    EXPECT_THAT(covariance[0], DoubleNear(50.0 * 50.0, 0.01));  // the sensor's sigma, in mm
    EXPECT_THAT(covariance[4], DoubleNear(50.0 * 50.0, 0.01));
    EXPECT_THAT(covariance[8], DoubleNear(8.0 * 8.0, 0.01));  // in degrees
}

TEST(Localization, ReportsNothingInAnEmptyHall) {
    Stage stage;
    stage["person_localization"].start();
    stage.run(5);
    EXPECT_THAT(stage["person_localization"].words(), ElementsAre("completed OK, active"));
}

TEST(Localization, ReportsAStandingPersonOnce) {
    Stage stage{{standing()}};
    settled(stage)["person_localization"].start();
    stage.run(60);
    EXPECT_THAT(stage["person_localization"].events("person_localized"), SizeIs(1));
}

TEST(Localization, ReportsAWalkingPersonAFewTimesASecond) {
    Stage stage{{visitor("guest", {does(Walk{at(4, 4)}), does(Wait{1000})})}};
    stage["person_localization"].start();
    stage.run(5);
    auto const events = stage["person_localization"].events("person_localized");
    EXPECT_THAT(events.size(), AllOf(Ge(10U), Le(21U)));
}

// The shortest time between two events about a person who approaches and talks at length.
WorldTime shortest_gap(std::string const& kind, std::int64_t minimum_interval) {
    std::string words;
    for (int i = 0; i < 20; ++i) words += "Good morning. ";
    Stage stage{{visitor("guest", {does(Walk{at(6, 4)}), does(Face{at("robot")}), does(Say{"en", words}), does(Wait{1000})})}};
    auto& localization = stage[kind + "_localization"];
    localization.start({integer("minimum_interval", minimum_interval)});
    stage.run(20);
    auto const events = localization.events(kind + "_localized");
    EXPECT_GE(events.size(), 2U) << kind;
    WorldTime shortest{60'000};
    for (std::size_t i = 1; i < events.size(); ++i) shortest = std::min(shortest, events[i].at - events[i - 1].at);
    return shortest;
}

TEST(Localization, OfEachKindObeysMinimumInterval) {
    for (auto const& [kind, interval] : {std::pair{"person", 1000}, {"face", 1000}, {"sound", 3000}}) {
        EXPECT_LT(shortest_gap(kind, 0), WorldTime{interval}) << kind;
        EXPECT_GE(shortest_gap(kind, interval), WorldTime{interval}) << kind;
    }
}

TEST(Localization, ObeysDetectionThreshold) {
    Stage stage{{visitor("guest", {does(Walk{at(4, 4)}), does(Wait{1000})})}};
    stage["person_localization"].start({integer("minimum_interval", 0), integer("detection_threshold", 2000)});
    stage.run(15);
    auto const events = stage["person_localization"].events("person_localized");
    EXPECT_THAT(events.size(), AllOf(Ge(3U), Le(4U)));  // on a way of 7 m: the first, and one each 2 m
}

TEST(Localization, AppliesNewParametersAtOnce) {
    Stage stage{{visitor("guest", {does(Walk{at(3, 4)}), does(Walk{at(10, 4)}), does(Walk{at(3, 4)}), does(Wait{1000})})}};
    auto& localization = stage["person_localization"];
    localization.start({integer("detection_threshold", 5000)});
    stage.run(3);
    std::size_t const before = localization.events("person_localized").size();
    localization.set_parameter({integer("detection_threshold", 200)});
    stage.run(3);
    EXPECT_EQ(before, 1U);
    EXPECT_GE(localization.events("person_localized").size(), 8U);
}

TEST(Localization, ReportsMovementDuringSuspensionAfterResume) {
    Stage stage{{visitor("guest", {does(Walk{at(4, 4)}), does(Wait{1000})})}};
    auto& localization = stage["person_localization"];
    localization.start();
    stage.run(1);
    localization.suspend();
    localization.forget();
    stage.run(3);
    EXPECT_THAT(localization.log(), IsEmpty());
    localization.resume();
    stage.run(0.2);
    EXPECT_THAT(localization.events("person_localized"), SizeIs(1));
}

TEST(Localization, RefusesNegativeLimits) {
    Stage stage;
    auto& localization = stage["face_localization"];
    EXPECT_TRUE(localization.refusal("set_parameter", {integer("detection_threshold", -1)}));
    EXPECT_TRUE(localization.refusal("start", {integer("minimum_interval", -1)}));
    EXPECT_FALSE(localization.refusal("start", {integer("minimum_interval", 0)}));
}

TEST(Localization, RefusesAThresholdBelowTheNoiseOfItsSensor) {
    Stage stage;
    for (auto const& [kind, lowest] : {std::pair{"person", 125}, {"face", 75}, {"sound", 625}}) {
        auto& localization = stage[std::string{kind} + "_localization"];
        for (auto const* command : {"set_parameter", "start"}) {
            EXPECT_THAT(localization.refusal(command, {integer("detection_threshold", lowest - 1)}).value_or("fine"),
                        HasSubstr("the minimum of " + std::to_string(lowest) + " mm"))
                << kind;
            EXPECT_TRUE(localization.refusal(command, {integer("detection_threshold", 0)})) << kind;
            EXPECT_FALSE(localization.refusal(command, {integer("detection_threshold", lowest)})) << kind;
        }
    }
}

TEST(Localization, ItsLowestThresholdDependsOnTheRobotsSensor) {
    FloorPlan plan = reception_with_two_robots();
    plan.robots[1].sensors.people.sigma = 0.2;
    Stage stage{{}, plan};
    EXPECT_FALSE(stage["person_localization"].refusal("start", {integer("detection_threshold", 125)}));
    EXPECT_TRUE(stage["robot2.person_localization"].refusal("start", {integer("detection_threshold", 499)}));
    EXPECT_FALSE(stage["robot2.person_localization"].refusal("start", {integer("detection_threshold", 500)}));
}

// Number of events about a person while they approach, and in one minute while they stand, talk and wave.
std::pair<std::size_t, std::size_t> events_by_default(std::string const& kind, ParameterList const& parameters = {}) {
    std::string words;
    for (int i = 0; i < 100; ++i) words += "Good morning. ";
    Stage stage{{visitor("guest", {does(Walk{at(4, 4)}), does(Face{at("robot")}), does(Say{"en", words}), does(Wait{1000})})}};
    auto& localization = stage[kind + "_localization"];
    localization.start(parameters);
    stage.run(15);
    auto const coming = localization.events(kind + "_localized").size();
    stage.run(60);
    return {coming, localization.events(kind + "_localized").size() - coming};
}

TEST(Localization, ReportsEnoughAndNotTooMuchWithItsDefaults) {
    for (auto const* kind : {"person", "face", "sound"}) {
        auto const [coming, standing] = events_by_default(kind);
        EXPECT_GE(coming, 1U) << kind;
        EXPECT_LE(coming, 60U) << kind << ": at most each 250 ms";
        EXPECT_LE(standing, 2U) << kind << ": a standing person does not move";
    }
    EXPECT_GE(events_by_default("person").first, 10U) << "7 m of way";
}

TEST(Localization, ReportsNoNoiseAtItsLowestThreshold) {
    for (auto const& [kind, lowest] : {std::pair{"person", 125}, {"face", 75}, {"sound", 625}})
        EXPECT_LE(events_by_default(kind, {integer("detection_threshold", lowest), integer("minimum_interval", 0)}).second, 3U)
            << kind;
}

TEST(Localization, OfAFaceHasItsHeight) {
    Role role = visitor("guest", {does(Walk{at(5, 4)}), does(Face{at("robot")}), does(Wait{1000})});
    role.height = 1.8;
    Stage stage{{role}};
    settled(stage)["face_localization"].start();
    stage.step();
    auto const events = stage["face_localization"].events("face_localized");
    ASSERT_THAT(events, SizeIs(1));
    EXPECT_THAT(values(events[0].results, "face_ref"), ElementsAre("face-1"));
    ASSERT_THAT(events[0].results.located, SizeIs(1));
    EXPECT_NEAR(events[0].results.located[0].position[2], 1680, 150);
    EXPECT_THAT(std::get<Located::Covariance>(events[0].results.located[0].certainty).rows[0], DoubleNear(30.0 * 30.0, 0.01));
}

TEST(Localization, OfASoundHasNoOrientation) {
    Stage stage{
        {visitor("guest", {does(Walk{at(6, 4)}), does(Say{"en", "Good morning, is anybody here at all?"}), does(Wait{1000})})}};
    auto& localization = stage["sound_localization"];
    localization.start();
    ASSERT_TRUE(stage.run_until([&] { return !localization.events("sound_localized").empty(); }));
    auto const results = localization.events("sound_localized")[0].results;
    EXPECT_THAT(values(results, "sound_ref"), ElementsAre("sound-1"));
    ASSERT_THAT(results.located, SizeIs(1));
    EXPECT_THAT(results.located[0].orientation, IsEmpty());
    EXPECT_NEAR(results.located[0].position[0], 6000, 1500);
    auto const& covariance = std::get<Located::Covariance>(results.located[0].certainty).rows;
    ASSERT_THAT(covariance, SizeIs(4));
    EXPECT_GT(covariance[0], 0);
    EXPECT_GT(covariance[3], 0);
}

}  // namespace
}  // namespace rois::simulation::stage
