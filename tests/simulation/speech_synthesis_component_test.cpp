#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/component_stage.hpp"
#include "simulation/ssml.hpp"

namespace rois::simulation::stage {
namespace {

using testing::Contains;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::HasSubstr;

// How long the robot speaks, in seconds of the world.
Seconds duration(ParameterList const& parameters) {
    Stage stage;
    stage.step();
    auto const begun = stage.hall().now();
    stage["speech_synthesis"].start(parameters);
    EXPECT_EQ(stage.outcome("speech_synthesis", 600), "OK");
    return in_seconds(stage.hall().now() - begun);
}

std::string refusal(ParameterList const& parameters, std::string const& command_type = "start") {
    Stage stage;
    return stage["speech_synthesis"].refusal(command_type, parameters).value_or("fine");
}

TEST(SpeechSynthesis, TakesAsLongAsTheText) {
    std::string const words(150, 'a');
    EXPECT_THAT(duration({text("speech_text", words)}), DoubleNear(speech_duration(words), 0.05));
    EXPECT_GT(speech_duration(words), 5);
    EXPECT_LT(duration({text("speech_text", "Hello.")}), 2);
}

TEST(SpeechSynthesis, TellsThatItHasStarted) {
    Stage stage;
    stage["speech_synthesis"].start({text("speech_text", "Welcome.")});
    EXPECT_THAT(stage["speech_synthesis"].words(), ElementsAre("started"));
    EXPECT_EQ(stage.outcome("speech_synthesis"), "OK");
}

TEST(SpeechSynthesis, IsHeardInTheHall) {
    Stage stage;
    stage.step();
    stage["speech_synthesis"].start({text("speech_text", "Willkommen."), text("language", "de")});
    stage.step();
    auto const& robot = stage.hall().robots().front();
    ASSERT_TRUE(robot.speaking);
    EXPECT_EQ(robot.speaking->text, "Willkommen.");
    EXPECT_EQ(robot.speaking->language, "de");
}

TEST(SpeechSynthesis, VisitorsAnswer) {
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

TEST(SpeechSynthesis, StandsStillWhileSuspended) {
    Stage stage;
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
    Stage stage;
    stage["speech_synthesis"].start({text("speech_text", std::string(200, 'a'))});
    stage.run(1);
    stage["speech_synthesis"].stop();
    stage.step();
    EXPECT_FALSE(stage.hall().robots().front().speaking);
    stage.run(30);
    EXPECT_THAT(stage["speech_synthesis"].words(), ElementsAre("started"));
}

TEST(SpeechSynthesis, BeginsAnewWithANewStart) {
    Stage stage;
    stage["speech_synthesis"].start({text("speech_text", std::string(200, 'a'))});
    stage.run(1);
    stage["speech_synthesis"].start({text("speech_text", "Short.")});
    EXPECT_EQ(stage.outcome("speech_synthesis", 5), "OK");
}

TEST(SpeechSynthesis, NeedsAText) {
    EXPECT_THAT(refusal({}), HasSubstr("'speech_text' or 'SSML_text' is mandatory"));
    EXPECT_THAT(refusal({text("speech_text", "  ")}), HasSubstr("mandatory"));
    EXPECT_THAT(refusal({text("SSML_text", "<speak/>")}), HasSubstr("nothing to say"));
    EXPECT_EQ(refusal({}, "set_parameter"), "fine");
    EXPECT_EQ(refusal({text("speech_text", "Hello")}), "fine");
}

TEST(SpeechSynthesis, SaysTheTextThatCameLast) {
    Stage stage;
    auto& synthesis = stage["speech_synthesis"];
    synthesis.set_parameter({text("speech_text", "plain")});
    synthesis.set_parameter({text("SSML_text", "<speak>marked up</speak>")});
    EXPECT_EQ(find(synthesis.stored(), "speech_text"), nullptr);
    synthesis.set_parameter({text("speech_text", "plain again")});
    EXPECT_EQ(find(synthesis.stored(), "SSML_text"), nullptr);
    EXPECT_THAT(refusal({text("speech_text", "plain"), text("SSML_text", "<speak>marked up</speak>")}), HasSubstr("not both"));
}

TEST(SpeechSynthesis, AnEmptyTextDropsTheOtherOneToo) {
    Stage stage;
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

TEST(SpeechSynthesis, RefusesWhatItsVoiceCannotDo) {
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
    EXPECT_THAT(with(text("character", "ghost")), HasSubstr("'ghost'"));
    EXPECT_THAT(refusal({text("speech_text", std::string(20'000, 'a'))}), HasSubstr("longer than"));
    EXPECT_EQ(with(integer("volume", 0)), "fine");
    EXPECT_EQ(with(text("language", "ja")), "fine");
    EXPECT_EQ(with(text("character", "child")), "fine");
}

TEST(SpeechSynthesis, NamesItsLanguagesAndVoices) {
    Stage stage;
    auto const readable = stage["speech_synthesis"].component().readable_parameters();
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

TEST(SpeechSynthesis, NamesThePlaceOfAMistakeInSsml) {
    EXPECT_THAT(refusal({text("SSML_text", "<speak>\n  Hello <emphasis>you</speak>")}), HasSubstr("line 2, column 22"));
    EXPECT_THAT(refusal({text("SSML_text", "<speak>Hello")}, "set_parameter"), HasSubstr("<speak> is not closed"));
    EXPECT_THAT(refusal({text("SSML_text", "<speak xml:lang='xx'>Hello</speak>")}), HasSubstr("'xx'"));
}

std::string spoken(std::string_view document) {
    auto const read = read_ssml(document);
    if (auto const* bad = std::get_if<BadSsml>(&read)) return "bad: " + bad->reason;
    return std::get<SpokenText>(read).text;
}

TEST(Ssml, IsReadWithoutItsTags) {
    EXPECT_EQ(spoken("<speak>Hello, <emphasis>dear</emphasis> guest.</speak>"), "Hello, dear guest.");
    EXPECT_EQ(
        spoken(
            "<?xml version=\"1.0\"?><!-- x --><speak version='1.1' xmlns='http://www.w3.org/2001/10/synthesis'>A\n  B</speak>"),
        "A B");
    EXPECT_EQ(spoken("<speak><p><s>One.</s><s>Two.</s></p></speak>"), "One. Two.");
    EXPECT_EQ(spoken("<speak>hel<mark name='m'/>lo</speak>"), "hello");
    EXPECT_EQ(spoken("<speak>a &lt; b &amp;&#x20;c &#12354;</speak>"), "a < b & c あ");
    EXPECT_EQ(spoken("<speak><![CDATA[a < b]]></speak>"), "a < b");
    EXPECT_EQ(spoken("<speak><metadata>secret</metadata>Said <sub alias=\"World Wide Web\">WWW</sub></speak>"),
              "Said World Wide Web");
}

TEST(Ssml, HasALanguage) {
    EXPECT_EQ(std::get<SpokenText>(read_ssml("<speak xml:lang=\"en-US\">Hi</speak>")).language, "en");
    EXPECT_EQ(std::get<SpokenText>(read_ssml("<speak>Hi</speak>")).language, "");
}

TEST(Ssml, BoundsPausesAndPace) {
    EXPECT_EQ(std::get<SpokenText>(read_ssml("<speak><break time='1e9s'/></speak>")).pauses, 60);
    EXPECT_EQ(std::get<SpokenText>(read_ssml("<speak><break strength='none'/></speak>")).pauses, 0);
    EXPECT_EQ(std::get<SpokenText>(read_ssml("<speak><break time='soon'/></speak>")).pauses, 0.5);
    EXPECT_EQ(std::get<SpokenText>(read_ssml("<speak><prosody rate='0'>a</prosody></speak>")).stretch, 5);
    EXPECT_EQ(std::get<SpokenText>(read_ssml("<speak><prosody rate='quickly'>a</prosody></speak>")).stretch, 1);
    EXPECT_EQ(std::get<SpokenText>(read_ssml("<speak><prosody rate='-50%'>a</prosody></speak>")).stretch, 2);
}

TEST(Ssml, MustBeWellFormed) {
    for (auto document : {"",
                          "   ",
                          "Hello",
                          "<speak",
                          "<speak>",
                          "<speak></talk>",
                          "</speak>",
                          "<speak/><speak/>",
                          "<speak/>after",
                          "<talk>Hi</talk>",
                          "<speak a></speak>",
                          "<speak a=1/>",
                          "<speak a='1' a='2'/>",
                          "<speak a='<'/>",
                          "<speak a='1'b='2'/>",
                          "<speak>&nbsp;</speak>",
                          "<speak>a & b</speak>",
                          "<speak>&#0;</speak>",
                          "<speak>&#xD800;</speak>",
                          "<speak>< a</speak>",
                          "<speak><!-- </speak>",
                          "<speak><![CDATA[</speak>",
                          "<!DOCTYPE speak><speak/>",
                          "<speak><?php ?></speak>",
                          "<speak a='",
                          "<speak a",
                          "<speak a=",
                          "<1/>",
                          "<speak><a></speak></a>",
                          "<speak /a>"})
        EXPECT_THAT(spoken(document), HasSubstr("bad: line 1, column ")) << document;
}

TEST(Ssml, BearsDeepNesting) {
    std::string document = "<speak>";
    for (int i = 0; i < 2'000; ++i) document += "<emphasis>";
    EXPECT_THAT(spoken(document), HasSubstr("<emphasis> is not closed"));
    std::string attributes = "<speak";
    for (int i = 0; i < 40; ++i) attributes += " a" + std::to_string(i) + "='1'";
    EXPECT_THAT(spoken(attributes + "/>"), HasSubstr("too many attributes"));
}

}  // namespace
}  // namespace rois::simulation::stage
