// Detection, localization, identification and recognition on a body of fakes.
#include <gmock/gmock.h>

#include "basic/adapters/adapters.hpp"
#include "basic/base/codebooks.hpp"
#include "basic/fake_body.hpp"

namespace rois::basic::stage {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

Sighting sighting(std::string ref, double x, double y, Metres height = 0) {
    return {EntityId{3}, std::move(ref), {Point{x, y}, from_degrees(90)}, height, Covariance::Identity() * 1e-4};
}

// A component that counts, with its sense.
struct Counting {
    std::string ref;
    std::string event;
    Sense sense;
};
Counting const people{"person", "person", Sense::people}, faces{"face", "face", Sense::faces},
    sounds{"sound", "sound", Sense::sounds};

class SensesOfABody : public FakeRobot, public testing::WithParamInterface<Counting> {};

TEST_P(SensesOfABody, DetectionReportsChangesOfTheNumber) {
    auto const& [ref, event, sense] = GetParam();
    auto& detection = (*this)[ref + "_detection"];
    body->senses.seen[sense] = {sighting(ref + "-1", 1, 1)};
    step();
    EXPECT_THAT(detection.log(), IsEmpty()) << "not started";
    detection.start();
    step();
    step();
    body->senses.seen[sense].clear();
    step();
    auto const events = detection.events(event + "_detected");
    ASSERT_THAT(events, SizeIs(2));
    EXPECT_EQ(value(events[0].results, "number"), "1");
    EXPECT_EQ(value(events[1].results, "number"), "0");
    EXPECT_EQ(detection.stop(), Halted::confirmed);
    body->senses.seen[sense] = {sighting(ref + "-1", 1, 1)};
    step();
    EXPECT_THAT(detection.events(event + "_detected"), SizeIs(2));
}

TEST_P(SensesOfABody, LocalizationReportsMovement) {
    auto const& [ref, event, sense] = GetParam();
    auto& localization = (*this)[ref + "_localization"];
    body->senses.seen[sense] = {sighting(ref + "-1", 1, 2, 1.5)};
    localization.start();
    step();
    auto const first = localization.events(event + "_localized").at(0).results;
    EXPECT_EQ(value(first, ref + "_ref"), ref + "-1");
    EXPECT_EQ(codebook_of(first, ref + "_ref"), codebook::track);
    EXPECT_EQ(value(first, "position_data"), "1000, 2000, 90");
    EXPECT_EQ(first.located.at(0).position.at(2), 1500);
    EXPECT_EQ(first.located.at(0).orientation.empty(), sense == Sense::sounds) << "a sound has only a direction";
    for (int i = 0; i < 5; ++i) step(WorldTime{300});
    EXPECT_THAT(localization.events(event + "_localized"), SizeIs(1)) << "nothing has moved";
    localization.suspend();
    body->senses.seen[sense] = {sighting(ref + "-1", 4, 2)};
    step(WorldTime{300});
    EXPECT_THAT(localization.events(event + "_localized"), SizeIs(1));
    localization.resume();
    step(WorldTime{300});
    EXPECT_THAT(localization.events(event + "_localized"), SizeIs(2));
}

TEST_P(SensesOfABody, LocalizationRefusesAThresholdWithinTheNoise) {
    auto const ref = GetParam().ref + "_localization";
    EXPECT_THAT(refusal(ref, "set_parameter", {integer("detection_threshold", 49)}), HasSubstr("minimum of 50 mm"));
    EXPECT_EQ(refusal(ref, "set_parameter", {integer("detection_threshold", 50)}), "accepted");
    EXPECT_THAT(refusal(ref, "set_parameter", {integer("minimum_interval", -1)}), HasSubstr("must be 0 or more, not -1"));
}

INSTANTIATE_TEST_SUITE_P(Each, SensesOfABody, testing::Values(people, faces, sounds),
                         [](auto const& kind) { return kind.param.ref; });

class RecognitionOfABody : public FakeRobot {
protected:
    RecognitionOfABody() {
        body->senses.names["person-3"] = EntityId{3};
        body->senses.seen[Sense::people] = {sighting("person-3", 1, 2)};
    }

    static ParameterList speech_parameters(std::string grammar = "") { return {text("grammar", std::move(grammar))}; }
};

TEST_F(RecognitionOfABody, IdentifiesAPersonOnceWhileTheyAreTracked) {
    auto& identification = (*this)["person_identification"];
    identification.start();
    body->senses.people = {{.who = EntityId{3}, .track = "person-3", .id = {}}};
    step();
    EXPECT_THAT(identification.events("person_identified"), IsEmpty()) << "a stranger";
    body->senses.people[0].id = "tanaka";
    step();
    step();
    auto const events = identification.events("person_identified");
    ASSERT_THAT(events, SizeIs(1));
    EXPECT_EQ(value(events[0].results, "person_ref"), "tanaka");
    EXPECT_EQ(codebook_of(events[0].results, "person_ref"), codebook::visitor);
    EXPECT_EQ(events[0].results.located.at(0).ref, "tanaka");
    body->senses.names.clear();
    body->senses.people.clear();
    step();
    body->senses.names["person-4"] = EntityId{3};
    body->senses.people = {{.who = EntityId{3}, .track = "person-4", .id = "tanaka"}};
    step();
    EXPECT_THAT(identification.events("person_identified"), SizeIs(2)) << "a new track";
}

TEST_F(RecognitionOfABody, ReportsGesturesInView) {
    auto& gestures = (*this)["gesture_recognition"];
    body->senses.see_gesture("wave");
    gestures.start();
    step();
    EXPECT_THAT(gestures.events("gesture_recognized"), IsEmpty()) << "made before the start";
    body->senses.see_gesture("bow");
    step();
    step();
    gestures.suspend();
    body->senses.see_gesture("nod");
    gestures.resume();
    body->senses.see_gesture("clap");
    step();
    std::vector<std::string> seen;
    for (auto const& event : gestures.events("gesture_recognized")) seen.push_back(value(event.results, "gesture_ref"));
    EXPECT_THAT(seen, ElementsAre("bow", "clap"));
}

TEST_F(RecognitionOfABody, ReportsSpeech) {
    auto& speech = (*this)["speech_recognition"];
    speech.start(speech_parameters());
    body->senses.hear("Good morning.");
    step();
    EXPECT_THAT(speech.words(),
                ElementsAre("completed OK, active", "speech_input_started", "speech_input_finished", "speech_recognized"));
    EXPECT_EQ(value(speech.log().back().results, "recognized_text"), "Good morning.");
    speech.forget();
    body->senses.hear("Guten Tag.", "de");
    body->senses.hear({.kind = SpeechEvent::Kind::began, .speaker = EntityId{6}});
    body->senses.hear({.kind = SpeechEvent::Kind::lost, .speaker = EntityId{6}});
    body->senses.hear({.kind = SpeechEvent::Kind::ended, .speaker = EntityId{7}, .text = "the end", .language = "en"});
    step();
    EXPECT_THAT(speech.words(),
                ElementsAre("speech_input_started", "speech_input_finished", "speech_input_started", "speech_input_finished"))
        << "another language, lost speech, and the end of speech that began out of range";
}

TEST_F(RecognitionOfABody, DoesNotReportSpeechThatASuspensionCut) {
    auto& speech = (*this)["speech_recognition"];
    speech.start(speech_parameters());
    body->senses.hear({.kind = SpeechEvent::Kind::began, .speaker = EntityId{6}});
    step();
    speech.suspend();
    body->senses.hear("Missed.");
    speech.resume();
    body->senses.hear({.kind = SpeechEvent::Kind::ended, .speaker = EntityId{6}, .text = "Cut.", .language = "en"});
    step();
    EXPECT_THAT(speech.words(), ElementsAre("completed OK, active", "speech_input_started", "speech_input_finished"));
}

TEST_F(RecognitionOfABody, ListensForAGrammar) {
    auto& speech = (*this)["speech_recognition"];
    speech.start(speech_parameters("yes | no"));
    body->senses.hear("Maybe!");
    body->senses.hear("Yes!");
    step();
    ASSERT_THAT(speech.events("speech_recognized"), SizeIs(1));
    EXPECT_EQ(value(speech.events("speech_recognized")[0].results, "recognized_text"), "yes");
    EXPECT_THAT(refusal("speech_recognition", "set_parameter", speech_parameters("a = ; b")), testing::Ne("accepted"));
    EXPECT_THAT(refusal("speech_recognition", "set_parameter", {texts("languages", {"jp"})}), HasSubstr("'jp'"));
}

// The examples of Annex C.
class ExamplesOnABody : public RecognitionOfABody {
protected:
    Operated& example(std::string const& name) {
        Adapters const adapters{{.bodies = {body}, .media = nullptr}, schemas()};
        auto& made = add(std::move(adapters.components(shipped_profile(name + ".xml"), own_profiles()).at(0)));
        step();
        return made;
    }
};

TEST_F(ExamplesOnABody, ReportGenderAndAge) {
    auto& gender = example("person_gender_identification");
    auto& age = example("person_age_recognition");
    gender.start();
    age.start();
    body->senses.people = {
        {.who = EntityId{3}, .track = "person-3", .id = {}, .gender = Gender::female, .age = AgeRange{30, 42}}};
    step();
    step();
    ASSERT_THAT(gender.events("person_gender_identified"), SizeIs(1));
    EXPECT_EQ(value(gender.events("person_gender_identified")[0].results, "person_gender_code"), "2");
    ASSERT_THAT(age.events("person_age_recognized"), SizeIs(1));
    EXPECT_EQ(value(age.events("person_age_recognized")[0].results, "lower_age_limit"), "30");
    EXPECT_EQ(value(age.events("person_age_recognized")[0].results, "upper_age_limit"), "42");
    EXPECT_EQ(value(age.events("person_age_recognized")[0].results, "person_ref"), "person-3");
}

TEST_F(ExamplesOnABody, RecognizeAGrammarOfSrgsAtAPlace) {
    auto& speech = example("srgs_speech_recognition");
    std::string const grammar =
        "<grammar version='1.0' xml:lang='en-US' root='answer' mode='voice' "
        "xmlns='http://www.w3.org/2001/06/grammar'><rule id='answer'>yes</rule></grammar>";
    speech.start({text("grammar", grammar), positions("position_of_sound", {"4000, 0"}, "")});
    body->senses.hear("Yes.");
    step();
    EXPECT_THAT(speech.events("speech_recognized"), IsEmpty()) << "too far from the place";
    speech.set_parameter({positions("position_of_sound", {"1000, 500"}, "")});
    body->senses.hear("Yes.");
    step();
    ASSERT_THAT(speech.events("speech_recognized"), SizeIs(1));
    EXPECT_EQ(speech.events("speech_recognized")[0].results.located.at(0).ref, "sound-5");
    EXPECT_THAT(speech.refusal("start", {text("grammar", "<grammar/>")}).value_or(""), HasSubstr("'grammar'"));
}

TEST_F(ExamplesOnABody, BrakeAWheelchair) {
    auto& wheelchair = example("wheelchair_robot");
    body->wheels.report.stands = false;
    wheelchair.perform("brake", {boolean("status", true)});
    EXPECT_TRUE(body->wheels.report.brakes);
    EXPECT_EQ(wheelchair.words().back(), "started");
    body->wheels.report.stands = true;
    step();
    EXPECT_EQ(wheelchair.ended(), "OK");
    EXPECT_EQ(value(wheelchair.query("wc_status_change"), "wc_status"), "brakes");
    wheelchair.set_parameter({text("preferred_max_speed", "500")});
    EXPECT_EQ(body->wheels.limit, 0.5);
}

}  // namespace
}  // namespace rois::basic::stage
