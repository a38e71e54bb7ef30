#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "basic/components/reaction_types.hpp"
#include "basic/speech/grammar.hpp"
#include "simulation/component_stage.hpp"

namespace rois::simulation::stage {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Role says(std::string language, std::string what, Point where = {4, 4}) {
    return visitor("guest", {does(Walk{{where}}), does(Face{at("robot")}), does(Say{std::move(language), std::move(what)}),
                             does(Wait{1000})});
}

std::vector<std::string> recognized(Stage& stage) {
    std::vector<std::string> all;
    for (auto const& reported : stage["speech_recognition"].events("speech_recognized"))
        for (auto const& text : values(reported.results, "recognized_text")) all.push_back(text);
    return all;
}

TEST(SpeechRecognition, ReportsStartEndAndText) {
    Stage stage{{says("en", "Where is the meeting room?")}};
    stage["speech_recognition"].start();
    stage.run(20);
    EXPECT_THAT(stage["speech_recognition"].words(),
                ElementsAre("completed OK, active", "speech_input_started", "speech_input_finished", "speech_recognized"));
    EXPECT_THAT(recognized(stage), ElementsAre("Where is the meeting room?"));
    auto const begun = stage["speech_recognition"].events("speech_input_started").at(0).at;
    auto const ended = stage["speech_recognition"].events("speech_input_finished").at(0).at;
    EXPECT_GT(ended - begun, WorldTime{1000});
}

TEST(SpeechRecognition, UnderstandsItsLanguagesOnly) {
    Stage stage{{says("ja", "こんにちは。")}};
    stage["speech_recognition"].start({texts("languages", {"en"})});
    stage.run(20);
    EXPECT_THAT(stage["speech_recognition"].words(),
                ElementsAre("completed OK, active", "speech_input_started", "speech_input_finished"));
}

TEST(SpeechRecognition, UnderstandsJapaneseAndEnglishByDefault) {
    Stage stage{{says("ja", "こんにちは。")}};
    stage["speech_recognition"].start();
    stage.run(20);
    EXPECT_THAT(recognized(stage), ElementsAre("こんにちは。"));
}

TEST(SpeechRecognition, RefusesUnknownLanguages) {
    Stage stage;
    auto& recognition = stage["speech_recognition"];
    EXPECT_THAT(recognition.refusal("set_parameter", {texts("languages", {"en", "jp"})}).value_or(""), HasSubstr("'jp'"));
    EXPECT_TRUE(recognition.refusal("start", {texts("languages", {})}));
    EXPECT_FALSE(recognition.refusal("start", {texts("languages", {"en", "ja"})}));
}

TEST(SpeechRecognition, NamesTheLanguagesThatItCanRecognize) {
    Stage stage;
    auto const readable = stage["speech_recognition"].readable_parameters();
    ASSERT_NE(find(readable, "recognizable_languages"), nullptr);
    EXPECT_THAT(find(readable, "recognizable_languages")->values, Contains("ja"));
    EXPECT_THAT(find(readable, "recognizable_languages")->values, Contains("en"));
}

TEST(SpeechRecognition, IgnoresDistantSpeech) {
    FloorPlan plan = reception();
    plan.robots[0].sensors.sound.range = 3;
    Stage stage{{says("en", "Hello!", {9, 4})}, plan};
    stage["speech_recognition"].start();
    stage.run(20);
    EXPECT_THAT(stage["speech_recognition"].words(), ElementsAre("completed OK, active"));
}

TEST(SpeechRecognition, ListensForTheGrammarsPhrases) {
    Stage stage{{says("en", "Help!")}};
    stage["speech_recognition"].start({text("grammar", "yes | no | help")});
    stage.run(20);
    EXPECT_THAT(recognized(stage), ElementsAre("help"));
}

TEST(SpeechRecognition, IgnoresSpeechThatIsNotInTheGrammar) {
    Stage stage{{says("en", "Where is the meeting room?")}};
    stage["speech_recognition"].start({text("grammar", "yes | no | help")});
    stage.run(20);
    EXPECT_THAT(recognized(stage), IsEmpty());
    EXPECT_THAT(stage["speech_recognition"].events("speech_input_finished"), SizeIs(1));
}

TEST(SpeechRecognition, ChangesItsGrammarWhileItListens) {
    Stage stage{{says("en", "Help!")}};
    stage["speech_recognition"].start({text("grammar", "yes | no")});
    stage["speech_recognition"].set_parameter({text("grammar", "help")});
    stage.run(20);
    EXPECT_THAT(recognized(stage), ElementsAre("help"));
}

TEST(SpeechRecognition, RefusesInvalidGrammars) {
    Stage stage;
    auto& recognition = stage["speech_recognition"];
    EXPECT_TRUE(recognition.refusal("set_parameter", {text("grammar", "yes||no")}));
    EXPECT_THAT(
        recognition.refusal("set_parameter", {text("grammar", "answer = yes | no"), text("rule", "question")}).value_or(""),
        HasSubstr("'question'"));
    EXPECT_TRUE(recognition.refusal("set_parameter", {text("grammar", "default"), text("rule", "question")}));
    EXPECT_TRUE(recognition.refusal("set_parameter", {text("grammar", std::string(20'000, 'a'))}));
    EXPECT_FALSE(recognition.refusal("set_parameter", {text("grammar", "default"), text("rule", "default")}));
}

TEST(SpeechRecognition, ReportsTheEndOfSpeechAfterResumeButNotTheMissedText) {
    Stage stage{{says("en", "Where is the meeting room?")}};
    auto& recognition = stage["speech_recognition"];
    recognition.start();
    ASSERT_TRUE(stage.run_until([&] { return !recognition.events("speech_input_started").empty(); }));
    recognition.suspend();
    stage.run(10);
    EXPECT_THAT(recognition.events("speech_input_finished"), IsEmpty());
    recognition.resume();
    stage.run(1);
    EXPECT_THAT(recognition.words(), ElementsAre("completed OK, active", "speech_input_started", "speech_input_finished"));
}

TEST(SpeechRecognition, IgnoresSpeechWhileSuspended) {
    Stage stage{{says("en", "Where is the meeting room?")}};
    auto& recognition = stage["speech_recognition"];
    recognition.start();
    recognition.suspend();
    stage.run(20);
    recognition.resume();
    stage.run(1);
    EXPECT_THAT(recognition.words(), ElementsAre("completed OK, active"));
}

// Two robots in sight of each other: the first stands in front of the second, which looks along x.
FloorPlan face_to_face() {
    FloorPlan plan = reception_with_two_robots();
    plan.robots[0].start = {Point{5, 6}, from_degrees(180)};
    return plan;
}

TEST(SpeechRecognition, UnderstandsAnotherRobotButNotItself) {
    Stage stage{{}, face_to_face()};
    stage["speech_recognition"].start();
    stage["robot2.speech_recognition"].start();
    stage["speech_synthesis"].start({text("speech_text", "Good morning, my colleague."), text("language", "en")});
    EXPECT_EQ(stage.outcome("speech_synthesis"), "OK");
    stage.step();
    EXPECT_THAT(stage["robot2.speech_recognition"].words(),
                ElementsAre("completed OK, active", "speech_input_started", "speech_input_finished", "speech_recognized"));
    EXPECT_EQ(value(stage["robot2.speech_recognition"].events("speech_recognized").at(0).results, "recognized_text"),
              "Good morning, my colleague.");
    EXPECT_THAT(stage["speech_recognition"].words(), ElementsAre("completed OK, active"));
}

TEST(SpeechRecognition, UnderstandsAnotherRobotInItsLanguagesOnly) {
    Stage stage{{}, face_to_face()};
    stage["robot2.speech_recognition"].start();
    stage["speech_synthesis"].start({text("speech_text", "Guten Morgen."), text("language", "de")});
    EXPECT_EQ(stage.outcome("speech_synthesis"), "OK");
    stage.step();
    EXPECT_THAT(stage["robot2.speech_recognition"].words(),
                ElementsAre("completed OK, active", "speech_input_started", "speech_input_finished"));
}

std::string match(std::string_view grammar, std::string_view rule, std::string_view speech) {
    auto const read = Grammar::read(grammar, rule);
    return std::get<Grammar>(read).match(speech).value_or("-");
}

TEST(Grammar, ComparesWords) {
    EXPECT_EQ(match("default", "default", "Anything, really."), "Anything, really.");
    EXPECT_EQ(match("good morning", "default", "  Good   morning!"), "good morning");
    EXPECT_EQ(match("good morning", "default", "good morning everybody"), "-");
    EXPECT_EQ(match("はい|いいえ", "default", "はい。"), "はい");
}

TEST(Grammar, HasRules) {
    auto const grammar = "answer = yes | no; drink = green tea | coffee";
    EXPECT_EQ(match(grammar, "drink", "Green tea."), "green tea");
    EXPECT_EQ(match(grammar, "drink", "Yes."), "-");
    EXPECT_EQ(match(grammar, "default", "Yes."), "yes");
    EXPECT_EQ(match("yes\nno", "", "No"), "no");
}

TEST(GestureRecognition, ReportsTheGestureById) {
    ASSERT_FALSE(gestures().empty());
    std::string const id{gestures().front()};
    Stage stage{{visitor("guest", {does(Walk{at(5, 4)}), does(Face{at("robot")}), does(Gesture{id}), does(Wait{1000})})}};
    stage["gesture_recognition"].start();
    stage.run(20);
    auto const events = stage["gesture_recognition"].events("gesture_recognized");
    ASSERT_THAT(events, SizeIs(1));
    EXPECT_THAT(values(events[0].results, "gesture_ref"), ElementsAre(id));
    EXPECT_EQ(codebook_of(events[0].results, "gesture_ref"), "urn:x-rois:def:codebook:simulation::gesture");
    EXPECT_NE(value(events[0].results, "timestamp"), "none");
}

TEST(GestureRecognition, IgnoresGesturesOutOfRangeAndWhileSuspended) {
    std::string const id{gestures().front()};
    auto const gesturing = [&](double x, Seconds when) {
        return visitor("guest", {does(Walk{at(x, 4)}), does(Gesture{id}, when), does(Wait{1000})});
    };
    Stage stage{{gesturing(9.5, 12), gesturing(5, 15)}};
    auto& recognition = stage["gesture_recognition"];
    recognition.start();
    stage.run(14);
    recognition.suspend();
    stage.run(6);
    recognition.resume();
    stage.run(5);
    EXPECT_THAT(recognition.events("gesture_recognized"), IsEmpty());
}

TEST(GestureRecognition, SeesReactionsOfOtherRobotsThatAreGestures) {
    Stage stage{{}, face_to_face()};
    stage["gesture_recognition"].start();
    stage["robot2.gesture_recognition"].start();
    for (auto const* reaction : {"1", "3", "9", "14", "16", "23", "28", "44"}) {
        stage["reaction"].start({reference("reaction_ref", reaction)});
        EXPECT_EQ(stage.outcome("reaction"), "OK");
    }
    std::vector<std::string> seen;
    for (auto const& reported : stage["robot2.gesture_recognition"].events("gesture_recognized"))
        seen.push_back(value(reported.results, "gesture_ref"));
    EXPECT_THAT(seen, ElementsAre("nod", "shake_head", "bow", "clap", "point", "raise_hand", "wave"));
    for (auto const& gesture : seen) EXPECT_THAT(gestures(), Contains(gesture));
    EXPECT_THAT(stage["gesture_recognition"].words(), ElementsAre("completed OK, active")) << "not the robot's own gesture";
}

TEST(GestureRecognition, NamesTheGesturesThatItCanRecognize) {
    Stage stage;
    auto const readable = stage["gesture_recognition"].readable_parameters();
    ASSERT_NE(find(readable, "recognizable_gestures"), nullptr);
    EXPECT_THAT(find(readable, "recognizable_gestures")->values, SizeIs(gestures().size()));
}

}  // namespace
}  // namespace rois::simulation::stage
