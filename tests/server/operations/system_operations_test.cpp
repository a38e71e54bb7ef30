// System interface (table 2): connect, disconnect, get_profile, get_error_detail; and requests without a session.
#include "server/conversation.hpp"

namespace rois::test {
namespace {

using testing::SizeIs;

struct SystemOperations : Conversation {};
ROIS_OVER_BOTH_WAYS(SystemOperations);

// Returns the components in an answer of get_profile.
std::vector<std::string> component_refs(Document const& answer) {
    std::vector<std::string> refs;
    for (auto const component : answer.root().child("components").children("component"))
        refs.emplace_back(component.attribute("ref").value());
    return refs;
}

// Each operation except connect, with valid children.
std::vector<std::pair<std::string, Xml>> const& operations_in_a_session() {
    static Xml const navigation = "<component_ref rois:code=\"navigation\"/>";
    static std::vector<std::pair<std::string, Xml>> const all{{"disconnect", ""},
                                                              {"get_profile", ""},
                                                              {"get_error_detail", "<error_id>x-1</error_id>"},
                                                              {"search", ""},
                                                              {"bind", navigation},
                                                              {"bind_any", ""},
                                                              {"release", navigation},
                                                              {"get_parameter", navigation},
                                                              {"set_parameter", navigation + parameters({time_limit("1")})},
                                                              {"execute", sequence(pause(0))},
                                                              {"get_command_result", "<command_id>c-1</command_id>"},
                                                              {"query", "<query_type>robot_position</query_type>"},
                                                              {"subscribe", "<event_type>reached_target</event_type>"},
                                                              {"unsubscribe", "<subscribe_id>s-1</subscribe_id>"},
                                                              {"get_event_detail", "<event_id>e-1</event_id>"}};
    return all;
}

TEST_P(SystemOperations, ConnectGivesASession) {
    Application other{GetParam(), empty_hall()};
    auto const answer = other.connect();
    EXPECT_THAT(answer, IsOk());
    EXPECT_THAT(answer.children(), ElementsAre("session"));
    EXPECT_NE(answer.text("session"), "");
}

TEST_P(SystemOperations, ConnectAgainChangesNothing) {
    desk.bind("navigation");
    auto const once = desk.connect();
    auto const again = desk.connect();
    EXPECT_THAT(again, IsOk());
    EXPECT_EQ(again.text("session"), once.text("session"));
    EXPECT_THAT(desk.get_parameter("navigation"), IsOk()) << "still bound";
}

TEST_P(SystemOperations, ConnectAboveTheLimitIsAFault) {
    GatewayProcess small{{"--max-sessions", "1"}};
    Application first{GetParam(), small}, second{GetParam(), small};
    EXPECT_THAT(first.connect(), IsOk());
    EXPECT_THAT(first.bind("navigation"), IsOk());
    EXPECT_EQ(second.ask("connect").fault(), "too_many");
}

TEST_P(SystemOperations, WithoutASessionAllOthersAreRefused) {
    Application stranger{GetParam(), empty_hall()};
    for (auto const& [operation, children] : operations_in_a_session())
        EXPECT_EQ(stranger.ask(operation, children).fault(), "no_session") << operation;
}

TEST_P(SystemOperations, AfterDisconnectAllOthersAreRefused) {
    EXPECT_THAT(desk.disconnect(), IsOk());
    for (auto const& [operation, children] : operations_in_a_session())
        EXPECT_EQ(desk.ask(operation, children).fault(), "no_session") << operation;
}

TEST_P(SystemOperations, DisconnectHasNoOutParametersAndFreesComponents) {
    desk.bind("speech_synthesis");
    desk.execute(speak_long("long"));
    auto const answer = desk.disconnect();
    EXPECT_THAT(answer, IsOk());
    EXPECT_THAT(answer.children(), SizeIs(0));
    Application next{GetParam(), empty_hall()};
    next.connect();
    EXPECT_THAT(next.bind("speech_synthesis"), IsOk());
    next.execute(speak("Hello.", "hello"));
    EXPECT_EQ(next.status_of("hello"), "OK");
}

TEST_P(SystemOperations, ConnectAfterDisconnectOpensAnotherSession) {
    auto const before = desk.connect().text("session");
    desk.disconnect();
    auto const after = desk.connect();
    EXPECT_THAT(after, IsOk());
    EXPECT_NE(after.text("session"), before);
}

TEST_P(SystemOperations, GetProfileReturnsTheEngineAndItsComponents) {
    auto const answer = desk.ask("get_profile");
    EXPECT_THAT(answer, IsOk());
    auto const refs = component_refs(answer);
    EXPECT_THAT(refs,
                ElementsAre("face_detection", "face_localization", "follow", "gesture_recognition", "move", "navigation",
                            "person_detection", "person_identification", "person_localization", "reaction", "sound_detection",
                            "sound_localization", "speech_recognition", "speech_synthesis", "system_information"));
    std::vector<std::string> children{"rois:HRIEngineProfile", "components"};
    children.insert(children.end(), refs.size(), "rois:HRIComponentProfile");
    EXPECT_EQ(answer.children(), children);
    auto const engine = answer.root().child("rois:HRIEngineProfile");
    EXPECT_FALSE(engine.child("rois:HRIComponent")) << "all components belong to the robot";
    EXPECT_STREQ(engine.child("rois:SubProfile").child("gml:name").text().get(), "robot1");
    std::vector<std::string> of_robot;
    for (auto const component : engine.child("rois:SubProfile").children("rois:HRIComponent"))
        of_robot.emplace_back(component.text().get());
    EXPECT_THAT(of_robot, testing::UnorderedElementsAreArray(refs));
}

TEST_P(SystemOperations, GetProfileReturnsTheComponentsOfTheCondition) {
    auto const answer = desk.ask("get_profile", where(equal("component_ref", "navigation")));
    EXPECT_THAT(component_refs(answer), ElementsAre("navigation"));
    EXPECT_THAT(answer.children(), ElementsAre("rois:HRIEngineProfile", "components", "rois:HRIComponentProfile"));
    auto const component = answer.root().child("components").child("component");
    EXPECT_STREQ(component.attribute("type").value(), "urn:x-rois:def:component:OMG::Navigation");
    auto const profile = answer.root().child("rois:HRIComponentProfile");
    EXPECT_STREQ(profile.attribute("gml:id").value(), "profile.navigation");
    EXPECT_TRUE(profile.find_child_by_attribute("rois:MessageProfile", "rois:name", "reached_target"));
    EXPECT_TRUE(profile.find_child_by_attribute("rois:ParameterProfile", "rois:name", "time_limit"));
    EXPECT_THAT(component_refs(desk.ask("get_profile", where(equal("component_ref", "dishwasher")))), SizeIs(0));
}

TEST_P(SystemOperations, GetProfileNamesTheEngineOfEachComponent) {
    auto const answer = desk.ask("get_profile");
    std::string const engine = answer.root().child("rois:HRIEngineProfile").child("gml:name").text().get();
    std::vector<std::string> engines;
    for (auto const component : answer.root().child("components").children("component"))
        engines.emplace_back(component.attribute("engine").value());
    EXPECT_THAT(engines, testing::Each(std::string{"robot1"}));
    for (auto const& whole : {engine, std::string{}, std::string{"robot1"}})
        EXPECT_THAT(desk.search(where(equal("engine", whole))), SizeIs(15)) << whole;
}

TEST_P(SystemOperations, GetProfileOfAnEngineReturnsThatEngine) {
    auto const name = [&](Xml const& condition) {
        auto const answer = desk.ask("get_profile", condition);
        EXPECT_THAT(component_refs(answer), SizeIs(15));
        return std::string{answer.root().child("rois:HRIEngineProfile").child("gml:name").text().get()};
    };
    auto const whole = name({});
    EXPECT_NE(whole, "robot1");
    EXPECT_EQ(name(where(equal("engine", ""))), whole);
    EXPECT_EQ(name(where(equal("engine", whole))), whole);
    EXPECT_EQ(name(where(equal("engine", "robot1"))), "robot1");
}

TEST_P(SystemOperations, GetProfileRefusesAnInvalidCondition) {
    EXPECT_THAT(desk.ask("get_profile", where(undefined_function("name"))), IsRefused("BAD_PARAMETER", "is_free"));
    EXPECT_THAT(desk.ask("get_profile", where(equal("colour", "red"))), IsRefused("BAD_PARAMETER", "colour"));
}

TEST_P(SystemOperations, GetErrorDetailRefusesAnUnknownError) {
    EXPECT_THAT(desk.ask("get_error_detail", "<error_id>nobody</error_id>"), IsRefused("BAD_PARAMETER", "nobody"));
    EXPECT_THAT(desk.ask("get_error_detail", "<error_id>x-1</error_id>" + where(equal("text", "any"))),
                IsRefused("BAD_PARAMETER", "x-1"));
}

}  // namespace
}  // namespace rois::test
