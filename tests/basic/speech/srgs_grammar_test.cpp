// Grammars of W3C SRGS: reading, errors and recognition.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "basic/operated.hpp"
#include "basic/speech/spoken_words.hpp"
#include "basic/speech/srgs_grammar.hpp"

namespace rois::basic::stage {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

// A grammar with these rules, from line 2 on.
std::string grammar(std::string_view rules, std::string_view root = " root='top'") {
    std::string text{"<grammar xmlns='http://www.w3.org/2001/06/grammar' version='1.0' xml:lang='en-US'"};
    return text.append(root).append(">\n").append(rules).append("</grammar>");
}

std::string flaw(std::string const& text) {
    auto const read = SrgsGrammar::read(schemas(), text);
    auto const* flaw = std::get_if<SrgsGrammar::Flaw>(&read);
    return flaw == nullptr ? "it was read" : flaw->reason;
}

SrgsGrammar read(std::string_view rules) {
    auto read = SrgsGrammar::read(schemas(), grammar(rules));
    if (auto const* flaw = std::get_if<SrgsGrammar::Flaw>(&read)) throw std::runtime_error{flaw->reason};
    return std::get<SrgsGrammar>(std::move(read));
}

std::vector<SrgsGrammar::Hypothesis> hypotheses_of(std::string_view rules, std::string_view speech) {
    return read(rules).recognize("", speech, 5);
}

// The most likely text, or "nothing".
std::string understood(std::string_view rules, std::string_view speech) {
    auto const hypotheses = hypotheses_of(rules, speech);
    return hypotheses.empty() ? "nothing" : hypotheses.front().text();
}

constexpr std::string_view order =
    "<rule id='top'><item repeat='0-1'>please</item> bring me <ruleref uri='#number'/> <ruleref uri='#drink'/></rule>"
    "<rule id='number'><one-of><item>a<tag>1</tag></item><item>two<tag>2</tag></item></one-of></rule>"
    "<rule id='drink' scope='public'><one-of><item><token>green tea</token><tag>tea</tag></item>"
    "<item>coffee<tag>coffee</tag></item></one-of></rule>";

TEST(SrgsGrammar, RefusesQuotesThatDoNotEncloseAToken) {
    for (auto const* text : {"to \"new york", "to new york\"", "to new\"york", "\"", "<token>\"new york</token>"}) {
        auto const rule = "\n<rule id='top'>go " + std::string{text} + "</rule>";
        EXPECT_THAT(flaw(grammar(rule)), AllOf(StartsWith("grammar:3:"), HasSubstr("quote"))) << text;
    }
    EXPECT_EQ(understood("<rule id='top'>go to \"new york\" \"now\"</rule>", "go to New York now"), "go to new york now");
    EXPECT_EQ(understood("<rule id='top'>go to <token>\"new york\"</token></rule>", "go to New York"), "go to new york");
}

TEST(SrgsGrammar, RecognizesSpeechThatMatchesItsRules) {
    EXPECT_EQ(understood(order, "Please, bring me two coffee!"), "please bring me two coffee");
    EXPECT_EQ(understood(order, "bring me a Green Tea"), "bring me a green tea");
    EXPECT_EQ(understood(order, "bring me a"), "nothing");
    EXPECT_EQ(understood(order, "bring me a green"), "nothing");
    EXPECT_EQ(understood(order, "please please bring me a coffee"), "nothing");
    EXPECT_EQ(understood(order, ""), "nothing");
}

TEST(SrgsGrammar, ReturnsTheTags) {
    auto const hypotheses = hypotheses_of(order, "bring me two green tea");
    ASSERT_THAT(hypotheses, SizeIs(1));
    EXPECT_THAT(hypotheses[0].tags, ElementsAre("2", "tea"));
    EXPECT_EQ(hypotheses[0].certainty, 1);
    ASSERT_THAT(hypotheses[0].words, SizeIs(4));
    EXPECT_EQ(hypotheses[0].words[3].text, "green tea");
    EXPECT_EQ(hypotheses[0].words[3].from, 3U);
    EXPECT_EQ(hypotheses[0].words[3].to, 5U);
}

TEST(SrgsGrammar, ListensForTheActiveRule) {
    auto const read_order = read(order);
    EXPECT_EQ(read_order.objection_to(""), std::nullopt);
    EXPECT_EQ(read_order.objection_to("#drink"), std::nullopt);
    EXPECT_EQ(read_order.objection_to("#top"), std::nullopt) << "the root may be private";
    EXPECT_THAT(read_order.objection_to("#number").value_or(""), HasSubstr("private"));
    EXPECT_THAT(read_order.objection_to("#food").value_or(""), HasSubstr("no rule '#food'"));
    ASSERT_THAT(read_order.recognize("drink", "coffee", 5), SizeIs(1));
    EXPECT_THAT(read_order.recognize("#drink", "bring me a coffee", 5), IsEmpty());
    auto const rootless = SrgsGrammar::read(schemas(), grammar("<rule id='a'>b</rule>", ""));
    EXPECT_THAT(std::get<SrgsGrammar>(rootless).objection_to("").value_or(""), HasSubstr("no root rule"));
}

TEST(SrgsGrammar, ObeysTheBoundsOfRepeats) {
    auto const count = [](std::string const& repeat, std::string const& speech) {
        return understood("<rule id='top'><item repeat='" + repeat + "'>ha</item></rule>", speech);
    };
    EXPECT_EQ(count("2", "ha ha"), "ha ha");
    EXPECT_EQ(count("2", "ha"), "nothing");
    EXPECT_EQ(count("2", "ha ha ha"), "nothing");
    EXPECT_EQ(count("1-2", "ha ha"), "ha ha");
    EXPECT_EQ(count("1-2", "ha ha ha"), "nothing");
    EXPECT_EQ(count("1-", "ha ha ha ha"), "ha ha ha ha");
    EXPECT_EQ(understood("<rule id='top'>oh <item repeat='0-'><item repeat='0-'>ha</item></item> dear</rule>", "oh ha ha dear"),
              "oh ha ha dear");
    EXPECT_EQ(understood("<rule id='top'>oh <item repeat='0'>ha</item> dear</rule>", "oh dear"), "oh dear");
}

TEST(SrgsGrammar, SupportsTheSpecialRules) {
    EXPECT_EQ(understood("<rule id='top'><ruleref special='GARBAGE'/> help <ruleref special='GARBAGE'/></rule>",
                         "could you help me there"),
              "help");
    EXPECT_EQ(understood("<rule id='top'>yes <ruleref special='NULL'/></rule>", "yes"), "yes");
    EXPECT_EQ(
        understood("<rule id='top'><one-of><item>yes <ruleref special='VOID'/></item><item>no</item></one-of></rule>", "yes"),
        "nothing");
}

TEST(SrgsGrammar, FollowsRulesThatReferToThemselvesLater) {
    constexpr std::string_view list =
        "<rule id='top'><one-of><item>one</item><item>two</item></one-of><item repeat='0-1'>and <ruleref "
        "uri='#top'/></item></rule>";
    EXPECT_EQ(understood(list, "one and two and one"), "one and two and one");
    EXPECT_EQ(understood(list, "one and"), "nothing");
}

TEST(SrgsGrammar, ReturnsAllSimilarHypotheses) {
    constexpr std::string_view rules =
        "<rule id='top'><one-of><item>kitten</item><item>mitten</item><item>sitting</item><item>elephant</item></one-of></rule>";
    auto const hypotheses = hypotheses_of(rules, "kitten");
    ASSERT_THAT(hypotheses, SizeIs(2));
    EXPECT_EQ(hypotheses[0].text(), "kitten");
    EXPECT_EQ(hypotheses[0].certainty, 1);
    EXPECT_EQ(hypotheses[1].text(), "mitten");
    EXPECT_NEAR(hypotheses[1].certainty, 5.0 / 6, 1e-9);
}

TEST(SrgsGrammar, PrefersMoreLikelyAlternatives) {
    constexpr std::string_view rules =
        "<rule id='top'><one-of><item weight='1'>mitten</item><item weight='4'>bitten</item><item "
        "weight='0'>litten</item></one-of>"
        "</rule>";
    auto const hypotheses = hypotheses_of(rules, "kitten");
    ASSERT_THAT(hypotheses, SizeIs(2));
    EXPECT_EQ(hypotheses[0].text(), "bitten");
    EXPECT_NEAR(hypotheses[1].certainty, 5.0 / 6 / 4, 1e-9);
}

TEST(SrgsGrammar, UnderstandsJapaneseWithoutSpaces) {
    constexpr std::string_view rules = "<rule id='top'><one-of><item>緑茶</item><item>水</item></one-of>を ください</rule>";
    EXPECT_EQ(understood(rules, "緑茶をください。"), "緑茶 を ください");
    EXPECT_EQ(understood(rules, "お茶をください。"), "nothing");
}

TEST(SrgsGrammar, GivesUpOnTooAmbiguousGrammars) {
    std::string rules{"<rule id='top'>"};
    for (int i = 0; i < 30; ++i) rules += "<ruleref special='GARBAGE'/>";
    std::string speech;
    for (int i = 0; i < 100; ++i) speech += "well ";
    EXPECT_EQ(understood(rules + "</rule>", speech), "nothing");
}

TEST(SrgsGrammar, ReportsThePlaceOfAnError) {
    EXPECT_THAT(flaw("<grammar"), StartsWith("grammar:1:1: the document ends inside a tag"));
    EXPECT_THAT(flaw(grammar("<rule id='a'/>\n<rule id='a'/>", "")), AllOf(StartsWith("grammar:3:1: "), HasSubstr("'a'")));
    EXPECT_THAT(flaw(grammar("<rule>x</rule>", "")), AllOf(StartsWith("grammar:2:1: "), HasSubstr("'id'")));
    EXPECT_THAT(flaw(grammar("<rule id='a'>\n<item repeat='often'>x</item></rule>", "")), StartsWith("grammar:3:1: "));
    EXPECT_THAT(flaw(grammar("<rule id='a'>\n<item repeat='3-2'>x</item></rule>", "")),
                AllOf(StartsWith("grammar:3:1: "), HasSubstr("has a maximum below its minimum")));
    EXPECT_THAT(flaw(grammar("<rule id='a'>\n<ruleref uri='#b'/></rule>", "")),
                AllOf(StartsWith("grammar:3:1: "), HasSubstr("unknown rule 'b'")));
    EXPECT_THAT(flaw(grammar("<rule id='a'>\n<ruleref uri='http://x/y#b'/></rule>", "")), HasSubstr("unsupported uri"));
    EXPECT_THAT(flaw(grammar("<rule id='a'>\n<ruleref/></rule>", "")), HasSubstr("either 'uri' or 'special'"));
    EXPECT_THAT(flaw(grammar("<rule id='a'>x</rule>", " root='b'")), AllOf(StartsWith("grammar:1:1: "), HasSubstr("'b'")));
    EXPECT_THAT(flaw(grammar("<rule id='a'>x</rule>", " mode='dtmf'")), StartsWith("grammar:1:1: "));
    for (std::string const reserved : {"NULL", "VOID", "GARBAGE"})
        EXPECT_THAT(flaw(grammar("<rule id='a'>x</rule>\n<rule id='" + reserved + "'>x</rule>", "")),
                    AllOf(StartsWith("grammar:3:1: "), HasSubstr("'" + reserved + "' is reserved for a special rule")));
    for (std::string const reserved : {" NULL ", "&#9;VOID&#10;"})
        EXPECT_THAT(flaw(grammar("<rule id='" + reserved + "'>x</rule>", "")), HasSubstr("is reserved for a special rule"));
    EXPECT_THAT(flaw("<scenario xmlns='urn:x-rois:simulation:hall:1' name='x'/>"), HasSubstr("not an SRGS grammar"));
    EXPECT_THAT(flaw(grammar("<rule id='a'><one-of>\n<item weight='0'>x</item></one-of></rule>", "")), HasSubstr("the weight 0"));
}

// The schema allows spaces around a token.
TEST(SrgsGrammar, AllowsSpacesAroundTokens) {
    EXPECT_THAT(
        understood("<rule id='top'><one-of><item>yes <ruleref special=' VOID '/></item><item>no</item></one-of></rule>", "yes"),
        understood("<rule id='top'><one-of><item>yes <ruleref special='VOID'/></item><item>no</item></one-of></rule>", "yes"));
    EXPECT_EQ(flaw(grammar("<rule id=' a ' scope=' public '>x <ruleref uri='#b'/> <ruleref special='&#9;NULL '/></rule>"
                           "<rule id=' b '>y</rule>",
                           " root=' a '")),
              "it was read");
}

// Decision 28: languages are ISO 639-1.
TEST(SrgsGrammar, RefusesLanguagesThatCannotBeRecognized) {
    auto const in = [](std::string const& language) {
        return flaw("<grammar xmlns='http://www.w3.org/2001/06/grammar' version='1.0' xml:lang='" + language +
                    "'><rule id='a'>x</rule></grammar>");
    };
    EXPECT_EQ(in("ja"), "it was read");
    EXPECT_EQ(in("ja-JP"), "it was read");
    EXPECT_EQ(in("EN-us"), "it was read");
    for (auto const* language : {"jp", "jp-JP", "tlh"})
        EXPECT_THAT(in(language), AllOf(StartsWith("grammar:1:1: the language '"), HasSubstr("expected one of de, en,")));
}

TEST(SrgsGrammar, IgnoresElementsThatAreIrrelevantForRecognition) {
    EXPECT_EQ(understood("<meta name='author' content='us'/><lexicon uri='http://example.org/names.pls' "
                         "type='application/pls+xml'/><metadata><r:RDF xmlns:r='http://www.w3.org/1999/02/22-rdf-syntax-ns#'>"
                         "<rule id='x'/></r:RDF></metadata><rule id='top'><ruleref uri='#more' type='application/srgs+xml'/>"
                         "</rule><rule id='more'>hello</rule>",
                         "hello"),
              "hello");
    EXPECT_THAT(flaw(grammar("<rule id='a'>x</rule><lexicon uri='u'/>", "")), StartsWith("grammar:2:"))
        << "must come before the rules";
    EXPECT_THAT(flaw(grammar("<rule id='a' xmlns:x='urn:foreign'><x:b/></rule>", "")), HasSubstr("unknown element 'x:b'"));
}

TEST(SrgsGrammar, IsRefusedWhenARuleBeginsWithItself) {
    EXPECT_THAT(flaw(grammar("<rule id='a'>x</rule>\n<rule id='b'><item repeat='0-1'>x</item><ruleref uri='#c'/></rule>"
                             "<rule id='c'><one-of><item>y</item><item><ruleref uri='#b'/> z</item></one-of></rule>",
                             "")),
                AllOf(StartsWith("grammar:3:1: "), HasSubstr("'b' refers to itself before any word")));
    EXPECT_EQ(flaw(grammar("<rule id='a'>x <item repeat='0-1'><ruleref uri='#a'/></item></rule>", "")), "it was read");
}

TEST(SpokenWords, AreComparedByLetters) {
    EXPECT_THAT(split_into_words("  Well, \"green-tea\"...  水を! "), ElementsAre("well", "green", "tea", "水", "を"));
    EXPECT_EQ(likeness("tea", "tea"), 1);
    EXPECT_NEAR(likeness("tea", "tee"), 2.0 / 3, 1e-9);
    EXPECT_NEAR(likeness("kitten", "sitting"), 1 - 3.0 / 7, 1e-9);
    EXPECT_EQ(likeness("水", "茶"), 0);
    EXPECT_EQ(likeness("", "abc"), 0);
}

}  // namespace
}  // namespace rois::basic::stage
