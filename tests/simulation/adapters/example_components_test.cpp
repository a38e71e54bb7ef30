// Components of user-defined profiles: the examples of Annex C, and the stand-in.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "basic/adapters/adapters.hpp"
#include "basic/base/component_names.hpp"
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

TEST(SrgsSpeechRecognition, ReportsAllHypotheses) {
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

TEST(SrgsSpeechRecognition, IgnoresSpeechThatIsNotInTheGrammar) {
    Stage stage{{says("en", "Where is the exit?")}};
    auto& recognition = stage.add("srgs_speech_recognition.xml");
    recognition.start({grammar()});
    stage.run(20);
    EXPECT_THAT(recognition.events("speech_recognition_finished"), SizeIs(1));
    EXPECT_THAT(recognition.events("speech_recognized"), IsEmpty());
}

TEST(SrgsSpeechRecognition, ObeysLanguagesAndPositionOfSound) {
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

TEST(SrgsSpeechRecognition, AcceptsAGrammarInADataUri) {
    Stage stage{{says("en", "yes")}};
    auto& recognition = stage.add("srgs_speech_recognition.xml");
    recognition.start(
        {grammar("data:application/srgs+xml,<grammar%20xmlns='http://www.w3.org/2001/06/grammar' version='1.0' "
                 "xml:lang='en' root='a'><rule%20id='a'>yes</rule></grammar>")});
    stage.run(20);
    EXPECT_THAT(recognition.events("speech_recognized"), SizeIs(1));
}

TEST(SrgsSpeechRecognition, RefusesInvalidParameters) {
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

TEST(GenderIdentification, ReportsTheCodeOfEachPersonOnce) {
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
    EXPECT_EQ(value(events[1].results, "person_gender_code"), "0") << "the guest's gender is unknown";
    ASSERT_THAT(events[0].results.located, SizeIs(1));
    EXPECT_EQ(events[0].results.located[0].ref, "person-1");
}

TEST(AgeRecognition, ReportsTheLimitsOfTheAge) {
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

TEST(AgeRecognition, IgnoresPeopleWithoutAge) {
    Stage stage{{at_the_robot("tanaka")}};
    auto& recognition = stage.add("person_age_recognition.xml");
    recognition.start();
    stage.run(30);
    EXPECT_THAT(recognition.events("person_age_recognized"), IsEmpty());
}

TEST(StandIn, AnswersWithTheDefaultsOfItsProfile) {
    ParameterProfile const colour{.name = "colour", .data_type_ref = coded("string"), .default_value = "red", .description = {}};
    ComponentProfile profile;
    profile.object.identifier = "urn:test::Lamp";
    profile.object.meta_data = "urn:x-rois:def:adapter:simulation::stand_in";
    profile.messages = {{.kind = MessageKind::command, .name = "blink", .results = {colour}, .arguments = {}, .timeout = {}},
                        {.kind = MessageKind::query, .name = "light", .results = {colour}, .arguments = {}, .timeout = {}}};
    Stage stage;
    auto& lamp = stage.add(profile);
    lamp.start();
    EXPECT_EQ(lamp.ended(), "OK, active");
    EXPECT_EQ(value(lamp.query("light"), "colour"), "red");
    lamp.perform("blink", {});
    EXPECT_EQ(lamp.ended(), "OK");
    EXPECT_EQ(value(lamp.results(), "colour"), "red");
}

Parameter number(std::string name, std::string value) { return {std::move(name), coded("double"), {std::move(value)}}; }

struct Wheelchair : testing::Test {
    Stage stage;
    Operated& wheelchair = stage.add("wheelchair_robot.xml");

    Wheelchair() { stage.step(); }

    Parameter target(std::string where) { return texts("target_position", {std::move(where)}); }
    void brake(bool on) { wheelchair.perform("brake", {boolean("status", on)}); }
    std::string wc() { return value(wheelchair.query("wc_status_change"), "wc_status"); }

    // Returns "running false false running": wc_status, brakes, pause, navigation.
    static std::string words(Results const& state) {
        return value(state, "wc_status") + " " + value(state, "brake_status") + " " + value(state, "pause_status") + " " +
               value(state, "nav_status");
    }
    std::string state() { return words(wheelchair.query("wc_status_change")); }
    std::vector<std::string> reported() {
        std::vector<std::string> all;
        for (auto const& event : wheelchair.events("wc_status_change")) all.push_back(words(event.results));
        wheelchair.forget();
        return all;
    }
};

TEST_F(Wheelchair, GoesToItsTargetAndReportsEachChangeOfItsState) {
    EXPECT_EQ(state(), "stopped false false stopped");
    EXPECT_EQ(value(wheelchair.query("wc_status_change"), "position"), "2000.0, 4000.0");
    wheelchair.start({target("5000, 4000")});
    EXPECT_EQ(stage.outcome("wheelchair_robot"), "OK");
    EXPECT_THAT(wheelchair.events("reached_target"), SizeIs(1));
    auto const position = value(wheelchair.query("wc_status_change"), "position");
    EXPECT_NEAR(to_double(position.substr(0, position.find(','))).value_or(0), 5000, 60);
    stage.run(1);
    EXPECT_THAT(reported(), ElementsAre("running false false running", "stopped false false stopped"));
}

TEST_F(Wheelchair, BrakesStopItAndHoldItUntilTheyAreOff) {
    wheelchair.allow_any_command();
    wheelchair.start({target("9000, 4000")});
    stage.run(3);
    ASSERT_GT(stage.robot_state().twist.linear, 0.5);
    wheelchair.forget();
    brake(true);
    EXPECT_EQ(state(), "brakes true false running");
    ASSERT_TRUE(stage.run_until([&] { return wheelchair.ended().has_value(); }, 3));
    EXPECT_EQ(wheelchair.ended(), "OK");
    EXPECT_EQ(stage.robot_state().twist.linear, 0) << "completes when the wheelchair stands";
    auto const held = stage.robot().position;
    EXPECT_EQ(wheelchair.status(), ComponentStatus::warning);
    stage.run(10);
    EXPECT_EQ(stage.robot().position, held);
    brake(false);
    EXPECT_EQ(wheelchair.ended(), "OK");
    EXPECT_EQ(state(), "running false false running");
    ASSERT_TRUE(stage.run_until([&] { return stage.robot().position.x() > 8.9; }));
    stage.run(3);
    EXPECT_THAT(reported(),
                ElementsAre("brakes true false running", "running false false running", "stopped false false stopped"));
}

TEST_F(Wheelchair, BrakesHoldItForAllComponents) {
    brake(true);
    EXPECT_EQ(wheelchair.ended(), "OK") << "stands already";
    stage["move"].start({integers("line", "1000 0")});
    stage.run(5);
    EXPECT_EQ(stage.robot().position, Point(2, 4));
    EXPECT_EQ(stage["move"].status(), ComponentStatus::warning);
    EXPECT_EQ(stage.outcome("move"), "ERROR");
    EXPECT_EQ(stage["move"].reason(), "the brakes of the robot are on");
    stage["navigation"].start({target("5000, 4000")});
    EXPECT_EQ(stage.outcome("navigation"), "ERROR");
    EXPECT_EQ(stage["navigation"].reason(), "the brakes of the robot are on");
    EXPECT_EQ(stage.robot().position, Point(2, 4));
    brake(false);
    stage["move"].start({integers("line", "1000 0")});
    EXPECT_EQ(stage.outcome("move"), "OK");
}

TEST_F(Wheelchair, BrakeIsAbortedWhenTheBrakesAreReleasedTooSoon) {
    wheelchair.start({target("9000, 4000")});
    stage.run(3);
    wheelchair.forget();
    brake(true);
    wheelchair.allow_any_command();
    brake(false);
    EXPECT_THAT(wheelchair.words(), ElementsAre("started", "completed ABORT", "started", "completed OK"));
}

TEST_F(Wheelchair, ReportsThatItIsPaused) {
    wheelchair.start({target("9000, 4000")});
    stage.run(2);
    wheelchair.suspend();
    EXPECT_EQ(state(), "paused false true running");
    wheelchair.resume();
    EXPECT_EQ(state(), "running false false running");
    wheelchair.stop();
    stage.run(3);
    EXPECT_EQ(state(), "stopped false false stopped");
}

TEST_F(Wheelchair, ReportsMotionsOfOtherComponents) {
    stage["move"].start({integers("line", "2000 0")});
    stage.run(1);
    EXPECT_EQ(state(), "running false false running");
    stage["move"].suspend();
    EXPECT_EQ(state(), "paused false true running");
}

TEST_F(Wheelchair, ReportsThatNoWayLeadsToItsTarget) {
    for (auto const* driver : {"wheelchair_robot", "navigation"})
        for (auto const* nowhere : {"11000, 7000", "-5000, 0", "100000, 0"}) {  // behind walls, outside
            wheelchair.forget();
            stage[driver].start({target(nowhere)});
            EXPECT_EQ(stage.outcome(driver), "ERROR");
            stage.run(2);
            EXPECT_EQ(state(), "path_error false false stopped") << driver << " to " << nowhere;
            auto const events = reported();
            ASSERT_FALSE(events.empty()) << driver << " to " << nowhere;
            EXPECT_EQ(events.back(), "path_error false false stopped") << driver << " to " << nowhere;
            stage[driver].start({target("3000, 4000")});
            EXPECT_EQ(stage.outcome(driver), "OK");
            stage.run(1);
            EXPECT_EQ(wc(), "stopped");
        }
}

TEST_F(Wheelchair, KeepsItsPathErrorUntilTheNextMotionOfAnyComponent) {
    stage["navigation"].start({target("-5000, 0")});
    EXPECT_EQ(stage.outcome("navigation"), "ERROR");
    stage["move"].start({integers("line", "300 0")});
    stage.step();
    EXPECT_EQ(wc(), "running");
    EXPECT_EQ(stage.outcome("move"), "OK");
    stage.run(1);
    EXPECT_EQ(wc(), "stopped");
}

TEST(WheelchairAmongPeople, ReportsAnObstacle) {
    Stage stage{{visitor("guest", {does(Walk{at(5, 4)}), does(Wait{1000})})}};
    auto& wheelchair = stage.add("wheelchair_robot.xml");
    stage.run(12);
    stage["move"].start({integers("line", "6000 0")});
    EXPECT_TRUE(stage.run_until([&] { return value(wheelchair.query("wc_status_change"), "wc_status") == "obstacle"; }));
}

TEST_F(Wheelchair, ObeysItsPreferredSpeed) {
    auto const fastest = [&] {
        double most = 0;
        stage.run_until([&] {
            most = std::max(most, stage.robot_state().twist.linear);
            return wheelchair.ended().has_value();
        });
        return most;
    };
    wheelchair.start({target("6000, 4000"), number("preferred_max_speed", "300")});
    EXPECT_NEAR(fastest(), 0.3, 0.001);
    wheelchair.start({target("2000, 4000"), number("preferred_max_speed", "99999")});
    EXPECT_NEAR(fastest(), 0.9, 0.001) << "not faster than the robot's limit";
    wheelchair.set_parameter({number("preferred_max_speed", "200.5")});
    stage["move"].start({integers("line", "1000 0")});
    double most = 0;
    while (!stage["move"].ended()) {
        stage.step();
        most = std::max(most, std::abs(stage.robot_state().twist.linear));
    }
    EXPECT_NEAR(most, 0.2005, 0.001) << "for motions of all components";
}

TEST_F(Wheelchair, GoesToThePlaceOfItsTag) {
    wheelchair.start({text("navigation_mode", "Tag"), text("behaviour_tag", "desk")});
    EXPECT_EQ(stage.outcome("wheelchair_robot"), "OK");
    EXPECT_LT(distance(stage.robot().position, Point(3, 2)), 0.1);
    EXPECT_EQ(value(wheelchair.events("reached_target").at(0).results, "target"), "desk");
}

TEST_F(Wheelchair, RefusesInvalidParameters) {
    auto const refusal = [&](ParameterList const& parameters) {
        return wheelchair.refusal("start", parameters).value_or("fine");
    };
    EXPECT_THAT(refusal({}), HasSubstr("'target_position' is mandatory"));
    EXPECT_THAT(refusal({text("navigation_mode", "Tag")}), HasSubstr("'behaviour_tag' is mandatory"));
    EXPECT_THAT(refusal({target("desk"), text("navigation_mode", "tag")}), HasSubstr("must be 'Location' or 'Tag', not 'tag'"));
    EXPECT_THAT(refusal({target("desk"), text("behaviour_tag", "moon")}),
                HasSubstr("'moon' is not one of the places entrance, exit, desk"));
    for (auto const* speed : {"0", "-1", "NaN", "-INF"})
        EXPECT_THAT(refusal({target("desk"), number("preferred_max_speed", speed)}), HasSubstr("more than 0 mm/s")) << speed;
    EXPECT_EQ(refusal({target("desk"), number("preferred_max_speed", "0.5"), text("behaviour_tag", "exit")}), "fine");
}

TEST(Adapter, ComesFromAnIncludedBasicComponent) {
    Stage stage{{at_the_robot("tanaka")}};
    auto& monitor = stage.add("person_monitor.xml");
    monitor.start();
    stage.run(20);
    EXPECT_THAT(monitor.events("person_detected"), SizeIs(2)) << "zero, then one";
    EXPECT_EQ(monitor.description().ref.code, "person_monitor");
    EXPECT_EQ(monitor.description().ref.codebook_ref, "urn:x-rois:def:component:RoISGateway::PersonMonitor");
}

class AdaptersOf : public testing::Test {
protected:
    std::shared_ptr<Simulation> simulation_ = std::make_shared<Simulation>(
        reception_with_two_robots(), Scenario{.name = "", .faults = {}, .roles = {}, .round = {}, .arrivals = {}}, 7, 1.0);
    Adapters adapters_{robots(simulation_, nullptr), schemas()};
};

TEST_F(AdaptersOf, EachRobotMakeOneComponent) {
    std::vector<std::string> refs;
    for (auto const& component : adapters_.components(shipped_profile("wheelchair_robot.xml"), own_profiles()))
        refs.push_back(component->description().ref.code);
    EXPECT_THAT(refs, ElementsAre("wheelchair_robot", "robot2.wheelchair_robot"));
}

TEST_F(AdaptersOf, AProfileWithoutAdapterMakeNoComponents) {
    ComponentProfile profile;
    profile.object.identifier = "urn:lamp";
    EXPECT_THAT(adapters_.components(profile, {}), IsEmpty());
    profile.object.meta_data = "urn:x-rois:def:adapter:simulation::lamp";
    EXPECT_THAT([&] { adapters_.components(profile, {}); },
                testing::ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("unknown adapter 'lamp'"), HasSubstr("stand_in"))));
}

TEST_F(AdaptersOf, StreamingComponentsNeedMedia) {
    ComponentProfile profile;
    profile.object.identifier = "urn:baby_phone";
    profile.object.meta_data = "urn:x-rois:def:adapter:simulation::audio_streaming";
    EXPECT_THAT([&] { adapters_.components(profile, {}); },
                testing::ThrowsMessage<std::runtime_error>(HasSubstr("unknown adapter 'audio_streaming'")));
    Adapters const with_media{robots(simulation_, std::make_shared<FakeMedia>()), schemas()};
    EXPECT_THAT(with_media.components(profile, {}), SizeIs(2));
}

TEST(ComponentName, ComesFromTheProfileOrItsUrn) {
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
