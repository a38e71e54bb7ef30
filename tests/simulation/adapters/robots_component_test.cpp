#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "basic/components/reaction_types.hpp"
#include "engine/working_engine.hpp"
#include "files/files.hpp"
#include "simulation/component_stage.hpp"
#include "types/data_type.hpp"
#include "xml/profiles/profile_document.hpp"
#include "xml/validation/schemas.hpp"

namespace rois::simulation::stage {
namespace {

using namespace std::string_literals;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::IsSupersetOf;
using testing::SizeIs;
using testing::UnorderedElementsAre;

TEST(Robots, ASingleRobotHasTheFifteenBasicComponents) {
    auto const simulation = std::make_shared<Simulation>(reception(), Scenario{}, 1, 1.0);
    std::vector<std::string> refs;
    for (auto const& component : robot_components(robots(simulation, nullptr), bare_profiles()))
        refs.push_back(component->description().ref.code);
    EXPECT_THAT(refs, UnorderedElementsAre("system_information", "person_detection", "person_localization",
                                           "person_identification", "face_detection", "face_localization", "sound_detection",
                                           "sound_localization", "speech_recognition", "gesture_recognition", "speech_synthesis",
                                           "reaction", "navigation", "follow", "move"));
    EXPECT_EQ(Stage{}["navigation"].description().engine, "robot") << "the first robot is also a sub engine";
}

TEST(Robots, HaveStreamingComponentsWithMedia) {
    EXPECT_THAT(Stage{}.refs(), AllOf(SizeIs(17), Contains("audio_streaming"), Contains("video_streaming")));
}

TEST(Robots, AreSubEngines) {
    Stage stage{{}, reception_with_two_robots()};
    EXPECT_THAT(stage.refs(), SizeIs(34));
    EXPECT_THAT(stage.refs(), Contains("robot2.navigation"));
    EXPECT_EQ(stage["robot2.navigation"].description().engine, "robot2");
    EXPECT_EQ(stage["navigation"].description().engine, "robot");
}

// The room hangs over the way of the robot and of the visitor.
FloorPlan reception_with_a_room() {
    FloorPlan plan = reception();
    RobotPlan room;
    room.name = "room";
    room.start = {Point{5, 4}, 0};
    room.fixed = true;
    room.sensors.people.field_of_view = from_degrees(360);
    plan.robots.push_back(room);
    return plan;
}

TEST(Robots, ThatAreFixedHaveOnlySensingComponents) {
    auto plan = reception_with_a_room();
    Stage const stage{{}, plan};
    EXPECT_THAT(stage.refs(), IsSupersetOf({"room.system_information", "room.person_localization", "room.sound_localization",
                                            "room.speech_recognition", "room.video_streaming"}));
    for (auto const* acting : {"navigation", "move", "follow", "speech_synthesis", "reaction"})
        EXPECT_THAT(stage.refs(), testing::Not(Contains("room."s + acting)));
    EXPECT_THAT(component_refs(plan, {"lamp"}), testing::Not(Contains("room.lamp")));
    EXPECT_THAT(component_refs(plan), testing::UnorderedElementsAreArray(stage.refs()));
}

TEST(Robots, ThatAreFixedSenseAndAreInNobodysWay) {
    Stage stage{{visitor("guest", {does(Ignore{}), does(Walk{at(5, 4)}), does(Wait{1000})}, 20)}, reception_with_a_room()};
    stage["navigation"].start({texts("target_position", {"8000, 4000", "8000, 2000"})});
    stage["room.person_localization"].start();
    EXPECT_EQ(stage.outcome("navigation"), "OK");
    stage.run(30);
    EXPECT_LT(distance(stage.hall().people().front().pose.position, Point(5, 4)), 0.3);
    EXPECT_THAT(stage["room.person_localization"].events("person_localized"), testing::Not(testing::IsEmpty()));
    EXPECT_EQ(stage.robot(1).position, Point(5, 4));
}

TEST(Robots, ReportTheChargeOfTheirBatteries) {
    auto plan = reception();
    Stage without{{}, plan};
    without["navigation"].start({texts("target_position", {"8000, 4000"})});
    without.run(5);
    EXPECT_THAT(without["navigation"].readable_parameters(), testing::IsEmpty());

    plan.robots.front().battery = 2;
    Stage stage{{}, plan};
    auto const charge = [&](std::string const& ref) { return find(stage[ref].readable_parameters(), "battery")->values.at(0); };
    stage.run(0.1);
    for (auto const* ref : {"navigation", "move", "follow"}) EXPECT_EQ(charge(ref), "2");
    stage["navigation"].start({texts("target_position", {"8000, 4000", "2000, 4000", "8000, 4000"})});
    EXPECT_EQ(stage.outcome("navigation"), "OK");
    EXPECT_EQ(charge("move"), "1") << "it does not get empty";
}

TEST(Robots, MayAllHavePrefixes) {
    auto plan = reception_with_two_robots();
    plan.prefix_first = true;
    Stage stage{{}, plan};
    EXPECT_THAT(stage.refs(), IsSupersetOf({"robot.navigation", "robot2.navigation"}));
    EXPECT_THAT(component_refs(plan), testing::UnorderedElementsAreArray(stage.refs()));
    EXPECT_EQ(stage["robot.navigation"].description().engine, "robot");
}

TEST(Robots, FailWithoutTheProfilesOfTheirComponents) {
    auto simulation = std::make_shared<Simulation>(reception(), Scenario{}, 1, 1.0);
    auto profiles = bare_profiles();
    profiles.pop_back();
    EXPECT_THROW(robot_components(robots(simulation, std::make_shared<FakeMedia>()), profiles), std::runtime_error);
}

TEST(Robots, SeeTheSamePersonByTheSameName) {
    Stage stage{{visitor("guest", {does(Walk{at(5, 4)}), does(Face{at("robot")}), does(Wait{1000})})},
                reception_with_two_robots()};
    stage.run(15);
    stage["person_localization"].start();
    stage["robot2.person_localization"].start();
    stage.step();
    auto const first = stage["person_localization"].events("person_localized");
    auto const second = stage["robot2.person_localization"].events("person_localized");
    ASSERT_THAT(first, SizeIs(1));
    ASSERT_THAT(second, SizeIs(1));
    EXPECT_EQ(values(first[0].results, "person_ref"), values(second[0].results, "person_ref"));
}

TEST(Robots, SpeakAndReactIndependently) {
    Stage stage{{}, reception_with_two_robots()};
    stage["speech_synthesis"].start({text("speech_text", "Good morning.")});
    stage["robot2.speech_synthesis"].start({text("speech_text", "Good evening to you all, ladies and gentlemen.")});
    stage["robot2.reaction"].start({reference("reaction_ref", "9")});
    stage.step();
    EXPECT_EQ(stage.robot_state(0).speaking->text, "Good morning.");
    EXPECT_FALSE(stage.robot_state(0).showing);
    EXPECT_TRUE(stage.robot_state(1).showing);
    EXPECT_EQ(stage.outcome("speech_synthesis"), "OK");
    EXPECT_FALSE(stage["robot2.speech_synthesis"].ended());
    EXPECT_EQ(stage.outcome("robot2.speech_synthesis"), "OK");
}

// Components in a real engine with the project's profiles.
class Engaged : public testing::Test, private Outbox {
protected:
    Engaged() {
        auto const schemas = std::make_shared<xml::Schemas const>(files::schemas());
        profiles_ = xml::read_component_profiles(schemas, files::profiles());
        int secrets = 0;
        engine_ = std::make_unique<WorkingEngine>(EngineProfile{}, profiles_, EngineSettings{}, static_cast<Outbox&>(*this),
                                                  [secrets]() mutable { return "secret-" + std::to_string(++secrets); });
        simulation_ = std::make_shared<Simulation>(
            reception(),
            Scenario{.name = "test",
                     .faults = {},
                     .roles = {known(visitor("tanaka", {does(Walk{at(4, 4)}), does(Face{at("robot")}), does(Say{"en", "Hello."}),
                                                        does(Gesture{std::string{gestures().front()}}), does(Wait{1000})}))},
                     .round = {},
                     .arrivals = {}},
            7, 1.0);
        engine_->Engine::add(simulation_, std::string{Simulation::provider});
        for (auto& component : robot_components(robots(simulation_, std::make_shared<FakeMedia>()), profiles_))
            engine_->add(std::move(component));
        session_ = std::get<Connect::Reply>(ask(Connect{})).session;
        engine_->link_opened(session_, LinkKind::stream, now_);
    }

    Reply ask(Operation const& operation) { return std::get<Reply>(engine_->answer_of(session_, operation, now_)); }

    void run(std::chrono::milliseconds time) {
        for (auto const end = now_.steady + time; now_.steady < end;) {
            now_ = now_ + std::chrono::milliseconds{20};
            engine_->tick(now_);
        }
    }

    ReturnCode start(std::string ref, ParameterList arguments = {}, std::string command_type = "start") {
        EXPECT_EQ(std::get<Bind::Reply>(ask(Bind{coded(ref)})).return_code, ReturnCode::ok) << ref;
        CommandUnit unit;
        unit.unit = CommandMessage{coded(ref), std::move(command_type), {}, std::move(arguments)};
        auto const reply = std::get<Execute::Reply>(ask(Execute{{{unit}}}));
        EXPECT_EQ(reply.reason, "") << ref;
        return reply.return_code;
    }

    void notify(NotificationQueue&) override {}

    xml::Platform platform_;
    std::vector<ComponentProfile> profiles_;
    std::shared_ptr<Simulation> simulation_;
    std::unique_ptr<WorkingEngine> engine_;
    SessionId session_;
    Instant now_{Steady{}, Utc{std::chrono::seconds{1'800'000'000}}};
};

TEST_F(Engaged, ComponentsReportTheResultsOfTheirProfiles) {
    std::map<std::string, MessageProfile const*> promised;
    for (auto const& profile : profiles_)
        for (auto const& message : profile.messages)
            if (message.kind == MessageKind::event) promised[message.name] = &message;
    for (auto const& [type, message] : promised) {
        Subscribe subscribe{type, {}, true};
        EXPECT_EQ(std::get<Subscribe::Reply>(ask(subscribe)).return_code, ReturnCode::ok) << type;
    }
    for (auto ref : {"person_detection", "person_localization", "person_identification", "face_detection", "face_localization",
                     "sound_detection", "sound_localization", "speech_recognition", "gesture_recognition"})
        EXPECT_EQ(start(ref), ReturnCode::ok) << ref;
    EXPECT_EQ(start("navigation", {texts("target_position", {"desk"})}), ReturnCode::ok);
    EXPECT_EQ(start("audio_streaming", {}, "connect_stream"), ReturnCode::ok);
    run(std::chrono::seconds{40});

    std::set<std::string> received;
    for (auto const& entry : engine_->notifications(session_)->read(0, 10'000)) {
        auto const* event = std::get_if<ReceiveEvent>(&entry.notification->body);
        if (event == nullptr) continue;
        received.insert(event->event_type);
        auto const& results = promised.at(event->event_type)->results;
        ASSERT_EQ(event->results->parameters.size(), results.size()) << event->event_type;
        for (auto const& result : results) {
            auto const* reported = find(event->results->parameters, result.name);
            ASSERT_NE(reported, nullptr) << event->event_type << " " << result.name;
            EXPECT_TRUE(DataType::of(reported->data_type_ref) == DataType::of(result.data_type_ref)) << result.name;
            EXPECT_EQ(why_not(DataType::of(result.data_type_ref), reported->values), std::nullopt) << result.name;
        }
    }
    EXPECT_EQ(received.size(), promised.size()) << testing::PrintToString(received);
}

TEST_F(Engaged, ComponentsHaveTheParametersOfTheirProfiles) {
    std::set<std::string> read;
    for (auto const& component : engine_->components()) {
        auto const* get_parameter = find_message(*component.profile, MessageKind::query, "get_parameter");
        if (get_parameter == nullptr) continue;
        EXPECT_EQ(std::get<Bind::Reply>(ask(Bind{coded(component.ref)})).return_code, ReturnCode::ok);
        auto const reply = std::get<GetParameter::Reply>(ask(GetParameter{coded(component.ref)}));
        for (auto const& parameter : reply.parameters) {
            read.insert(parameter.name);
            auto const* result = find_parameter(get_parameter->results, parameter.name);
            ASSERT_NE(result, nullptr) << component.ref << " " << parameter.name;
            EXPECT_TRUE(DataType::of(parameter.data_type_ref) == DataType::of(result->data_type_ref)) << parameter.name;
        }
    }
    EXPECT_THAT(read, IsSupersetOf({"recognizable_languages", "recognizable_gestures", "synthesizable_languages",
                                    "synthesizable_characters", "available_reactions", "volume", "routing_policy"}));
}

TEST_F(Engaged, ActionsStartWithTheDefaultsOfTheirProfiles) {
    run(std::chrono::seconds{1});
    EXPECT_EQ(start("speech_synthesis", {text("speech_text", "Hello.")}), ReturnCode::ok);
    EXPECT_EQ(start("reaction", {reference("reaction_ref", "1")}), ReturnCode::ok);
    EXPECT_EQ(start("move", {integers("line", "100 0")}), ReturnCode::ok);
    run(std::chrono::seconds{20});
    int ok = 0;
    for (auto const& entry : engine_->notifications(session_)->read(0, 1'000))
        if (auto const* completed = std::get_if<Completed>(&entry.notification->body))
            ok += completed->status == CompletedStatus::ok ? 1 : 0;
    EXPECT_EQ(ok, 3);
}

// Table 34: the only basic component without the methods of table 32.
TEST_F(Engaged, SystemInformationHasNothingToStart) {
    run(std::chrono::seconds{1});
    EXPECT_EQ(std::get<Bind::Reply>(ask(Bind{coded("system_information")})).return_code, ReturnCode::ok);
    for (auto const* type : {"start", "stop", "suspend", "resume"}) {
        CommandUnit unit;
        unit.unit = CommandMessage{coded("system_information"), type, {}, {}};
        auto const reply = std::get<Execute::Reply>(ask(Execute{{{unit}}}));
        EXPECT_EQ(reply.return_code, ReturnCode::bad_parameter) << type;
        EXPECT_THAT(reply.reason, testing::HasSubstr("has no command '" + std::string{type} + "'"));
    }
}

TEST_F(Engaged, AStoppedFollowCompletesWithOk) {
    run(std::chrono::seconds{10});
    EXPECT_EQ(start("follow", {reference("target_object_ref", "person-1"), integer("distance", 1000)}), ReturnCode::ok);
    CommandUnit stop;
    stop.unit = CommandMessage{coded("follow"), "stop", {}, {}};
    ask(Execute{{{stop}}});
    std::vector<CompletedStatus> statuses;
    for (auto const& entry : engine_->notifications(session_)->read(0, 1'000))
        if (auto const* completed = std::get_if<Completed>(&entry.notification->body)) statuses.push_back(completed->status);
    EXPECT_THAT(statuses, ElementsAre(CompletedStatus::ok, CompletedStatus::ok));
}

}  // namespace
}  // namespace rois::simulation::stage
