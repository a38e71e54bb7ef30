// The meaning of SSML: words, languages, prosody and durations (7.6.11).
#include <gmock/gmock.h>

#include "basic/operated.hpp"
#include "basic/speech/ssml.hpp"

namespace rois::basic::stage {
namespace {

using testing::HasSubstr;

std::vector<Passage> passages(std::string_view document) {
    schemas();  // creates the xml::Platform
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

// Duration in units of ten letters at the default pace.
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

TEST(Ssml, IgnoresUnknownElements) {
    EXPECT_EQ(spoken("<speak>At <say-as interpret-as='time'>2:30</say-as>, <prosody pitch='high' volume='loud'>Tanaka</prosody> "
                     "<warble>comes</warble>"
                     "<mark name='m'/><audio src='bell.wav'>(a bell)<desc>A bell.</desc></audio>.</speak>"),
              "At 2:30, | Tanaka | comes (a bell) .");
    EXPECT_EQ(spoken("<s:speak xmlns:s='http://www.w3.org/2001/10/synthesis'><s:metadata><a>no</a></s:metadata><s:meta name='a' "
                     "content='b'/><s:lexicon uri='u'/>yes</s:speak>"),
              "yes");
    EXPECT_EQ(spoken("<speak><w>bank</w><token>note</token></speak>"), "bank note") << "separate words";
}

TEST(Ssml, IgnoresElementsOfOtherNamespaces) {
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
        EXPECT_EQ(within("<x:lang xml:lang='tlh'>b</x:lang>", name_space).substr(0, 4), "bad:")
            << "xml:lang is valid on all elements";
    }
    EXPECT_NEAR(units("<x:prosody xmlns:x='urn:foreign' rate='x-slow' duration='9s'>aaaaaaaaaa</x:prosody>"), 1, 1e-9);
    EXPECT_NEAR(units("<x:break xmlns:x='urn:foreign' time='2s'/>aaaaaaaaaa"), 1, 1e-9);
    EXPECT_EQ(spoken("<s:speak xmlns:s='http://www.w3.org/2001/10/synthesis'>a<desc>b</desc></s:speak>"), "ab");
    EXPECT_EQ(spoken("<speak xmlns='http://www.w3.org/2001/10/synthesis'>a<desc xmlns=''>b</desc></speak>"), "ab");
    EXPECT_THAT(spoken("<speak xmlns='urn:foreign'>a</speak>"), HasSubstr("bad: line 1, column 1: the root element"));
    EXPECT_THAT(spoken("<x:speak>a</x:speak>"), HasSubstr("bad: line 1, column "));
}

// "female: One | child: two"
std::string voices(std::string const& document) {
    std::string all;
    for (auto const& passage : passages("<speak>" + document + "</speak>"))
        all += std::string{all.empty() ? "" : " | "} + passage.character + ": " + passage.text;
    return all;
}

TEST(Ssml, ChoosesAVoiceByNameGenderAndAge) {
    EXPECT_EQ(voices("One <voice name='child'>two</voice> three"), "default: One | child: two | default: three");
    EXPECT_EQ(voices("<voice name='Kyoko Hattori robot male'>one</voice>"), "robot: one") << "the first known one";
    EXPECT_EQ(voices("<voice gender='female'>one</voice><voice gender='male'>two</voice>"), "female: one | male: two");
    EXPECT_EQ(voices("<voice gender='female' age='7'>one</voice>"), "child: one");
    EXPECT_EQ(voices("<voice gender='female' age='30'>one</voice>"), "female: one");
    EXPECT_EQ(voices("<voice name='Kyoko' gender='female'>one</voice>"), "female: one");
    EXPECT_EQ(voices("<voice gender='male'>one <voice gender='neutral'>two</voice> three</voice>"),
              "male: one | default: two | male: three");
    EXPECT_EQ(voices("<voice gender='male'>one <voice name='Kyoko' age='old'>two</voice></voice>"), "male: one two")
        << "keeps the voice if none matches";
    EXPECT_EQ(voices("<p name='child' gender='female'>one</p>"), "default: one");
    EXPECT_EQ(passages("<speak><voice name='child' xml:lang='ja'>one</voice></speak>").at(0).language, "ja");
}

TEST(Ssml, UsesThePaceOfTheVoice) {
    EXPECT_NEAR(units("<voice name='robot'>aaaaaaaaaa</voice>"), 1 / 0.8, 1e-9);
    EXPECT_NEAR(units("<prosody rate='50%'><voice name='robot'>aaaaaaaaaa</voice></prosody>"), 2 / 0.8, 1e-9);
    EXPECT_NEAR(units("<voice name='robot'>aaaaaaaaaa<break time='1s'/></voice>"), 1 / 0.8 + 1 / spoken_seconds("aaaaaaaaaa"),
                1e-9)
        << "pauses are not scaled";
}

TEST(Ssml, UsesXmlLang) {
    EXPECT_EQ(passages("<speak xml:lang=\"en-US\">Hi</speak>").at(0).language, "en");
    EXPECT_EQ(passages("<speak>Hi</speak>").at(0).language, "");
    EXPECT_EQ(spoken("<speak xml:lang='en'>One <s xml:lang='de'>Zwei</s><voice xml:lang='DE'>drei</voice> four</speak>"),
              "One | Zwei drei | four");
    EXPECT_EQ(spoken("<speak>One <break/><lang xml:lang='de'><break/></lang> two</speak>"), "One two")
        << "silence has no language";
}

TEST(Ssml, HandlesUnsupportedLanguagesByOnlangfailure) {
    EXPECT_THAT(spoken("<speak>a<lang xml:lang='tlh'>b</lang></speak>"), HasSubstr("bad: line 1, column 9: the language 'tlh'"));
    EXPECT_THAT(spoken("<speak onlangfailure='changevoice'><p xml:lang='xx'>b</p></speak>"), HasSubstr("bad: "));
    EXPECT_EQ(spoken("<speak>a<lang xml:lang='tlh' onlangfailure='ignoretext'> b <em>c</em></lang> d</speak>"), "a d");
    EXPECT_EQ(spoken("<speak xml:lang='en' onlangfailure='ignorelang'>a<lang xml:lang='tlh'> b</lang></speak>"), "a b");
    EXPECT_EQ(spoken("<speak>a<metadata xml:lang='tlh'>b</metadata></speak>"), "a") << "unspoken text needs no language";
}

TEST(Ssml, ComputesDurations) {
    std::string const ten(10, 'a');
    EXPECT_NEAR(units(ten + "<emphasis>" + ten + "</emphasis>"), 1 + 1 / 0.9, 1e-9);
    EXPECT_NEAR(units("<emphasis level='strong'>" + ten + "</emphasis>"), 1 / 0.8, 1e-9);
    EXPECT_NEAR(units("<emphasis level='none'>" + ten + "</emphasis>"), 1, 1e-9);
    EXPECT_NEAR(units("<prosody rate='slow'><emphasis level='strong'>" + ten + "</emphasis></prosody>"), 1 / 0.6, 1e-9);
    EXPECT_NEAR(units("<prosody rate='200%'>" + ten + ten + "</prosody>" + ten), 2, 1e-9);
    EXPECT_NEAR(units(ten + "<prosody duration='6.5s'>" + ten + "<break time='100ms'/>" + ten + "</prosody>"), 11, 1e-9);
    EXPECT_NEAR(units("<prosody duration='soon'>" + ten + "</prosody>"), 1, 1e-9);
    EXPECT_NEAR(units("<prosody duration='0s'>" + ten + "</prosody>"), 1, 1e-9) << "ignores a duration of 0";
    EXPECT_NEAR(units("<prosody duration='-1s'>" + ten + "</prosody>"), 1, 1e-9);
    EXPECT_NEAR(units("a"), 0.5 / spoken_seconds(ten), 1e-9) << "speech takes at least half a second";
}

// SSML 1.1, 3.2.4: rates without a sign are relative to the voice's default rate.
TEST(Ssml, RatesAreRelativeToTheDefault) {
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

TEST(Ssml, ReadsPitchRangeContourAndVolume) {
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
    EXPECT_EQ(sounds("<emphasis pitch='high'>a</emphasis>"), "a ()") << "only for prosody";
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

TEST(Ssml, ObeysTheLimitsOfDocuments) {
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
}  // namespace rois::basic::stage
