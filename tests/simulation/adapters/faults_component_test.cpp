// Components with faults of a scenario.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "basic/base/component_names.hpp"
#include "simulation/component_stage.hpp"

namespace rois::simulation::stage {
namespace {

using testing::ElementsAre;
using testing::UnorderedElementsAreArray;

struct Faults : testing::Test {
    static constexpr auto failure = "the component has failed: a fault of the scenario";

    static Stage unwell(std::string component, Fault::Kind kind, Seconds from = 0, std::optional<Seconds> until = {}) {
        return Stage{{}, reception(), {{std::move(component), kind, from, until}}};
    }
    static ParameterList speech() { return {text("speech_text", "Good morning, ladies and gentlemen.")}; }
};

TEST_F(Faults, OfASilentComponentKeepItFromBeginning) {
    auto stage = unwell("speech_synthesis", Fault::Kind::silent);
    stage["speech_synthesis"].start(speech());
    stage.run(20);
    EXPECT_THAT(stage["speech_synthesis"].log(), testing::IsEmpty());
    EXPECT_EQ(stage["speech_synthesis"].status(), ComponentStatus::ready);
    EXPECT_FALSE(stage.robot_state().speaking);
}

TEST_F(Faults, OfASilentComponentLeaveItsQueriesWithoutAnswer) {
    auto stage = unwell("system_information", Fault::Kind::silent, 0, 0.5);
    stage.step();
    auto& information = stage["system_information"];
    EXPECT_FALSE(information.answers("robot_position"));
    stage.run(1);
    EXPECT_FALSE(information.rows("robot_position").empty());
    EXPECT_THAT(information.log(), testing::IsEmpty()) << "the engine reports the timeout";
}

TEST_F(Faults, OfAComplainingComponentAreReportedOnceAndItWorks) {
    auto stage = unwell("speech_synthesis", Fault::Kind::complaining, 0.1, 0.5);
    stage.step();
    EXPECT_EQ(stage["speech_synthesis"].status(), ComponentStatus::ready);
    stage.run(0.3);
    EXPECT_EQ(stage["speech_synthesis"].status(), ComponentStatus::warning);
    EXPECT_THAT(stage["speech_synthesis"].words(), ElementsAre("error the component complains: a fault of the scenario"));
    stage["speech_synthesis"].start(speech());
    EXPECT_EQ(stage.outcome("speech_synthesis"), "OK");
    EXPECT_EQ(stage["speech_synthesis"].status(), ComponentStatus::ready);
}

TEST_F(Faults, OfAComplainingSystemInformationAreTheStatusOfTheEngine) {
    auto stage = unwell("system_information", Fault::Kind::complaining, 0.1, 0.5);
    auto const reported = [&] { return value(stage["system_information"].query("engine_status"), "status"); };
    stage.step();
    EXPECT_EQ(reported(), "READY");
    stage.run(0.3);
    EXPECT_EQ(reported(), "WARNING");
    stage.run(0.3);
    EXPECT_EQ(reported(), "READY");
}

TEST_F(Faults, LetAnUnstoppableComponentGoOnAndConfirmNoHalt) {
    auto stage = unwell("speech_synthesis", Fault::Kind::unstoppable, 0, 0.5);
    auto& speaker = stage["speech_synthesis"];
    speaker.start(speech());
    stage.step();
    EXPECT_EQ(speaker.stop(), Halted::not_yet);
    EXPECT_TRUE(stage.robot_state().speaking);
    stage.run(0.6);
    EXPECT_EQ(speaker.stop(), Halted::confirmed);
    EXPECT_FALSE(stage.robot_state().speaking);
}

TEST_F(Faults, LetASilentComponentContinueItsWork) {
    auto stage = unwell("speech_synthesis", Fault::Kind::silent, 0.1);
    stage["speech_synthesis"].start(speech());
    EXPECT_EQ(stage.outcome("speech_synthesis"), "OK");
}

TEST_F(Faults, OfAFailedComponentAreItsStatusAndItsExceptions) {
    auto stage = unwell("speech_synthesis", Fault::Kind::failed);
    stage.step();
    auto& component = stage["speech_synthesis"];
    EXPECT_EQ(component.status(), ComponentStatus::error);
    EXPECT_THROW(component.start(speech()), std::runtime_error);
    EXPECT_THROW(component.set_parameter({integer("volume", 50)}), std::runtime_error);
    EXPECT_THROW(component.restore_defaults(), std::runtime_error);
    EXPECT_THROW(component.suspend(), std::runtime_error);
    EXPECT_THROW(component.resume(), std::runtime_error);
    EXPECT_THROW(component.rows("robot_position"), std::runtime_error);
    EXPECT_EQ(component.stop(), Halted::confirmed);
}

TEST_F(Faults, EndTheWorkOfAComponentWhenItFails) {
    auto stage = unwell("speech_synthesis", Fault::Kind::failed, 0.1);
    stage["speech_synthesis"].start(speech());
    stage.run(1);
    EXPECT_THAT(stage["speech_synthesis"].words(), ElementsAre("started", "completed ERROR", std::string{"error "} + failure));
    EXPECT_FALSE(stage.robot_state().speaking);
}

TEST_F(Faults, AreNotTheResultOfACommandThatEndsInTheSameStep) {
    Stage healthy;
    healthy["speech_synthesis"].start(speech());
    EXPECT_EQ(healthy.outcome("speech_synthesis"), "OK");
    auto stage = unwell("speech_synthesis", Fault::Kind::failed, in_seconds(healthy.hall().now()));
    stage["speech_synthesis"].start(speech());
    stage.run(10);
    EXPECT_THAT(stage["speech_synthesis"].words(), ElementsAre("started", "completed OK", std::string{"error "} + failure));
}

TEST_F(Faults, LetAComponentThatFailsWhileItBrakesConfirmTheHalt) {
    auto stage = unwell("navigation", Fault::Kind::failed, 2);
    auto& navigation = stage["navigation"];
    navigation.start({texts("target_position", {"9000, 4000"})});
    stage.run(1.94);
    EXPECT_EQ(navigation.stop(), Halted::not_yet);
    stage.run(2);
    EXPECT_THAT(navigation.words(), ElementsAre("started", std::string{"error "} + failure, "halted"));
}

TEST_F(Faults, AreReportedOnceAndPass) {
    auto stage = unwell("speech_synthesis", Fault::Kind::failed, 0.1, 0.5);
    stage.run(1);
    EXPECT_THAT(stage["speech_synthesis"].words(), ElementsAre(std::string{"error "} + failure));
    EXPECT_EQ(stage["speech_synthesis"].status(), ComponentStatus::ready);
    stage["speech_synthesis"].start(speech());
    EXPECT_EQ(stage.outcome("speech_synthesis"), "OK");
}

TEST_F(Faults, DoNotMoveTheRobot) {
    auto stage = unwell("navigation", Fault::Kind::failed);
    stage.step();
    EXPECT_EQ(stage["navigation"].location(), stage["move"].location());
}

TEST_F(Faults, DoNotAffectOtherComponents) {
    auto stage = unwell("navigation", Fault::Kind::failed);
    stage.step();
    EXPECT_EQ(stage["move"].status(), ComponentStatus::ready);
}

TEST_F(Faults, AcceptTheRefsOfAllComponents) {
    Stage stage{{}, reception_with_two_robots()};
    EXPECT_THAT(component_refs(reception_with_two_robots()), UnorderedElementsAreArray(stage.refs()));
    auto const with_a_lamp = component_refs(reception_with_two_robots(), {"lamp"});
    EXPECT_THAT(with_a_lamp, testing::IsSupersetOf({"lamp", "robot2.lamp"}));
    EXPECT_EQ(with_a_lamp.size(), 36u);
}

TEST_F(Faults, AffectUserDefinedComponentsToo) {
    auto stage = unwell("person_age_recognition", Fault::Kind::failed);
    stage.add("person_age_recognition.xml");
    stage.step();
    EXPECT_EQ(stage["person_age_recognition"].status(), ComponentStatus::error);
}

}  // namespace
}  // namespace rois::simulation::stage
