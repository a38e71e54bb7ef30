// Components that users bring the profile of: the examples of Annex C, and the stand-in.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "simulation/adapters.hpp"
#include "simulation/component_refs.hpp"
#include "simulation/component_stage.hpp"

namespace rois::simulation::stage {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Role at_the_robot(std::string id) {
    return visitor(std::move(id), {does(Walk{at(4, 4)}), does(Face{at("robot")}), does(Wait{1000})});
}

Role says(std::string language, std::string what, Point where = {4, 4}) {
    return visitor("guest", {does(Walk{{where}}), does(Face{at("robot")}), does(Say{std::move(language), std::move(what)}),
                             does(Wait{1000})});
}

constexpr std::string_view drinks =
    "<grammar xmlns='http://www.w3.org/2001/06/grammar' version='1.0' xml:lang='en-GB' root='order'>"
    "<rule id='order'>a <one-of><item>coffee<tag>1</tag></item><item>toffee<tag>2</tag></item></one-of> please</rule></grammar>";

Parameter grammar(std::string_view document = drinks) { return text("grammar", std::string{document}); }

TEST(SrgsSpeechRecognition, TellsAllThatMayHaveBeenSaid) {
    Stage stage{{says("en", "A coffee, please!")}};
    auto& recognition = stage.add("srgs_speech_recognition.xml");
    recognition.start({grammar()});
    stage.run(20);
    EXPECT_THAT(recognition.words(),
                ElementsAre("completed OK, active", "speech_input_started", "speech_input_finished", "speech_recognition_started",
                            "speech_recognized", "speech_recognition_finished"));
    auto const results = recognition.events("speech_recognized").at(0).results;
    EXPECT_EQ(value(results, "nbest"), "1.000 en a coffee please\n0.833 en a toffee please");
    EXPECT_EQ(value(results, "lattice"),
              "w1 n0 n1 1.000 en a\nw2 n1 n2 1.000 en coffee\nw3 n1 n2 0.833 en toffee\nw4 n2 n3 1.000 en please");
    EXPECT_THAT(values(results, "meaning"), ElementsAre("1"));
    EXPECT_LT(value(results, "timestamp_speech_start"), value(results, "timestamp_speech_end"));
    EXPECT_EQ(value(results, "timestamp"), value(results, "timestamp_speech_end"));
    ASSERT_THAT(results.located, SizeIs(1));
    EXPECT_EQ(results.located[0].of, "position_of_sound");
    EXPECT_NEAR(results.located[0].position[0], 4000, 1000);
}

TEST(SrgsSpeechRecognition, IsSilentAboutWhatTheGrammarHasNot) {
    Stage stage{{says("en", "Where is the exit?")}};
    auto& recognition = stage.add("srgs_speech_recognition.xml");
    recognition.start({grammar()});
    stage.run(20);
    EXPECT_THAT(recognition.events("speech_recognition_finished"), SizeIs(1));
    EXPECT_THAT(recognition.events("speech_recognized"), IsEmpty());
}

TEST(SrgsSpeechRecognition, ListensInTheLanguagesAndAtThePlaceThatItIsTold) {
    Stage stage{{says("de", "A coffee please")}};
    auto& recognition = stage.add("srgs_speech_recognition.xml");
    recognition.start({grammar()});
    stage.run(20);
    EXPECT_THAT(recognition.events("speech_recognition_started"), IsEmpty()) << "the grammar is English";
    Stage again{{says("de", "A coffee please")}};
    auto& german = again.add("srgs_speech_recognition.xml");
    german.start({grammar(), texts("languages", {"de"}), texts("position_of_sound", {"4000, 4000, 0"})});
    again.run(20);
    EXPECT_THAT(german.events("speech_recognized"), SizeIs(1));
    Stage elsewhere{{says("en", "A coffee please")}};
    auto& turned_away = elsewhere.add("srgs_speech_recognition.xml");
    turned_away.start({grammar(), texts("position_of_sound", {"1000, 1000, 0"})});
    elsewhere.run(20);
    EXPECT_THAT(turned_away.words(), ElementsAre("completed OK, active"));
}

TEST(SrgsSpeechRecognition, TakesAGrammarInADataUri) {
    Stage stage{{says("en", "yes")}};
    auto& recognition = stage.add("srgs_speech_recognition.xml");
    recognition.start(
        {grammar("data:application/srgs+xml,<grammar%20xmlns='http://www.w3.org/2001/06/grammar' version='1.0' "
                 "xml:lang='en' root='a'><rule%20id='a'>yes</rule></grammar>")});
    stage.run(20);
    EXPECT_THAT(recognition.events("speech_recognized"), SizeIs(1));
}

TEST(SrgsSpeechRecognition, RefusesWhatItCannotListenFor) {
    Stage stage;
    auto& recognition = stage.add("srgs_speech_recognition.xml");
    auto const refusal = [&](ParameterList const& parameters) {
        return recognition.refusal("start", parameters).value_or("none");
    };
    EXPECT_THAT(refusal({}), HasSubstr("'grammar' is mandatory"));
    EXPECT_THAT(refusal({grammar("<grammar/>")}), HasSubstr("'grammar': grammar:1:1: "));
    EXPECT_THAT(refusal({grammar("http://example.org/drinks.grxml")}), HasSubstr("expected the document itself"));
    EXPECT_THAT(refusal({grammar("data:;base64,PGE+")}), HasSubstr("data URI without base64"));
    EXPECT_THAT(refusal({grammar("data:,%zz")}), HasSubstr("expected the document itself"));
    EXPECT_THAT(refusal({grammar(std::string(20'000, ' ') + "<a/>")}), HasSubstr("grammar:1:1"));
    EXPECT_THAT(refusal({grammar("<" + std::string(20'000, 'a'))}), HasSubstr("16384 bytes"));
    EXPECT_THAT(refusal({grammar(), text("active_rule", "#food")}), HasSubstr("'active_rule': the grammar has no rule '#food'"));
    EXPECT_THAT(refusal({grammar(), texts("languages", {"xx"})}), HasSubstr("'xx' cannot be recognized"));
    EXPECT_THAT(refusal({grammar(), texts("position_of_sound", {"there"})}), HasSubstr("'position_of_sound'"));
    EXPECT_EQ(refusal({grammar(), text("active_rule", "#order")}), "none");
    EXPECT_EQ(recognition.refusal("set_parameter", {text("active_rule", "#order")}), std::nullopt)
        << "the grammar may come later";
}

TEST(GenderIdentification, TellsTheCodeOfEverybodyOnce) {
    auto woman = at_the_robot("suzuki");
    woman.gender = Gender::female;
    Stage stage{{woman, visitor("guest", {does(Walk{at(4, 5)}), does(Face{at("robot")}), does(Wait{1000})}, 4)}};
    auto& identification = stage.add("person_gender_identification.xml");
    identification.start();
    stage.run(30);
    auto const events = identification.events("person_gender_identified");
    ASSERT_THAT(events, SizeIs(2));
    EXPECT_THAT(values(events[0].results, "person_ref"), ElementsAre("person-1"));
    EXPECT_EQ(value(events[0].results, "person_gender_code"), "2");
    EXPECT_EQ(codebook_of(events[0].results, "person_gender_code"), "urn:iso:std:iso:5218");
    EXPECT_EQ(value(events[1].results, "person_gender_code"), "0") << "nothing is known of the guest";
    ASSERT_THAT(events[0].results.located, SizeIs(1));
    EXPECT_EQ(events[0].results.located[0].ref, "person-1");
}

TEST(AgeRecognition, TellsBetweenWhichYearsSomebodyIs) {
    auto visitor_of_52 = at_the_robot("tanaka");
    visitor_of_52.age = 52;
    Stage stage{{visitor_of_52}};
    auto& recognition = stage.add("person_age_recognition.xml");
    recognition.start();
    stage.run(30);
    auto const events = recognition.events("person_age_recognized");
    ASSERT_THAT(events, SizeIs(1));
    auto const lower = to_int(value(events[0].results, "lower_age_limit")).value_or(-1);
    EXPECT_NEAR(lower, 46, 12);
    EXPECT_EQ(to_int(value(events[0].results, "upper_age_limit")), lower + 12);
    recognition.stop();
    recognition.start();
    stage.step();
    EXPECT_EQ(value(recognition.events("person_age_recognized").at(1).results, "lower_age_limit"), std::to_string(lower));
}

TEST(AgeRecognition, SaysNothingOfThoseWithoutAge) {
    Stage stage{{at_the_robot("tanaka")}};
    auto& recognition = stage.add("person_age_recognition.xml");
    recognition.start();
    stage.run(30);
    EXPECT_THAT(recognition.events("person_age_recognized"), IsEmpty());
}

TEST(StandIn, AnswersWithTheDefaultsOfItsProfile) {
    Stage stage;
    auto& wheelchair = stage.add("wheelchair_robot.xml");
    wheelchair.start();
    EXPECT_EQ(wheelchair.ended(), "OK, active");
    auto const status = wheelchair.query("wc_status_change");
    EXPECT_EQ(value(status, "brake_status"), "false");
    EXPECT_EQ(value(status, "position"), "0.0, 0.0");
    EXPECT_EQ(value(status, "nav_status"), "stopped");
    wheelchair.perform("brake", {boolean("status", true)});
    EXPECT_EQ(wheelchair.ended(), "OK");
}

TEST(Adapter, IsThatOfABasicComponentWhichTheProfileIncludes) {
    Stage stage{{at_the_robot("tanaka")}};
    auto& monitor = stage.add("person_monitor.xml");
    monitor.start();
    stage.run(20);
    EXPECT_THAT(monitor.events("person_detected"), SizeIs(2)) << "nobody, then one";
    EXPECT_EQ(monitor.component().description().ref.code, "person_monitor");
    EXPECT_EQ(monitor.component().description().ref.codebook_ref, "urn:x-rois:def:component:RoISGateway::PersonMonitor");
}

class AdaptersOf : public testing::Test {
protected:
    std::shared_ptr<Simulation> simulation_ = std::make_shared<Simulation>(
        reception_with_two_robots(), Scenario{.name = "", .faults = {}, .roles = {}, .round = {}, .arrivals = {}}, 7, 1.0);
    Adapters adapters_{simulation_, schemas()};
};

TEST_F(AdaptersOf, EachRobotMakeAComponent) {
    std::vector<std::string> refs;
    for (auto const& component : adapters_.components(shipped_profile("wheelchair_robot.xml"), own_profiles()))
        refs.push_back(component->description().ref.code);
    EXPECT_THAT(refs, ElementsAre("wheelchair_robot", "robot2.wheelchair_robot"));
}

TEST_F(AdaptersOf, NothingAreNone) {
    ComponentProfile profile;
    profile.object.identifier = "urn:lamp";
    EXPECT_THAT(adapters_.components(profile, {}), IsEmpty());
    profile.object.meta_data = "urn:x-rois:def:adapter:simulation::lamp";
    EXPECT_THAT([&] { adapters_.components(profile, {}); },
                testing::ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("no adapter 'lamp'"), HasSubstr("stand_in"))));
}

TEST(ComponentName, IsThatOfTheProfileOrOfItsUrn) {
    ComponentProfile profile;
    profile.object.identifier = "urn:x-rois:def:component:ATR::PersonMonitor2";
    EXPECT_EQ(component_name(profile), "person_monitor2");
    profile.object.name = "Person monitor";
    EXPECT_EQ(component_name(profile), "person_monitor2");
    profile.object.name = "monitor-1";
    EXPECT_EQ(component_name(profile), "monitor-1");
    profile.object = {.identifier = "urn:a:3D.Scanner", .code_space = {}, .name = {}, .description = {}, .meta_data = {}};
    EXPECT_EQ(component_name(profile), "_3_d_scanner");
    for (auto const* name : {"受付", "größe", "Café"}) {
        profile.object.name = name;
        EXPECT_EQ(component_name(profile), name);
    }
    for (auto const* no_name : {"受付　案内", "a b", "a×b", "a.b"}) {
        profile.object.name = no_name;
        EXPECT_EQ(component_name(profile), "_3_d_scanner") << no_name;
    }
    profile.object = {.identifier = "urn:a::受付Robot:案内 2", .code_space = {}, .name = {}, .description = {}, .meta_data = {}};
    EXPECT_EQ(component_name(profile), "案内_2");
}

}  // namespace
}  // namespace rois::simulation::stage
