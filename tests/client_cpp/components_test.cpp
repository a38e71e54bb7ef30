// The classes of all 17 components, against the simulated hall.
#include <cmath>
#include <stdexcept>
#include <thread>

#include "client_cpp/rig.hpp"

namespace rois::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::SizeIs;
using testing::StartsWith;

// A hall with a known visitor who waves and talks repeatedly, and a robot that streams.
GatewayProcess& lively_hall() {
    static GatewayProcess hall{
        {"--scenario", ROIS_SOURCE_DIR "/tests/server/data/lively_visitor.xml", "--sim-speed", "20", "--media", "127.0.0.1:0"}};
    return hall;
}

// A hall without visitors.
GatewayProcess& empty_hall() {
    static GatewayProcess hall{{"--scenario", ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml", "--sim-speed", "20"}};
    return hall;
}

class TheFacades : public testing::Test {
protected:
    explicit TheFacades(GatewayProcess& hall = lively_hall()) : robot{quick(hall.url())} {}

    // Waits for the next event that `is_it` accepts. The component must be started.
    template <class E>
    E next(Events<E>& events, std::function<bool(E const&)> const& is_it) {
        while (true) {
            auto event = robot(events.next(20s));
            if (!event) throw std::runtime_error{"no such event: " + std::string{E::name}};
            if (is_it(*event)) return *event;
        }
    }

    // Binds any component of this type, subscribes, starts it, and returns the first event that `is_it` accepts.
    template <class Facade, class E>
    E first(Task<Events<E>> (Facade::*subscribe)(QueryExpression) const, std::function<bool(E const&)> const& is_it) {
        auto const component = robot.bind_any<Facade>();
        auto events = robot((component.*subscribe)({}));
        EXPECT_EQ(robot(component.start()), CompletedStatus::ok);
        auto const event = next(events, is_it);
        EXPECT_GT(event.timestamp, *to_utc("2024-01-01T00:00:00Z"));
        robot(component.release());
        return event;
    }

    template <class Facade>
    void expect_stream(char const* encoding) {
        auto const streaming = robot.bind_any<Facade>();
        auto notified = robot(streaming.notify_stream_status());
        expect_ok(streaming.set(StreamParameters().with_transport_parameters("http")));
        auto const set = robot(streaming.parameters());
        EXPECT_EQ(set.transport_parameters, "http");
        EXPECT_THAT(set.available_encodings, HasSubstr(encoding));
        EXPECT_THAT(set.available_transports, HasSubstr("http"));
        auto const stream = robot(streaming.connect_stream());
        EXPECT_THAT(stream.transport_parameters, StartsWith("http://127.0.0.1:"));
        EXPECT_THAT(stream.encoding_parameters, StartsWith(encoding));
        EXPECT_EQ(robot(streaming.get_stream_status()), StreamStatus::not_running);
        expect_ok(streaming.suspend_stream(stream.stream_id));
        expect_ok(streaming.resume_stream(stream.stream_id));
        expect_ok(streaming.disconnect_stream(stream.stream_id));
        for (auto const status : {StreamStatus::suspended, StreamStatus::resumed, StreamStatus::not_connected})
            next<StreamStatusNotified>(notified, [&](StreamStatusNotified const& event) {
                return event.stream_id == stream.stream_id && event.status == status;
            });
        EXPECT_EQ(robot(streaming.get_stream_status()), StreamStatus::not_connected);
        EXPECT_THROW(robot(streaming.suspend_stream(stream.stream_id)), Error);
    }

    void expect_ok(Task<Completion> command) { EXPECT_EQ(robot(std::move(command)), CompletedStatus::ok); }

    Blocking robot;
};

class TheFacadesThatMove : public TheFacades {
protected:
    TheFacadesThatMove() : TheFacades{empty_hall()} {}
};

auto const within_the_hall = [](Sighting const& seen) {
    return seen.pose.x >= 0_mm && seen.pose.x <= 20_m && seen.pose.y >= 0_mm && seen.pose.y <= 12_m &&
           seen.pose.crs == "urn:x-rois:def:crs:simulation::hall";
};

TEST_F(TheFacades, ReportRobotPositionsAndEngineStatus) {
    SystemInformation const system{robot.client().component("system_information")};
    auto const position = robot(system.robot_position());
    ASSERT_THAT(position.robots, SizeIs(1));
    EXPECT_EQ(position.robots[0].ref.code, "robot1");
    EXPECT_TRUE(within_the_hall(position.robots[0]));
    EXPECT_LT(distance(position.robots[0].pose, Pose{6_m, 6_m}), 200_mm);
    EXPECT_EQ(robot(system.engine_status()).status, ComponentStatus::ready);
    EXPECT_LE(robot(system.engine_status()).operable_time.value(), position.timestamp);
}

// The status has the engine's reason, for all kinds of commands.
TEST_F(TheFacadesThatMove, ReportWhyACommandFailed) {
    auto const navigation = robot.bind<Navigation>("navigation");
    auto const unreachable = robot(navigation.go_to(Pose{-5_m, -5_m}));
    EXPECT_EQ(unreachable, CompletedStatus::error);
    EXPECT_THAT(unreachable.reason, testing::Not(testing::IsEmpty()));
    EXPECT_EQ(to_text(unreachable), "ERROR: " + unreachable.reason);
    auto const late = robot(navigation.go_to("desk", 1ms));
    EXPECT_EQ(late, CompletedStatus::timeout);
    EXPECT_THAT(late.reason, testing::Not(testing::IsEmpty()));
    EXPECT_THAT(robot(navigation.resume()).reason, testing::Not(testing::IsEmpty()));
    auto const good = robot(navigation.go_to(Pose{6_m, 6_m, 0_deg}, 0ms));
    EXPECT_EQ(to_text(good), "OK");
    auto going = begun(robot.client(), navigation.go_to(Pose{9_m, 6_m, 0_deg}));
    EXPECT_EQ(robot(navigation.stop()), CompletedStatus::ok);
    auto const stopped = going.get();
    EXPECT_EQ(stopped, CompletedStatus::abort);
    EXPECT_THAT(stopped.reason, testing::Not(testing::IsEmpty()));
}

TEST_F(TheFacadesThatMove, ReportACommandThatTheEndOfTheConnectionEnded) {
    auto const follow = robot.bind<Follow>("follow");
    auto following = begun(robot.client(), follow.start({reference("target_object_ref", "nobody"), integer("distance", 500)}));
    robot.call(Disconnect{});
    auto const ended = following.get();
    EXPECT_EQ(ended, CompletedStatus::abort);
    EXPECT_THAT(ended.reason, HasSubstr("the connection is closed"));
}

TEST_F(TheFacades, DetectPeopleFacesAndSounds) {
    first<PersonDetection, PersonDetected>(&PersonDetection::person_detected, [](auto& event) { return event.number == 1; });
    first<FaceDetection, FaceDetected>(&FaceDetection::face_detected, [](auto& event) { return event.number == 1; });
    first<SoundDetection, SoundDetected>(&SoundDetection::sound_detected, [](auto& event) { return event.number == 1; });
}

TEST_F(TheFacades, LocalizePeopleFacesAndSounds) {
    auto const is_one = [](std::vector<Sighting> const& seen, char const* name) {
        return seen.size() == 1 && seen[0].ref.code.starts_with(name) && within_the_hall(seen[0]);
    };
    first<PersonLocalization, PersonLocalized>(&PersonLocalization::person_localized,
                                               [&](auto& event) { return is_one(event.people, "person-"); });
    first<FaceLocalization, FaceLocalized>(&FaceLocalization::face_localized,
                                           [&](auto& event) { return is_one(event.faces, "face-"); });
    first<SoundLocalization, SoundLocalized>(&SoundLocalization::sound_localized,
                                             [&](auto& event) { return is_one(event.sounds, "sound-"); });
    auto const localization = robot.bind<PersonLocalization>("person_localization");
    expect_ok(localization.set(LocalizationParameters().with_detection_threshold(0.5_m).with_minimum_interval(40ms)));
    auto const set = robot(localization.parameters());
    EXPECT_EQ(set.detection_threshold, 500_mm);
    EXPECT_EQ(set.minimum_interval, 40ms);
}

TEST_F(TheFacades, IdentifyPeople) {
    auto const event = first<PersonIdentification, PersonIdentified>(&PersonIdentification::person_identified,
                                                                     [](auto& candidate) { return !candidate.people.empty(); });
    EXPECT_THAT(event.people, ElementsAre(Field(&Identifier::code, "tanaka")));
    EXPECT_EQ(event.people[0].codebook_ref, "urn:x-rois:def:codebook:simulation::visitor");
}

TEST_F(TheFacades, RecognizeSpeech) {
    auto const recognition = robot.bind<SpeechRecognition>("speech_recognition");
    expect_ok(recognition.set(
        SpeechRecognitionParameters().with_language("en").with_grammar("greeting = hello | goodbye").with_rule("greeting")));
    auto const set = robot(recognition.parameters());
    EXPECT_THAT(set.languages, ElementsAre("en"));
    EXPECT_THAT(set.grammar.value_or(""), HasSubstr("goodbye"));
    EXPECT_EQ(set.rule, "greeting");
    EXPECT_THAT(set.recognizable_languages, Contains("ja"));
    auto begun = robot(recognition.speech_input_started());
    auto over = robot(recognition.speech_input_finished());
    auto recognized = robot(recognition.speech_recognized());
    expect_ok(recognition.start());
    auto const what = next<SpeechRecognized>(recognized, [](auto&) { return true; });
    EXPECT_THAT(what.recognized_text, ElementsAre("hello"));
    auto const from = next<SpeechInputStarted>(begun, [](auto&) { return true; });
    auto const to = next<SpeechInputFinished>(over, [](auto&) { return true; });
    EXPECT_LT(from.timestamp, to.timestamp);
}

TEST_F(TheFacades, RecognizeGestures) {
    auto const event = first<GestureRecognition, GestureRecognized>(&GestureRecognition::gesture_recognized,
                                                                    [](auto& candidate) { return !candidate.gestures.empty(); });
    EXPECT_EQ(event.gestures[0].code, "wave");
    GestureRecognition const recognition{robot.bind("gesture_recognition")};
    EXPECT_EQ(robot(recognition.component_status()), ComponentStatus::ready);
    EXPECT_THAT(robot(recognition.recognizable_gestures()), Contains(Field(&Identifier::code, "bow")));
}

TEST_F(TheFacades, SpeakAndKeepParameters) {
    auto const synthesis = robot.bind<SpeechSynthesis>("speech_synthesis");
    expect_ok(synthesis.say("Welcome."));
    expect_ok(synthesis.say(
        Speech().with_SSML_text("<speak>Good <emphasis>day</emphasis>.</speak>").with_volume(40).with_language("en")));
    expect_ok(synthesis.set(Speech().with_speech_text("Hello.").with_volume(60).with_language("de").with_character("default")));
    auto const set = robot(synthesis.parameters());
    EXPECT_EQ(set.speech_text, "Hello.");
    EXPECT_FALSE(set.SSML_text) << "a plain text replaces SSML";
    EXPECT_EQ(set.volume, 60);
    EXPECT_EQ(set.language, "de");
    EXPECT_EQ(set.character, "default");
    EXPECT_THAT(set.synthesizable_languages, Contains("de"));
    EXPECT_THAT(set.synthesizable_characters, Contains("default"));
}

TEST_F(TheFacades, PerformReactions) {
    auto const reaction = robot.bind<Reaction>("reaction");
    EXPECT_THAT(robot(reaction.available_reactions()), Contains(Field(&Identifier::code, "9")));
    expect_ok(reaction.react("9"));
    EXPECT_THROW(robot(reaction.react("51")), Error);
}

TEST_F(TheFacadesThatMove, NavigateToTargets) {
    auto const navigation = robot.bind<Navigation>("navigation");
    auto reached = robot(navigation.reached_target());
    expect_ok(navigation.go(NavigationParameters()
                                .with_target_position(Pose{5_m, 5_m, 90_deg})
                                .with_target_position("start")
                                .with_time_limit(60s)
                                .with_routing_policy(RoutingPolicy::distance)));
    auto const any = [](ReachedTarget const&) { return true; };
    auto const on_the_way = next<ReachedTarget>(reached, any);
    EXPECT_EQ(on_the_way.target, "5000, 5000, 90");
    EXPECT_FALSE(on_the_way.is_final_target);
    EXPECT_TRUE(next<ReachedTarget>(reached, any).is_final_target);
    EXPECT_EQ(robot(navigation.go_to("entrance", 1ms)), CompletedStatus::timeout);
    expect_ok(navigation.go_to(Pose{6_m, 6_m}, 0ms));
    expect_ok(navigation.set(NavigationParameters()
                                 .with_target_position(Pose{7_m, 6.5_m})
                                 .with_time_limit(2s)
                                 .with_routing_policy(RoutingPolicy::time)));
    auto const set = robot(navigation.parameters());
    EXPECT_THAT(set.target_position, ElementsAre(Field(&Target::text, "7000, 6500, 0")));
    EXPECT_EQ(set.time_limit, 2s);
    EXPECT_EQ(set.routing_policy, RoutingPolicy::time);
}

TEST_F(TheFacadesThatMove, FollowAPerson) {
    auto const follow = robot.bind<Follow>("follow");
    Identifier const nobody{"nobody", {}, {}, {}};
    EXPECT_EQ(robot(follow.follow(FollowParameters().with_target_object_ref(nobody).with_distance(1_m).with_time_limit(100ms))),
              CompletedStatus::timeout);
    auto const following =
        robot(follow.begin_following(FollowParameters().with_target_object_ref(nobody).with_distance(1_m).with_time_limit(0ms)));
    expect_ok(follow.stop());
    EXPECT_EQ(robot(following.completed()), CompletedStatus::ok);
    EXPECT_THAT(robot(following.results()).parameters, Contains(Field(&Parameter::name, "status")));
    expect_ok(follow.set(FollowParameters().with_target_object_ref(nobody).with_distance(1.5_m).with_time_limit(5s)));
    auto const set = robot(follow.parameters());
    EXPECT_EQ(set.target_object_ref->code, "nobody");
    EXPECT_EQ(set.distance, 1.5_m);
    EXPECT_EQ(set.time_limit, 5s);
}

TEST_F(TheFacadesThatMove, DriveLinesAndCurves) {
    SystemInformation const system{robot.client().component("system_information")};
    auto const where = [&] { return robot(system.robot_position()).robots.at(0).pose; };
    auto const before = where();
    auto const move = robot.bind<Move>("move");
    expect_ok(move.move(Line{-500_mm, 0_deg}));
    EXPECT_NEAR(distance(before, where()).value, 500, 100);
    expect_ok(move.move(Curve{500_mm, 180_deg}, 3s));
    EXPECT_NEAR(std::abs(std::remainder((where().th - before.th).value, 360)), 180, 20);
    expect_ok(move.set(MoveParameters().with_line(Line{100_mm, -90_deg}).with_time(2s)));
    auto const line = robot(move.parameters());
    ASSERT_TRUE(line.line);
    EXPECT_EQ(line.line->distance, 100_mm);
    EXPECT_EQ(line.line->direction, -90_deg);
    EXPECT_FALSE(line.curve);
    EXPECT_EQ(line.time, 2s);
    expect_ok(move.set(MoveParameters().with_curve(Curve{300_mm, 45_deg})));
    auto const curve = robot(move.parameters());
    ASSERT_TRUE(curve.curve);
    EXPECT_EQ(curve.curve->radius, 300_mm);
    EXPECT_EQ(curve.curve->direction, 45_deg);
    EXPECT_FALSE(curve.line) << "a curve replaces a line";
}

TEST_F(TheFacades, ConnectSuspendResumeAndDisconnectAudioStreams) { expect_stream<AudioStreaming>("audio/wav"); }

TEST_F(TheFacades, ConnectSuspendResumeAndDisconnectVideoStreams) { expect_stream<VideoStreaming>("multipart/x-mixed-replace"); }

// --- Temporaries inside a co_await ---

template <class... Parameters>
constexpr bool none_is_aggregate = (!std::is_aggregate_v<Parameters> && ...);
static_assert(none_is_aggregate<LocalizationParameters, SpeechRecognitionParameters, Speech, NavigationParameters,
                                FollowParameters, MoveParameters, StreamParameters, Target, Pose, Box, QueryExpression>);

// Too long for the small buffer of a string: the sanitizer notices if it is destroyed twice.
constexpr auto long_text = "Welcome to the empty hall of the conformance program, which has no visitors.";

Task<Speech> say_it_all_at_once(Client& client) {
    auto const synthesis = co_await client.bind<SpeechSynthesis>("speech_synthesis");
    auto const follow = co_await client.bind<Follow>("follow");
    auto const navigation = co_await client.bind<Navigation>("navigation");
    co_await synthesis.set(Speech().with_speech_text(long_text).with_language("en").with_character("default").with_volume(50));
    co_await follow.set(FollowParameters().with_target_object_ref(long_text).with_distance(1_m).with_time_limit(2s));
    co_await navigation.set(NavigationParameters().with_target_position("start").with_target_position(Pose(5_m, 5_m)));
    auto const set = co_await navigation.parameters();
    EXPECT_THAT(set.target_position, SizeIs(2));
    auto const found = co_await client.search(ordered(type == "Navigation", nearest_to("start"), ascending(component_ref)));
    EXPECT_THAT(found, SizeIs(1));
    auto const within = co_await client.search(location.within(Box(0_m, 0_m, 20_m, 12_m)));
    EXPECT_THAT(within, testing::Not(testing::IsEmpty()));
    auto said = co_await synthesis.parameters();
    co_return said;
}

TEST_F(TheFacadesThatMove, AcceptTemporariesInsideACoAwait) {
    auto const said = robot(say_it_all_at_once(robot.client()));
    EXPECT_EQ(said.speech_text, long_text);
    EXPECT_EQ(said.language, "en");
    EXPECT_EQ(said.volume, 50);
}

// --- Events as callbacks ---

TEST_F(TheFacades, PassEventsToAFunction) {
    auto const gestures = robot.bind<GestureRecognition>("gesture_recognition");
    auto recognized = robot(gestures.gesture_recognized());
    auto const third = std::make_shared<std::promise<std::pair<std::string, std::thread::id>>>();
    recognized.each([third, count = 0](GestureRecognized const& event) mutable {
        if (++count == 3) third->set_value({event.gestures.at(0).code, std::this_thread::get_id()});
    });
    expect_ok(gestures.start());
    auto given = third->get_future();
    ASSERT_EQ(given.wait_for(20s), std::future_status::ready);
    auto const [gesture, thread] = given.get();
    EXPECT_EQ(gesture, "wave");
    EXPECT_NE(thread, std::this_thread::get_id()) << "on the client's thread";
}

TEST_F(TheFacades, PassWaitingEventsFirst) {
    auto const detection = robot.bind<PersonDetection>("person_detection");
    auto waiting = robot(detection.person_detected());
    auto witness = robot(detection.person_detected());
    for (int i = 0; i < 2; ++i) {  // each start sends an event
        expect_ok(detection.start());
        EXPECT_TRUE(robot(witness.next(5s)));
        expect_ok(detection.stop());
    }
    auto const both = std::make_shared<std::promise<void>>();
    waiting.each([both, count = 0](PersonDetected const&) mutable {
        if (++count == 2) both->set_value();
    });
    EXPECT_EQ(both->get_future().wait_for(5s), std::future_status::ready);
}

}  // namespace
}  // namespace rois::test
