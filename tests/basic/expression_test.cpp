// Speech synthesis, reactions, streams and system information on a body of fakes.
#include <gmock/gmock.h>

#include "basic/fake_body.hpp"

namespace rois::basic::stage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

class SynthesisOfABody : public FakeRobot {};

TEST_F(SynthesisOfABody, SpeaksPlainText) {
    auto& speech = (*this)["speech_synthesis"];
    speech.start(
        {text("speech_text", "Good morning."), text("language", "de"), integer("volume", 80), text("character", "male")});
    auto const& said = body->voice.said.at(0);
    EXPECT_DOUBLE_EQ(said.loudness, 0.8);
    Passage const expected{
        .text = "Good morning.", .language = "de", .duration = speech_duration("Good morning.") / 0.9, .character = "male"};
    EXPECT_THAT(said.passages, ElementsAre(expected));
    step();
    EXPECT_FALSE(speech.ended());
    body->voice.now = SpeechState::spoken;
    step();
    EXPECT_EQ(speech.ended(), "OK");
}

TEST_F(SynthesisOfABody, SpeaksSsmlInPassages) {
    auto& speech = (*this)["speech_synthesis"];
    speech.start({text("SSML_text", "<speak>One <s xml:lang='fr'>deux</s></speak>")});
    auto const& passages = body->voice.said.at(0).passages;
    ASSERT_THAT(passages, SizeIs(2));
    EXPECT_EQ(passages[0].language, "en");
    EXPECT_EQ(passages[1].language, "fr");
}

TEST_F(SynthesisOfABody, SuspendsResumesAndStops) {
    auto& speech = (*this)["speech_synthesis"];
    speech.start({text("speech_text", "Good morning.")});
    speech.suspend();
    EXPECT_EQ(body->voice.now, SpeechState::held);
    speech.resume();
    EXPECT_EQ(body->voice.now, SpeechState::speaking);
    EXPECT_EQ(speech.stop(), Halted::confirmed);
    EXPECT_EQ(body->voice.now, SpeechState::broken);
    step();
    EXPECT_FALSE(speech.ended()) << "the engine reports a stopped command";
}

TEST_F(SynthesisOfABody, EndsWithAnErrorIfTheBodyBreaksOff) {
    auto& speech = (*this)["speech_synthesis"];
    speech.start({text("speech_text", "Good morning.")});
    body->voice.now = SpeechState::broken;
    step();
    EXPECT_EQ(speech.ended(), "ERROR");
}

TEST_F(SynthesisOfABody, RefusesBadParameters) {
    EXPECT_THAT(refusal("speech_synthesis", "start", {}), HasSubstr("mandatory"));
    EXPECT_THAT(refusal("speech_synthesis", "set_parameter", {integer("volume", 101)}), HasSubstr("0 to 100"));
    EXPECT_THAT(refusal("speech_synthesis", "set_parameter", {text("language", "jp")}), HasSubstr("'jp'"));
    EXPECT_THAT(refusal("speech_synthesis", "set_parameter", {text("character", "pirate")}), HasSubstr("'pirate'"));
    EXPECT_THAT(refusal("speech_synthesis", "set_parameter", {text("SSML_text", "<speak>")}), HasSubstr("line 1"));
}

class ReactionOfABody : public FakeRobot {};

TEST_F(ReactionOfABody, IsShownForItsDuration) {
    auto& reaction = (*this)["reaction"];
    reaction.start({reference("reaction_ref", "bow")});
    ASSERT_TRUE(body->shown);
    EXPECT_EQ(body->shown->first, "9");
    auto const duration = body->shown->second;
    step(WorldTime{400});
    reaction.suspend();
    EXPECT_FALSE(body->shown);
    reaction.resume();
    EXPECT_DOUBLE_EQ(body->shown.value().second, duration - 0.4);
    step(world_time(duration - 0.4));
    EXPECT_EQ(reaction.ended(), "OK");
}

TEST_F(ReactionOfABody, IsStopped) {
    auto& reaction = (*this)["reaction"];
    reaction.start({reference("reaction_ref", "9")});
    EXPECT_EQ(reaction.stop(), Halted::confirmed);
    EXPECT_FALSE(body->shown);
}

TEST_F(ReactionOfABody, RefusesBadParameters) {
    EXPECT_THAT(refusal("reaction", "start", {}), HasSubstr("mandatory"));
    EXPECT_THAT(refusal("reaction", "start", {reference("reaction_ref", "dance")}), HasSubstr("'dance' is unknown"));
}

class SystemInformationOfABody : public FakeRobot {};

TEST_F(SystemInformationOfABody, AnswersWithPositionAndStatus) {
    auto& system = (*this)["system_information"];
    auto const position = system.query("robot_position");
    EXPECT_EQ(value(position, "robot_ref"), "fake");
    EXPECT_EQ(value(position, "position_data"), "1001, 2000, 0");
    EXPECT_EQ(codebook_of(position, "position_data"), "urn:test::frame");
    EXPECT_EQ(position.located.at(0).position.at(0), 1001);
    EXPECT_EQ(system.location().value().position.at(0), 1000);
    EXPECT_EQ(system.status(), ComponentStatus::ready);
    body->wheels.report.motion = MotionState::obstructed;
    EXPECT_EQ(value(system.query("engine_status"), "status"), "WARNING");
}

class StreamsOfABody : public FakeRobot {};

TEST_F(StreamsOfABody, HaveTheSoundOfTheVoice) {
    auto& audio = (*this)["audio_streaming"];
    audio.perform("connect_stream", {});
    ASSERT_THAT(media->all, SizeIs(1));
    auto const& tone = std::get<media::Sound>(media->all[0]->content).tone;
    EXPECT_DOUBLE_EQ(tone.current_frequency(), 440);
    (*this)["speech_synthesis"].start({text("speech_text", "Hello."), text("character", "child")});
    step();
    EXPECT_DOUBLE_EQ(tone.current_frequency(), 300);
}

TEST_F(StreamsOfABody, HaveThePicturesOfTheCamera) {
    auto& video = (*this)["video_streaming"];
    EXPECT_EQ(body->eye->captures, 0) << "no stream is open";
    video.perform("connect_stream", {});
    EXPECT_EQ(body->eye->captures, 1);
    EXPECT_EQ(std::get<media::Film>(media->all.at(0)->content).draw().value().width, 640);
    EXPECT_THAT(refusal("video_streaming", "set_parameter", {text("encoding_parameters", "image/jpeg;size=9")}),
                HasSubstr("64 to 1280"));
}

class ABody : public FakeRobot {};

TEST_F(ABody, HasAllComponentsUnderTheirNames) {
    for (auto const& basic : basic_components()) {
        auto const& description = (*this)[std::string{basic.ref}].description();
        EXPECT_EQ(description.engine, "fake");
        EXPECT_EQ(description.crs, "") << "the engine's frame";
        EXPECT_EQ(description.moves,
                  basic.ref == "navigation" || basic.ref == "follow" || basic.ref == "move" || basic.ref == "reaction");
    }
    EXPECT_EQ(body->observers(), 17U);
}

TEST(SeveralBodies, HaveTheirNamesInTheirRefs) {
    Robots const two{.bodies = {std::make_shared<FakeBody>("first"), std::make_shared<FakeBody>("second")}, .media = nullptr};
    auto const components = robot_components(two, own_profiles());
    ASSERT_THAT(components, SizeIs(30));
    EXPECT_EQ(components[12]->description().ref.code, "navigation");
    EXPECT_EQ(components[27]->description().ref.code, "second.navigation");
    EXPECT_EQ(components[27]->description().engine, "second");
}

TEST(Bodies, ComponentsAreUninitializedBeforeTheFirstObservation) {
    auto const body = std::make_shared<FakeBody>();
    std::vector<std::unique_ptr<Operated>> operated;
    for (auto& component : robot_components({.bodies = {body}, .media = nullptr}, own_profiles()))
        operated.push_back(std::make_unique<Operated>(
            std::move(component), [] { return Instant{}; }, [&] { return body->now(); }));
    for (auto const& each : operated) EXPECT_EQ(each->status(), ComponentStatus::uninitialized);
    EXPECT_EQ(body->observers(), 15U);
    operated.clear();
    EXPECT_EQ(body->observers(), 0U);
}

}  // namespace
}  // namespace rois::basic::stage
