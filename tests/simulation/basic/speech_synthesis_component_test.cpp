#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "simulation/component_stage.hpp"

namespace rois::simulation::stage {
namespace {

using testing::Contains;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

// With an xml::Platform, which SSML needs.
struct SpeechStage : Stage {
    SpeechStage() { schemas(); }
};

// How long the robot speaks, in seconds of world time.
Seconds duration(ParameterList const& parameters) {
    SpeechStage stage;
    stage.step();
    auto const begun = stage.hall().now();
    stage["speech_synthesis"].start(parameters);
    EXPECT_EQ(stage.outcome("speech_synthesis", 600), "OK");
    return in_seconds(stage.hall().now() - begun);
}

std::string refusal(ParameterList const& parameters, std::string const& command_type = "start") {
    SpeechStage stage;
    return stage["speech_synthesis"].refusal(command_type, parameters).value_or("fine");
}

TEST(SpeechSynthesis, TakesAsLongAsTheText) {
    std::string const words(150, 'a');
    EXPECT_THAT(duration({text("speech_text", words)}), DoubleNear(speech_duration(words), 0.05));
    EXPECT_GT(speech_duration(words), 5);
    EXPECT_LT(duration({text("speech_text", "Hello.")}), 2);
}

TEST(SpeechSynthesis, ReportsStarted) {
    SpeechStage stage;
    stage["speech_synthesis"].start({text("speech_text", "Welcome.")});
    EXPECT_THAT(stage["speech_synthesis"].words(), ElementsAre("started"));
    EXPECT_EQ(stage.outcome("speech_synthesis"), "OK");
}

TEST(SpeechSynthesis, IsHeardInTheHall) {
    SpeechStage stage;
    stage.step();
    stage["speech_synthesis"].start({text("speech_text", "Willkommen."), text("language", "de")});
    stage.step();
    auto const& robot = stage.hall().robots().front();
    ASSERT_TRUE(robot.speaking);
    EXPECT_EQ(robot.speaking->text, "Willkommen.");
    EXPECT_EQ(robot.speaking->language, "de");
}

TEST(SpeechSynthesis, VisitorsAnswerIt) {
    Role guest = visitor("guest", {does(Walk{at(4, 4)}), does(Face{at("robot")}), does(Wait{1000})});
    Answer answer;
    answer.to = "help";
    answer.language = "en";
    answer.text = "Yes, please.";
    guest.answers = {answer};
    Stage stage{{guest}};
    stage.run(15);
    stage["speech_recognition"].start();
    stage["speech_synthesis"].start({text("speech_text", "May I help you?"), integer("volume", 80)});
    EXPECT_TRUE(stage.run_until([&] { return !stage["speech_recognition"].events("speech_recognized").empty(); }, 20));
}

TEST(SpeechSynthesis, IsSilentWhileSuspended) {
    SpeechStage stage;
    std::string const words(60, 'a');
    stage["speech_synthesis"].start({text("speech_text", words)});
    stage.run(1);
    stage["speech_synthesis"].suspend();
    stage.run(60);
    EXPECT_FALSE(stage["speech_synthesis"].ended());
    EXPECT_FALSE(stage.hall().robots().front().speaking);
    stage["speech_synthesis"].resume();
    auto const resumed = stage.hall().now();
    EXPECT_EQ(stage.outcome("speech_synthesis"), "OK");
    EXPECT_NEAR(in_seconds(stage.hall().now() - resumed), speech_duration(words) - 1, 0.1);
}

TEST(SpeechSynthesis, FallsSilentWhenStopped) {
    SpeechStage stage;
    stage["speech_synthesis"].start({text("speech_text", std::string(200, 'a'))});
    stage.run(1);
    stage["speech_synthesis"].stop();
    stage.step();
    EXPECT_FALSE(stage.hall().robots().front().speaking);
    stage.run(30);
    EXPECT_THAT(stage["speech_synthesis"].words(), ElementsAre("started"));
}

TEST(SpeechSynthesis, StartsOverWithANewStart) {
    SpeechStage stage;
    stage["speech_synthesis"].start({text("speech_text", std::string(200, 'a'))});
    stage.run(1);
    stage["speech_synthesis"].start({text("speech_text", "Short.")});
    EXPECT_EQ(stage.outcome("speech_synthesis", 5), "OK");
}

TEST(SpeechSynthesis, NeedsAText) {
    EXPECT_THAT(refusal({}), HasSubstr("'speech_text' or 'SSML_text' is mandatory"));
    EXPECT_THAT(refusal({text("speech_text", "  ")}), HasSubstr("mandatory"));
    EXPECT_THAT(refusal({text("SSML_text", "<speak/>")}), HasSubstr("no text to speak"));
    EXPECT_EQ(refusal({}, "set_parameter"), "fine");
    EXPECT_EQ(refusal({text("speech_text", "Hello")}), "fine");
}

TEST(SpeechSynthesis, SpeaksTheLastText) {
    SpeechStage stage;
    auto& synthesis = stage["speech_synthesis"];
    synthesis.set_parameter({text("speech_text", "plain")});
    synthesis.set_parameter({text("SSML_text", "<speak>marked up</speak>")});
    EXPECT_EQ(find(synthesis.stored(), "speech_text"), nullptr);
    synthesis.set_parameter({text("speech_text", "plain again")});
    EXPECT_EQ(find(synthesis.stored(), "SSML_text"), nullptr);
    EXPECT_THAT(refusal({text("speech_text", "plain"), text("SSML_text", "<speak>marked up</speak>")}),
                HasSubstr("set only one"));
}

TEST(SpeechSynthesis, AnEmptyTextReplacesTheOtherOneToo) {
    SpeechStage stage;
    auto& synthesis = stage["speech_synthesis"];
    synthesis.set_parameter({text("SSML_text", "<speak>marked up</speak>")});
    EXPECT_THAT(synthesis.refusal("start", {text("speech_text", "")}).value_or("fine"), HasSubstr("mandatory"));
    synthesis.set_parameter({text("speech_text", "")});
    EXPECT_EQ(find(synthesis.stored(), "SSML_text"), nullptr);
    EXPECT_THAT(synthesis.refusal("start", {}).value_or("fine"), HasSubstr("mandatory"));
    synthesis.set_parameter({text("speech_text", "plain")});
    synthesis.set_parameter({text("SSML_text", "")});
    EXPECT_EQ(find(synthesis.stored(), "speech_text"), nullptr);
    EXPECT_THAT(synthesis.refusal("start", {}).value_or("fine"), HasSubstr("mandatory"));
}

TEST(SpeechSynthesis, RefusesUnsupportedLanguagesAndVoices) {
    ParameterList const hello{text("speech_text", "Hello")};
    auto const with = [&](Parameter parameter) {
        ParameterList all = hello;
        all.push_back(std::move(parameter));
        return refusal(all);
    };
    EXPECT_THAT(with(integer("volume", 101)), HasSubstr("volume"));
    EXPECT_THAT(with(integer("volume", -1)), HasSubstr("volume"));
    EXPECT_THAT(with(text("language", "jp")), HasSubstr("'jp'"));
    EXPECT_THAT(with(text("language", "EN")), HasSubstr("'EN'"));
    EXPECT_THAT(with(text("character", "ghost")),
                HasSubstr("'ghost' is not one of the synthesizable_characters: default, female, male, child, robot"));
    EXPECT_THAT(refusal({text("speech_text", std::string(20'000, 'a'))}), HasSubstr("longer than"));
    EXPECT_EQ(with(integer("volume", 0)), "fine");
    EXPECT_EQ(with(text("language", "ja")), "fine");
    EXPECT_EQ(with(text("character", "child")), "fine");
}

std::vector<std::string> characters() {
    SpeechStage stage;
    return find(stage["speech_synthesis"].readable_parameters(), "synthesizable_characters")->values;
}

TEST(SpeechSynthesis, EachCharacterSpeaksAtItsOwnPaceAndIsHeard) {
    std::string const words(150, 'a');
    std::set<long> durations;
    for (auto const& character : characters()) {
        SpeechStage stage;
        stage["speech_synthesis"].start({text("speech_text", words), text("character", character)});
        stage.step();
        ASSERT_TRUE(stage.robot_state().speaking) << character;
        EXPECT_EQ(stage.robot_state().speaking->character, character);
        EXPECT_EQ(stage.outcome("speech_synthesis"), "OK");
        auto const seconds = in_seconds(stage.hall().now());
        EXPECT_NEAR(seconds, speech_duration(words) / voice_character(character).pace, 0.1) << character;
        durations.insert(std::lround(seconds * 5));
    }
    EXPECT_THAT(characters(), ElementsAre("default", "female", "male", "child", "robot"));
    EXPECT_EQ(durations.size(), characters().size()) << "all different";
}

TEST(SpeechSynthesis, SpeaksSsmlWithItsCharacterWhereTheDocumentNamesNoVoice) {
    SpeechStage stage;
    auto const before = stage.hall().chronicle().last();
    stage["speech_synthesis"].start(
        {text("character", "male"), text("SSML_text", "<speak>One <voice name='child'>two</voice> three</speak>")});
    EXPECT_EQ(stage.outcome("speech_synthesis"), "OK");
    std::vector<std::string> said;
    for (auto const& happening : stage.hall().chronicle().since(before))
        if (happening.kind == Happening::Kind::speech_started) said.push_back(happening.character + ": " + happening.text);
    EXPECT_THAT(said, ElementsAre("male: One", "child: two", "male: three"));
}

TEST(SpeechSynthesis, NamesItsLanguagesAndVoices) {
    SpeechStage stage;
    auto const readable = stage["speech_synthesis"].readable_parameters();
    ASSERT_NE(find(readable, "synthesizable_languages"), nullptr);
    ASSERT_NE(find(readable, "synthesizable_characters"), nullptr);
    EXPECT_THAT(find(readable, "synthesizable_languages")->values, Contains("en"));
    EXPECT_THAT(find(readable, "synthesizable_characters")->values, Contains("default"));
}

TEST(SpeechSynthesis, HonoursPausesAndPaceOfSsml) {
    std::string const words(60, 'a');
    Seconds const plain = duration({text("speech_text", words)});
    EXPECT_THAT(duration({text("SSML_text", "<speak>" + words + "</speak>")}), DoubleNear(plain, 0.05));
    EXPECT_THAT(duration({text("SSML_text", "<speak>" + words + "<break time=\"1500ms\"/></speak>")}),
                DoubleNear(plain + 1.5, 0.05));
    EXPECT_THAT(duration({text("SSML_text", "<speak><prosody rate='50%'>" + words + "</prosody></speak>")}),
                DoubleNear(2 * plain, 0.05));
    EXPECT_THAT(duration({text("SSML_text", "<speak><break time='2s'/></speak>")}), DoubleNear(2, 0.05));
}

TEST(SpeechSynthesis, ReportsThePlaceOfAnErrorInSsml) {
    EXPECT_THAT(refusal({text("SSML_text", "<speak>\n  Hello <emphasis>you</speak>")}), HasSubstr("line 2, column 9: "));
    EXPECT_THAT(refusal({text("SSML_text", "<speak>Hello")}, "set_parameter"), HasSubstr("line 1, column 1: "));
    EXPECT_THAT(refusal({text("SSML_text", "<speak xml:lang='xx'>Hello</speak>")}),
                HasSubstr("line 1, column 1: the language 'xx'"));
    EXPECT_THAT(refusal({text("SSML_text", "<speak>Hello,\n <lang xml:lang='tlh'>nuqneH</lang></speak>")}),
                HasSubstr("line 2, column 2: the language 'tlh' cannot be synthesized; expected one of de, en,"));
}

// Each passage is separate speech with its language and duration. The action ends after the last one.
TEST(SpeechSynthesis, SpeaksEachPassageInItsLanguage) {
    SpeechStage stage;
    stage.step();
    auto const before = stage.hall().chronicle().last();
    auto const begun = stage.hall().now();
    stage["speech_synthesis"].start({text("language", "de"), text("SSML_text",
                                                                  "<speak>Guten Tag, <lang xml:lang='ja-JP'>田中さん</lang>"
                                                                  "<break time='2s'/>, willkommen!</speak>")});
    EXPECT_EQ(stage.outcome("speech_synthesis"), "OK");
    std::vector<std::string> said;
    Seconds sum = 0;
    for (auto const& happening : stage.hall().chronicle().since(before)) {
        if (happening.kind != Happening::Kind::speech_started) continue;
        said.push_back(happening.language + ": " + happening.text);
        sum += happening.lasts;
        EXPECT_NEAR(in_seconds(happening.at - begun), sum - happening.lasts, 0.07);
    }
    EXPECT_THAT(said, ElementsAre("de: Guten Tag,", "ja: 田中さん", "de: , willkommen!"));
    EXPECT_NEAR(sum, in_seconds(stage.hall().now() - begun), 0.07);
    EXPECT_NEAR(sum, 10 * 0.065 + 4 * 0.15 + 2 + 13 * 0.065, 0.001);
}

TEST(SpeechSynthesis, IsSilentWhenStoppedWithinAPassage) {
    SpeechStage stage;
    stage["speech_synthesis"].start(
        {text("SSML_text", "<speak><p xml:lang='en'>One two three.</p><p xml:lang='de'>Vier.</p></speak>")});
    stage.run(0.4);
    stage["speech_synthesis"].stop();
    stage.run(5);
    for (auto const& happening : stage.hall().chronicle().since(0)) EXPECT_NE(happening.text, "Vier.");
}

TEST(SpeechSynthesis, ResumesWithinAPassage) {
    SpeechStage stage;
    auto& synthesis = stage["speech_synthesis"];
    synthesis.start(
        {text("SSML_text", "<speak><p xml:lang='en'>One two three four.</p><p xml:lang='de'>Vier f&#252;nf sechs.</p></speak>")});
    stage.run(0.5);
    synthesis.suspend();
    stage.run(10);
    EXPECT_FALSE(synthesis.ended());
    synthesis.resume();
    EXPECT_EQ(stage.outcome("speech_synthesis"), "OK");
}

}  // namespace
}  // namespace rois::simulation::stage
