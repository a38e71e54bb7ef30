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

// With what reads marked up speech.
struct SpeechStage : Stage {
    SpeechStage() { schemas(); }
};

// How long the robot speaks, in seconds of the world.
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

TEST(SpeechSynthesis, TellsThatItHasStarted) {
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

TEST(SpeechSynthesis, BeginsAnewWithANewStart) {
    SpeechStage stage;
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
    SpeechStage stage;
    auto& synthesis = stage["speech_synthesis"];
    synthesis.set_parameter({text("speech_text", "plain")});
    synthesis.set_parameter({text("SSML_text", "<speak>marked up</speak>")});
    EXPECT_EQ(find(synthesis.stored(), "speech_text"), nullptr);
    synthesis.set_parameter({text("speech_text", "plain again")});
    EXPECT_EQ(find(synthesis.stored(), "SSML_text"), nullptr);
    EXPECT_THAT(refusal({text("speech_text", "plain"), text("SSML_text", "<speak>marked up</speak>")}), HasSubstr("not both"));
}

TEST(SpeechSynthesis, AnEmptyTextDropsTheOtherOneToo) {
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
    SpeechStage stage;
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
    EXPECT_THAT(refusal({text("SSML_text", "<speak>\n  Hello <emphasis>you</speak>")}), HasSubstr("line 2, column 9: "));
    EXPECT_THAT(refusal({text("SSML_text", "<speak>Hello")}, "set_parameter"), HasSubstr("line 1, column 1: "));
    EXPECT_THAT(refusal({text("SSML_text", "<speak xml:lang='xx'>Hello</speak>")}),
                HasSubstr("line 1, column 1: the language 'xx'"));
    EXPECT_THAT(refusal({text("SSML_text", "<speak>Hello,\n <lang xml:lang='tlh'>nuqneH</lang></speak>")}),
                HasSubstr("line 2, column 2: the language 'tlh' cannot be synthesized; those that can are de, en,"));
}

// Each passage is speech of its own, in its language, for its time; the action is done after the last one.
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

TEST(SpeechSynthesis, SaysNoMoreWhenItIsStoppedWithinAPassage) {
    SpeechStage stage;
    stage["speech_synthesis"].start(
        {text("SSML_text", "<speak><p xml:lang='en'>One two three.</p><p xml:lang='de'>Vier.</p></speak>")});
    stage.run(0.4);
    stage["speech_synthesis"].stop();
    stage.run(5);
    for (auto const& happening : stage.hall().chronicle().since(0)) EXPECT_NE(happening.text, "Vier.");
}

TEST(SpeechSynthesis, HoldsWithinAPassage) {
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

std::vector<Passage> passages(std::string_view document) {
    schemas();  // and with them the platform that reads XML
    auto const read = read_ssml(document);
    if (auto const* bad = std::get_if<BadSsml>(&read))
        return {{.text = bad->reason, .language = "bad", .duration = 0, .prosody = {}}};
    return std::get<SpokenText>(read).passages;
}

std::string spoken(std::string_view document) {
    std::string all;
    for (auto const& passage : passages(document))
        all += std::string{all.empty() ? "" : " | "} + (passage.language == "bad" ? "bad: " : "") + passage.text;
    return all;
}

// In seconds, of ten letters a unit of usual pace.
Seconds units(std::string const& document) {
    Seconds sum = 0;
    for (auto const& passage : passages("<speak>" + document + "</speak>")) sum += passage.duration;
    return sum / spoken_seconds("aaaaaaaaaa");
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

TEST(Ssml, SkipsWhatItDoesNotKnow) {
    EXPECT_EQ(spoken("<speak>At <say-as interpret-as='time'>2:30</say-as>, <prosody pitch='high' volume='loud'>Tanaka</prosody> "
                     "<warble>comes</warble>"
                     "<mark name='m'/><audio src='bell.wav'>(a bell)<desc>A bell.</desc></audio>.</speak>"),
              "At 2:30, | Tanaka | comes (a bell) .");
    EXPECT_EQ(spoken("<s:speak xmlns:s='http://www.w3.org/2001/10/synthesis'><s:metadata><a>no</a></s:metadata><s:meta name='a' "
                     "content='b'/><s:lexicon uri='u'/>yes</s:speak>"),
              "yes");
    EXPECT_EQ(spoken("<speak><w>bank</w><token>note</token></speak>"), "bank note") << "words of their own";
}

TEST(Ssml, HasElementsOfItsNamespaceAlone) {
    auto const within = [](std::string const& document, std::string const& name_space) {
        return spoken("<speak" + name_space + " xmlns:x='urn:foreign'>" + document + "</speak>");
    };
    for (auto const* name_space : {"", " xmlns='http://www.w3.org/2001/10/synthesis'"}) {
        EXPECT_EQ(within("<x:desc>dear visitor</x:desc>", name_space), "dear visitor");
        EXPECT_EQ(within("<x:sub alias='WRONG'>right</x:sub>", name_space), "right");
        EXPECT_EQ(within("<sub x:alias='WRONG'>right</sub>", name_space), "right");
        EXPECT_EQ(within("<sub alias='right'><x:a>WRONG</x:a></sub>", name_space), "right");
        EXPECT_EQ(within("<metadata xmlns='urn:foreign'>said</metadata>", name_space), "said");
        EXPECT_EQ(within("<desc>not said</desc>", name_space), "");
        EXPECT_EQ(within("a<x:p>b</x:p>", name_space), "ab");
        EXPECT_EQ(within("<x:lang xml:lang='tlh'>b</x:lang>", name_space).substr(0, 4), "bad:") << "xml:lang is everybody's";
    }
    EXPECT_NEAR(units("<x:prosody xmlns:x='urn:foreign' rate='x-slow' duration='9s'>aaaaaaaaaa</x:prosody>"), 1, 1e-9);
    EXPECT_NEAR(units("<x:break xmlns:x='urn:foreign' time='2s'/>aaaaaaaaaa"), 1, 1e-9);
    EXPECT_EQ(spoken("<s:speak xmlns:s='http://www.w3.org/2001/10/synthesis'>a<desc>b</desc></s:speak>"), "ab");
    EXPECT_EQ(spoken("<speak xmlns='http://www.w3.org/2001/10/synthesis'>a<desc xmlns=''>b</desc></speak>"), "ab");
    EXPECT_THAT(spoken("<speak xmlns='urn:foreign'>a</speak>"), HasSubstr("bad: line 1, column 1: the root element"));
    EXPECT_THAT(spoken("<x:speak>a</x:speak>"), HasSubstr("bad: line 1, column "));
}

TEST(Ssml, HasALanguage) {
    EXPECT_EQ(passages("<speak xml:lang=\"en-US\">Hi</speak>").at(0).language, "en");
    EXPECT_EQ(passages("<speak>Hi</speak>").at(0).language, "");
    EXPECT_EQ(spoken("<speak xml:lang='en'>One <s xml:lang='de'>Zwei</s><voice xml:lang='DE'>drei</voice> four</speak>"),
              "One | Zwei drei | four");
    EXPECT_EQ(spoken("<speak>One <break/><lang xml:lang='de'><break/></lang> two</speak>"), "One two")
        << "silence has no language";
}

TEST(Ssml, FailsInALanguageAsItSays) {
    EXPECT_THAT(spoken("<speak>a<lang xml:lang='tlh'>b</lang></speak>"), HasSubstr("bad: line 1, column 9: the language 'tlh'"));
    EXPECT_THAT(spoken("<speak onlangfailure='changevoice'><p xml:lang='xx'>b</p></speak>"), HasSubstr("bad: "));
    EXPECT_EQ(spoken("<speak>a<lang xml:lang='tlh' onlangfailure='ignoretext'> b <em>c</em></lang> d</speak>"), "a d");
    EXPECT_EQ(spoken("<speak xml:lang='en' onlangfailure='ignorelang'>a<lang xml:lang='tlh'> b</lang></speak>"), "a b");
    EXPECT_EQ(spoken("<speak>a<metadata xml:lang='tlh'>b</metadata></speak>"), "a") << "what is not spoken needs no voice";
}

TEST(Ssml, HasItsTime) {
    std::string const ten(10, 'a');
    EXPECT_NEAR(units(ten + "<emphasis>" + ten + "</emphasis>"), 1 + 1 / 0.9, 1e-9);
    EXPECT_NEAR(units("<emphasis level='strong'>" + ten + "</emphasis>"), 1 / 0.8, 1e-9);
    EXPECT_NEAR(units("<emphasis level='none'>" + ten + "</emphasis>"), 1, 1e-9);
    EXPECT_NEAR(units("<prosody rate='slow'><emphasis level='strong'>" + ten + "</emphasis></prosody>"), 1 / 0.6, 1e-9);
    EXPECT_NEAR(units("<prosody rate='200%'>" + ten + ten + "</prosody>" + ten), 2, 1e-9);
    EXPECT_NEAR(units(ten + "<prosody duration='6.5s'>" + ten + "<break time='100ms'/>" + ten + "</prosody>"), 11, 1e-9);
    EXPECT_NEAR(units("<prosody duration='soon'>" + ten + "</prosody>"), 1, 1e-9);
    EXPECT_NEAR(units("<prosody duration='0s'>" + ten + "</prosody>"), 1, 1e-9) << "no time at all says nothing";
    EXPECT_NEAR(units("<prosody duration='-1s'>" + ten + "</prosody>"), 1, 1e-9);
    EXPECT_NEAR(units("a"), 0.5 / spoken_seconds(ten), 1e-9) << "no speech is shorter than half a second";
}

// SSML 1.1, 3.2.4: but for changes with a sign, rates are of the voice's default one.
TEST(Ssml, HasRatesOfTheDefaultOne) {
    std::string const ten(10, 'a');
    auto const within_slow = [&](std::string const& rate) {
        return 2 / units("<prosody rate='50%'><prosody rate='" + rate + "'>" + ten + ten + "</prosody></prosody>");
    };
    EXPECT_NEAR(within_slow("default"), 1, 1e-9);
    EXPECT_NEAR(within_slow("medium"), 1, 1e-9);
    EXPECT_NEAR(within_slow("fast"), 1.5, 1e-9);
    EXPECT_NEAR(within_slow("50%"), 0.5, 1e-9);
    EXPECT_NEAR(within_slow("1.2"), 1.2, 1e-9);
    EXPECT_NEAR(within_slow("+20%"), 0.6, 1e-9);
    EXPECT_NEAR(within_slow("-20%"), 0.4, 1e-9);
    EXPECT_NEAR(within_slow("quickly"), 0.5, 1e-9);
    EXPECT_NEAR(units("<emphasis level='strong'><prosody rate='slow'>" + ten + "</prosody></emphasis>"), 1 / 0.6, 1e-9);
}

TEST(Ssml, SaysHowTheVoiceSounds) {
    auto const sounds = [](std::string const& document) {
        std::string all;
        for (auto const& passage : passages("<speak>" + document + "</speak>"))
            all += std::string{all.empty() ? "" : " | "} + passage.text + " (" + passage.prosody + ")";
        return all;
    };
    EXPECT_EQ(sounds("a <prosody pitch='high' volume=' loud '>b<break/></prosody> c"),
              "a () | b (pitch high, volume loud) | c ()");
    EXPECT_EQ(sounds("<prosody volume='-6dB' pitch='low'>a <prosody pitch='+10%' range='2st'>b</prosody></prosody>"),
              "a (pitch low, volume -6dB) | b (pitch +10%, range 2st, volume -6dB)");
    EXPECT_EQ(sounds("<prosody pitch='120Hz'><prosody pitch='default'>a</prosody></prosody>"), "a ()");
    EXPECT_EQ(sounds("<prosody contour='(0%,+20Hz) (40%,-10Hz)'>a</prosody>"), "a (contour (0%,+20Hz) (40%,-10Hz))");
    EXPECT_EQ(sounds("<prosody volume='loud'>a</prosody><prosody volume='loud'>b</prosody>"), "ab (volume loud)");
    EXPECT_EQ(sounds("<prosody pitch='purple' range='' contour='(0%,&#10;up)' volume='11 of 10'>a</prosody>"), "a ()");
    EXPECT_EQ(sounds("<emphasis pitch='high'>a</emphasis>"), "a ()") << "prosody's attributes are prosody's";
}

TEST(Ssml, BoundsPausesAndPace) {
    auto const seconds = [](std::string const& document) { return units(document) * spoken_seconds("aaaaaaaaaa"); };
    std::string const ten(10, 'a');
    EXPECT_NEAR(seconds("<break time='1e9s'/>"), 60, 1e-9);
    EXPECT_NEAR(seconds("<break strength='none'/>"), 0, 1e-9);
    EXPECT_NEAR(seconds("<break time='soon'/>"), 0.5, 1e-9);
    EXPECT_NEAR(seconds("<prosody duration='1e9s'>a</prosody>"), 600, 1e-9);
    EXPECT_NEAR(units("<prosody rate='0'>" + ten + "</prosody>"), 5, 1e-9);
    EXPECT_NEAR(units("<prosody rate='quickly'>" + ten + "</prosody>"), 1, 1e-9);
    EXPECT_NEAR(units("<prosody rate='-50%'>" + ten + "</prosody>"), 2, 1e-9);
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
                          "<speak /a>",
                          "<speak>a ]]> b</speak>",
                          "<speak><!-- a -- b --></speak>",
                          "<?xml version=\"1.0\" garbage?><speak/>",
                          "<speak>&#xFFFE;</speak>",
                          "<speak><x:a/></speak>",
                          "<speak x:a=''/>",
                          "<speak xmlns:a='urn:a' xmlns:b='urn:a' a:c='' b:c=''/>"})
        EXPECT_THAT(spoken(document), HasSubstr("bad: line 1, column ")) << document;
}

TEST(Ssml, HasTheLimitsOfADocument) {
    auto const nested = [](int depth) {
        std::string document = "<speak>";
        for (int i = 1; i < depth; ++i) document += "<emphasis>";
        document += "a";
        for (int i = 1; i < depth; ++i) document += "</emphasis>";
        return document + "</speak>";
    };
    EXPECT_EQ(spoken(nested(64)), "a");
    EXPECT_THAT(spoken(nested(65)), HasSubstr("nested too deeply: the limit is 64"));
    std::string attributes = "<speak";
    for (int i = 0; i < 40; ++i) attributes += " a" + std::to_string(i) + "='1'";
    EXPECT_THAT(spoken(attributes + "/>"), HasSubstr("too many attributes"));
    EXPECT_THAT(spoken("<!DOCTYPE speak><speak/>"), HasSubstr("a document type is not allowed"));
    EXPECT_THAT(spoken("<speak><?php ?></speak>"), HasSubstr("a processing instruction is not allowed"));
}

}  // namespace
}  // namespace rois::simulation::stage
