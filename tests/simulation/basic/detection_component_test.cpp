#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/component_stage.hpp"

namespace rois::simulation::stage {
namespace {

using testing::ElementsAre;

std::vector<std::string> numbers(Operated const& component, std::string_view event_type) {
    std::vector<std::string> all;
    for (auto const& event : component.events(event_type)) all.push_back(value(event.results, "number"));
    return all;
}

// Enters after three seconds, stays for a while, and leaves.
std::vector<Role> one_visitor() {
    return {visitor("guest", {does(Walk{at(6, 4)}), does(Face{at("robot")}), does(Wait{5}), does(Leave{})}, 3)};
}

TEST(Detection, ReportsTheFirstNumberEvenIfItIsZero) {
    Stage stage;
    stage["person_detection"].start();
    EXPECT_THAT(stage["person_detection"].words(), ElementsAre("completed OK, active"));
    stage.run(5);
    EXPECT_THAT(stage["person_detection"].words(), ElementsAre("completed OK, active", "person_detected"));
    EXPECT_THAT(numbers(stage["person_detection"], "person_detected"), ElementsAre("0"));
}

TEST(Detection, ReportsChangesOfTheNumber) {
    Stage stage{one_visitor()};
    stage["person_detection"].start();
    stage.run(40);
    EXPECT_THAT(numbers(stage["person_detection"], "person_detected"), ElementsAre("0", "1", "0"));
}

TEST(Detection, HasTheTimeOfTheStep) {
    Stage stage;
    stage["person_detection"].start();
    stage.step();
    auto const events = stage["person_detection"].events("person_detected");
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(value(events[0].results, "timestamp"), to_text(stage.now().utc));
}

TEST(Detection, ReportsAgainAfterANewStart) {
    Stage stage;
    auto& detection = stage["person_detection"];
    detection.start();
    stage.run(1);
    detection.start();
    stage.run(1);
    EXPECT_THAT(numbers(detection, "person_detected"), ElementsAre("0", "0"));
}

TEST(Detection, IsSilentWhenStopped) {
    Stage stage{one_visitor()};
    auto& detection = stage["person_detection"];
    detection.start();
    stage.run(1);
    detection.stop();
    stage.run(30);
    EXPECT_THAT(numbers(detection, "person_detected"), ElementsAre("0"));
}

TEST(Detection, ReportsAfterResumeAChangeDuringSuspension) {
    Stage stage{one_visitor()};
    auto& detection = stage["person_detection"];
    detection.start();
    stage.run(1);
    detection.suspend();
    stage.run(5);
    EXPECT_THAT(numbers(detection, "person_detected"), ElementsAre("0"));
    detection.resume();
    stage.step();
    EXPECT_THAT(numbers(detection, "person_detected"), ElementsAre("0", "1"));
}

TEST(Detection, ReportsNothingAfterResumeWithoutAChange) {
    Stage stage;
    auto& detection = stage["person_detection"];
    detection.start();
    stage.run(1);
    detection.suspend();
    stage.run(1);
    detection.resume();
    stage.run(1);
    EXPECT_THAT(numbers(detection, "person_detected"), ElementsAre("0"));
}

TEST(Detection, OfFacesCountsFacesTurnedToTheRobot) {
    Stage stage{{visitor("guest",
                         {does(Walk{at(5, 4)}), does(Face{at("robot")}), does(Wait{3}), does(Face{at(11, 4)}), does(Wait{30})})}};
    stage["face_detection"].start();
    stage["person_detection"].start();
    stage.run(25);
    auto const faces = numbers(stage["face_detection"], "face_detected");
    ASSERT_GE(faces.size(), 3U);
    EXPECT_EQ(faces.front(), "0");
    EXPECT_EQ(faces[1], "1");
    EXPECT_EQ(faces.back(), "0");
    EXPECT_EQ(numbers(stage["person_detection"], "person_detected").back(), "1");
}

TEST(Detection, OfSoundsCountsCurrentSpeakers) {
    Stage stage{{visitor("guest", {does(Walk{at(6, 4)}), does(Say{"en", "Good morning, is anybody here?"}), does(Wait{30})})}};
    stage["sound_detection"].start();
    stage.run(20);
    EXPECT_THAT(numbers(stage["sound_detection"], "sound_detected"), ElementsAre("0", "1", "0"));
}

TEST(Detection, OfSoundsHearsAnotherRobotButNotItself) {
    Stage stage{{}, reception_with_two_robots()};
    stage["sound_detection"].start();
    stage["robot2.sound_detection"].start();
    stage.step();
    stage["robot2.speech_synthesis"].start({text("speech_text", "Can you hear me?")});
    stage.run(5);
    EXPECT_THAT(numbers(stage["sound_detection"], "sound_detected"), ElementsAre("0", "1", "0"));
    EXPECT_THAT(numbers(stage["robot2.sound_detection"], "sound_detected"), ElementsAre("0"));
}

TEST(Component, IsUninitializedUntilTheWorldBegins) {
    Stage stage;
    for (auto const& ref : stage.refs()) EXPECT_EQ(stage[ref].status(), ComponentStatus::uninitialized) << ref;
    stage.step();
    for (auto const& ref : stage.refs()) EXPECT_EQ(stage[ref].status(), ComponentStatus::ready) << ref;
}

}  // namespace
}  // namespace rois::simulation::stage
