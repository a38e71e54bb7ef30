// The C++ PSM against the real gateway: what its functions return.
#include <future>

#include "kit/socket.hpp"
#include "psm/rig.hpp"

namespace {

using namespace rois::test::psm;
using rois::kit::GatewayProcess;
using RoIS_HRI::OUT_OF_RESOURCES;  // not the one of RoIS_Service

std::string filter(std::string const& reference, std::string const& value) {
    return "<fes:Filter><fes:PropertyIsEqualTo><fes:ValueReference>" + reference + "</fes:ValueReference><fes:Literal>" + value +
           "</fes:Literal></fes:PropertyIsEqualTo></fes:Filter>";
}

std::string sequence(std::string const& ref, std::string const& type, std::string const& command_id) {
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<rois:CommandUnitSequence>"
           "<rois:command_unit_list xsi:type=\"rois:CommandMessageType\" rois:command_type=\"" +
           type + "\" rois:command_id=\"" + command_id + "\"><rois:component_ref rois:code=\"" + ref +
           "\"/></rois:command_unit_list></rois:CommandUnitSequence>";
}

// --- Sessions ---

TEST_F(CppPsm, EveryOperationIsAnErrorWithoutASession) {
    std::string profile;
    RoIS_HRI::RoIS_IdentifierList list;
    RoIS_HRI::ParameterList parameters;
    RoIS_Common::Component_Status status{};
    for (auto const code :
         {system.get_profile("", profile), system.get_error_detail("x", "", results), command.search("", list),
          command.bind("move"), command.bind_any("", id), command.release("move"), command.get_parameter("move", parameters),
          command.set_parameter("move", {}, id), command.execute(sequence("move", "stop", "")),
          command.get_command_result("x", "", results), query.query("robot_position", "", results),
          event.subscribe("person_detected", "", id), event.unsubscribe("x"), event.get_event_detail("x", "", results),
          Navigation::Command{}.start(), Navigation::Query{}.component_status(status), system.disconnect()}) {
        EXPECT_EQ(code, error);
        EXPECT_THAT(reason(), HasSubstr("not connected"));
    }
    EXPECT_EQ(id, "as it was");
}

TEST_F(CppPsm, ConnectIsAnErrorWithoutAGatewayOrWithABadUrl) {
    for (std::string const url : {"nowhere", "http://127.0.0.1:99999"}) {
        use(url);
        EXPECT_EQ(system.connect(), error) << url;
        EXPECT_THAT(reason(), StartsWith("connect: "));
    }
    use("http://127.0.0.1:1");  // a port without a gateway
    EXPECT_EQ(system.connect(), error);
    EXPECT_EQ(system.disconnect(), error);
    EXPECT_THAT(application.errors, IsEmpty()) << "the return code is enough";
}

TEST_F(CppPsm, ConnectsAgainAfterADisconnect) {
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(system.connect(), ok);
        EXPECT_EQ(system.connect(), ok) << "it is connected already";
        EXPECT_EQ(command.bind("move"), ok);
        EXPECT_EQ(system.disconnect(), ok);
        EXPECT_EQ(command.bind("move"), error);
    }
    Blocking other{rois::Settings{}};
    EXPECT_EQ(other.call(rois::Bind{{.code = "move"}}).return_code, rois::ReturnCode::ok) << "disconnect releases";
}

TEST_F(CppPsm, SendsTheTokenOfTheEnvironment) {
    rois::kit::Listener listener;
    auto head =
        std::async(std::launch::async, [&] { return rois::kit::Socket{listener.accept().value()}.take_until("\r\n\r\n"); });
    use("http://127.0.0.1:" + std::to_string(listener.port()));
    setenv("ROIS_TOKEN", "open-sesame", 1);
    EXPECT_EQ(system.connect(), error);
    unsetenv("ROIS_TOKEN");
    EXPECT_THAT(head.get().value(), HasSubstr("Authorization: Bearer open-sesame\r\n"));
}

// --- XML texts ---

TEST_F(CppPsm, TheProfileIsADocument) {
    ASSERT_EQ(system.connect(), ok);
    std::string profile;
    EXPECT_EQ(system.get_profile("", profile), ok);
    EXPECT_THAT(profile, StartsWith("<?xml version=\"1.0\""));
    EXPECT_THAT(profile, HasSubstr("<rois:HRIEngineProfile"));
    EXPECT_THAT(profile, HasSubstr("xmlns:gml="));
    EXPECT_THAT(profile, HasSubstr("navigation"));
    EXPECT_THAT(profile, Not(HasSubstr("get_profile_response")));
}

TEST_F(CppPsm, InvalidXmlIsABadParameter) {
    ASSERT_EQ(system.connect(), ok);
    RoIS_HRI::RoIS_IdentifierList list{"as it was"};
    for (std::string const bad : {"<fes:Filter>", "component_type = Navigation", "<fes:Filter/></condition><condition>",
                                  "<fes:Flter/>", "<a b='1' b='2'/>", "<!DOCTYPE a [<!ENTITY b 'c'>]><fes:Filter/>", "<?php ?>",
                                  "<fes:Filter>&b;</fes:Filter>", "<x:Filter/>", "\x01"}) {
        EXPECT_EQ(command.search(bad, list), BAD_PARAMETER) << bad;
        EXPECT_THAT(reason(), Not(IsEmpty()));
        EXPECT_EQ(command.bind_any(bad, id), BAD_PARAMETER) << bad;
        EXPECT_EQ(event.subscribe("person_detected", bad, id), BAD_PARAMETER) << bad;
        EXPECT_EQ(command.execute(bad), BAD_PARAMETER) << bad;
        EXPECT_EQ(system.get_profile(bad, id), BAD_PARAMETER) << bad;
    }
    EXPECT_EQ(command.execute(""), BAD_PARAMETER);
    EXPECT_EQ(command.search(filter("colour", "red"), list), BAD_PARAMETER);
    EXPECT_THAT(reason(), HasSubstr("colour"));
    EXPECT_THAT(list, ElementsAre("as it was"));
    EXPECT_EQ(id, "as it was");
    EXPECT_EQ(command.search("", list), ok) << "the session still works";
    EXPECT_EQ(reason(), "");
}

TEST_F(CppPsm, ConditionsMayDeclareTheirNamespacesAndHaveAnOrder) {
    ASSERT_EQ(system.connect(), ok);
    RoIS_HRI::RoIS_IdentifierList list;
    EXPECT_EQ(
        command.search("<?xml version=\"1.0\"?>\n<Filter xmlns=\"http://www.opengis.net/fes/2.0\"><Or>"
                       "<PropertyIsEqualTo><ValueReference>name</ValueReference><Literal>move</Literal></PropertyIsEqualTo>"
                       "<PropertyIsEqualTo><ValueReference>name</ValueReference><Literal>follow</Literal></PropertyIsEqualTo>"
                       "</Or></Filter><!-- and -->\n"
                       "<fes:SortBy><fes:SortProperty><fes:ValueReference>name</fes:ValueReference>"
                       "<fes:SortOrder>DESC</fes:SortOrder></fes:SortProperty></fes:SortBy>",
                       list),
        ok)
        << reason();
    EXPECT_THAT(list, ElementsAre("move", "follow"));
    EXPECT_EQ(command.search("<unr:SearchCondition><unr:ComponentCondition "
                             "type=\"urn:x-rois:def:component:OMG::Navigation\"/></unr:SearchCondition>",
                             list),
              ok)
        << reason();
    EXPECT_THAT(list, ElementsAre("navigation"));
}

// --- The interfaces ---

TEST_F(CppPsm, CommandsAreAcceptedAndComplete) {
    ASSERT_EQ(system.connect(), ok);
    EXPECT_EQ(command.execute(sequence("speech_synthesis", "start", "")), error) << "not bound";
    EXPECT_EQ(command.bind_any(filter("name", "speech_synthesis"), id), ok) << reason();
    EXPECT_EQ(id, "speech_synthesis");
    EXPECT_EQ(command.bind_any(filter("component_type", "urn:x-rois:def:component:OMG::Elevator"), id), UNSUPPORTED);
    EXPECT_EQ(command.bind("nobody"), BAD_PARAMETER);
    EXPECT_EQ(command.set_parameter("speech_synthesis", {{"speech_text", "string", "Hello."}, {"volume", "int", "30"}}, id), ok);
    EXPECT_EQ(application.status_of(id), RoIS_Service::OK);
    EXPECT_EQ(command.set_parameter("speech_synthesis", {{"volume", "int", "loud"}}, id), BAD_PARAMETER);
    RoIS_HRI::ParameterList parameters;
    EXPECT_EQ(command.get_parameter("speech_synthesis", parameters), ok);
    EXPECT_THAT(parameters, Contains(Field(&RoIS_HRI::Parameter::value, "Hello.")));
    EXPECT_EQ(command.execute(sequence("speech_synthesis", "start", "first")), ok) << reason();
    EXPECT_EQ(application.status_of("first"), RoIS_Service::OK);
    EXPECT_EQ(command.execute(sequence("speech_synthesis", "start", "first")), BAD_PARAMETER) << "the id is taken";
    EXPECT_EQ(command.get_command_result("first", "", results), ok);
    EXPECT_THAT(results, Contains(Field(&Result::value, "OK")));
    EXPECT_EQ(command.get_command_result("second", "", results), BAD_PARAMETER);
    EXPECT_EQ(command.release("speech_synthesis"), ok);
    EXPECT_EQ(command.get_parameter("speech_synthesis", parameters), error);
}

TEST_F(CppPsm, ListsAreEntriesOfTheSameName) {
    ASSERT_EQ(system.connect(), ok);
    ASSERT_EQ(command.bind("navigation"), ok);
    RoIS_HRI::ParameterList const way{{"target_position", "string[]", "9000, 4500, 0"}, {"target_position", "string[]", "desk"}};
    EXPECT_EQ(command.set_parameter("navigation", way, id), ok) << reason();
    RoIS_HRI::ParameterList parameters;
    EXPECT_EQ(command.get_parameter("navigation", parameters), ok);
    EXPECT_THAT(parameters, testing::IsSupersetOf({Field(&RoIS_HRI::Parameter::value, "9000, 4500, 0"),
                                                   Field(&RoIS_HRI::Parameter::value, "desk")}));
}

TEST_F(CppPsm, EventsAreReportedAndTheirDetailsGivenInsideTheNotification) {
    ASSERT_EQ(system.connect(), ok);
    EXPECT_EQ(event.subscribe("person_detected", "", id), ok);
    EXPECT_EQ(event.subscribe("weather_changed", "", id), UNSUPPORTED);
    Person_Detection::Command detection;
    EXPECT_EQ(detection.start(), ok) << reason();
    ASSERT_TRUE(application.bell.await([&] { return !application.events.empty(); }));
    auto const received = application.events.front();
    EXPECT_EQ(received.type, "person_detected");
    EXPECT_EQ(received.subscribe_id, id);
    EXPECT_THAT(received.expire, testing::EndsWith("Z"));
    EXPECT_EQ(received.code, ok);
    EXPECT_THAT(received.details, Contains(Field(&Result::name, "number")));
    EXPECT_EQ(event.unsubscribe(id), ok);
    EXPECT_EQ(event.get_event_detail("nothing", "", results), BAD_PARAMETER);
}

TEST_F(CppPsm, ErrorsAreReportedWithTheirDetails) {
    GatewayProcess const gateway{{"--scenario", ROIS_SOURCE_DIR "/tests/server/data/unwell.xml"}};
    use(gateway.url());
    ASSERT_EQ(system.connect(), ok);
    Navigation::Command navigation;
    EXPECT_EQ(navigation.set_parameter({"desk"}, -1, ""), ok) << reason();
    EXPECT_EQ(navigation.start(), ok) << reason();
    EXPECT_EQ(application.status_of("navigation.start.2"), RoIS_Service::ERROR);
    ASSERT_TRUE(application.bell.await([&] { return !application.errors.empty(); }));
    EXPECT_EQ(application.errors.begin()->second, RoIS_Service::COMPONENT_INTERNAL_ERROR);
    EXPECT_EQ(system.get_error_detail(application.errors.begin()->first, "", results), ok);
    EXPECT_THAT(results, Contains(Field(&Result::value, "navigation")));
    EXPECT_EQ(system.disconnect(), ok);
}

// --- Components ---

TEST_F(CppPsm, ACommandBindsAComponentOfItsTypeUnlessOneIsBound) {
    ASSERT_EQ(system.connect(), ok);
    Speech_Synthesis::Command synthesis;
    Speech_Synthesis::Query of_it;
    RoIS_Common::Component_Status status{};
    Blocking other{rois::Settings{}};
    ASSERT_EQ(other.call(rois::Bind{{.code = "speech_synthesis"}}).return_code, rois::ReturnCode::ok);
    EXPECT_EQ(of_it.component_status(status), ok);
    EXPECT_EQ(status, RoIS_Common::BUSY);
    EXPECT_EQ(synthesis.start(), OUT_OF_RESOURCES);
    EXPECT_THAT(reason(), Not(IsEmpty()));
    ASSERT_EQ(other.call(rois::Release{{.code = "speech_synthesis"}}).return_code, rois::ReturnCode::ok);
    EXPECT_EQ(synthesis.set_parameter("Hello.", "", 20, "en", ""), ok) << reason();
    EXPECT_EQ(of_it.component_status(status), ok);
    EXPECT_EQ(status, RoIS_Common::READY);
    EXPECT_EQ(other.call(rois::Bind{{.code = "speech_synthesis"}}).return_code, rois::ReturnCode::out_of_resources);
    std::string text;
    std::string ssml;
    std::string language;
    std::string character;
    long volume = 0;
    std::vector<std::string> languages;
    RoIS_HRI::RoIS_IdentifierList characters;
    EXPECT_EQ(of_it.get_parameter(text, ssml, volume, language, character, languages, characters), ok) << reason();
    EXPECT_EQ(text, "Hello.");
    EXPECT_EQ(ssml, "");
    EXPECT_EQ(volume, 20);
    EXPECT_THAT(languages, Contains("en"));
    EXPECT_EQ(command.release("speech_synthesis"), ok);
    EXPECT_EQ(other.call(rois::Bind{{.code = "speech_synthesis"}}).return_code, rois::ReturnCode::ok);
}

TEST_F(CppPsm, TheBaseClassesAddressTheComponentThatWasBoundLast) {
    ASSERT_EQ(system.connect(), ok);
    RoIS_Common::Command any;
    RoIS_Common::Query of_any;
    RoIS_Common::Component_Status status{};
    EXPECT_EQ(any.start(), error);
    EXPECT_THAT(reason(), HasSubstr("no component is bound"));
    EXPECT_EQ(of_any.component_status(status), error);
    EXPECT_EQ(command.bind("person_detection"), ok);
    for (auto const function : {&RoIS_Common::Command::start, &RoIS_Common::Command::suspend, &RoIS_Common::Command::resume,
                                &RoIS_Common::Command::stop})
        EXPECT_EQ((any.*function)(), ok) << reason();
    EXPECT_EQ(of_any.component_status(status), ok);
    EXPECT_TRUE(application.bell.await([&] { return application.ended.size() == 4; }));
    for (auto const& [what, how] : application.ended) {
        EXPECT_THAT(what, StartsWith("person_detection."));
        EXPECT_EQ(how, RoIS_Service::OK) << what;
    }
}

TEST_F(CppPsm, EveryComponentStoresAndReturnsItsParameters) {
    ASSERT_EQ(system.connect(), ok);
    long a = 0;
    long b = 0;
    std::string text;
    std::string rule;
    std::vector<std::string> list;
    std::vector<std::string> more;
    EXPECT_EQ(Person_Localization::Command{}.set_parameter(500, 250), ok) << reason();
    EXPECT_EQ(Person_Localization::Query{}.get_parameter(a, b), ok);
    EXPECT_EQ(a, 500);
    EXPECT_EQ(b, 250);
    EXPECT_EQ(Face_Localization::Command{}.set_parameter(600, 300), ok) << reason();
    EXPECT_EQ(Face_Localization::Query{}.get_parameter(a, b), ok);
    EXPECT_EQ(a, 600);
    EXPECT_EQ(b, 300);
    EXPECT_EQ(Sound_Localization::Command{}.set_parameter(900, 350), ok) << reason();
    EXPECT_EQ(Sound_Localization::Query{}.get_parameter(a, b), ok);
    EXPECT_EQ(a, 900);
    EXPECT_EQ(b, 350);
    std::string ssml;
    std::string language;
    std::string character;
    EXPECT_EQ(Speech_Synthesis::Command{}.set_parameter("Hello.", "", 60, "en", "female"), ok) << reason();
    EXPECT_EQ(Speech_Synthesis::Query{}.get_parameter(text, ssml, a, language, character, list, more), ok);
    EXPECT_EQ(text, "Hello.");
    EXPECT_EQ(a, 60);
    EXPECT_EQ(language, "en");
    EXPECT_EQ(character, "female");
    EXPECT_THAT(more, Contains("female"));
    EXPECT_EQ(Speech_Recognition::Command{}.set_parameter({"en"}, "", ""), ok) << reason();
    EXPECT_EQ(Speech_Recognition::Query{}.get_parameter(list, more, text, rule), ok);
    EXPECT_THAT(list, Contains("en"));
    EXPECT_THAT(more, ElementsAre("en"));
    EXPECT_EQ(Gesture_Recognition::Query{}.get_parameter(list), ok) << reason();
    EXPECT_THAT(list, Not(IsEmpty()));
    EXPECT_EQ(Reaction::Command{}.set_parameter({"9"}), ok) << reason();
    EXPECT_EQ(Reaction::Command{}.set_parameter({"9", "10"}), BAD_PARAMETER);
    EXPECT_EQ(Reaction::Query{}.get_parameter(list, text), ok);
    EXPECT_THAT(list, Contains("9"));
    EXPECT_EQ(text, "9");
    EXPECT_EQ(Navigation::Command{}.set_parameter({"desk"}, 90'000, "distance"), ok) << reason();
    EXPECT_EQ(Navigation::Query{}.get_parameter(list, a, text), ok);
    EXPECT_THAT(list, ElementsAre("desk"));
    EXPECT_EQ(a, 90'000);
    EXPECT_EQ(text, "distance");
    EXPECT_EQ(Navigation::Command{}.set_parameter({}, -1, "slowly"), BAD_PARAMETER);
    EXPECT_THAT(reason(), HasSubstr("slowly"));
    EXPECT_EQ(Follow::Command{}.set_parameter("tanaka", 800, -1), ok) << reason();
    EXPECT_EQ(Follow::Query{}.get_parameter(text, a, b), ok);
    EXPECT_EQ(text, "tanaka");
    EXPECT_EQ(a, 800);
    std::vector<long> line;
    std::vector<long> curve;
    EXPECT_EQ(Move::Command{}.set_parameter({300, -90}, {}, -1), ok) << reason();
    EXPECT_EQ(Move::Query{}.get_parameter(line, curve, a), ok);
    EXPECT_THAT(line, ElementsAre(300, -90));
    EXPECT_THAT(curve, IsEmpty());
}

TEST_F(CppPsm, TheSystemReportsRobotPositionsAndItsStatus) {
    ASSERT_EQ(system.connect(), ok);
    System_Information::Query information;
    std::string timestamp;
    RoIS_HRI::RoIS_IdentifierList robots;
    std::vector<RoLo::Architecture::Data> positions;
    EXPECT_EQ(information.robot_position(timestamp, robots, positions), ok);
    EXPECT_THAT(timestamp, testing::EndsWith("Z"));
    EXPECT_THAT(robots, Contains("robot1"));
    EXPECT_EQ(positions.size(), robots.size());
    RoIS_Common::Component_Status status{};
    std::vector<std::string> times;
    EXPECT_EQ(information.engine_status(status, times), ok);
    EXPECT_EQ(status, RoIS_Common::READY);
}

TEST_F(CppPsm, StreamsAreConnectedAndDisconnected) {
    GatewayProcess const gateway{{"--media", "127.0.0.1:0"}};
    use(gateway.url());
    ASSERT_EQ(system.connect(), ok);
    Video_Streaming::Command streaming;
    Video_Streaming::Query of_it;
    std::string encodings;
    std::string transports;
    EXPECT_EQ(of_it.get_parameter(encodings, transports), ok) << reason();
    EXPECT_THAT(encodings, Not(IsEmpty()));
    EXPECT_EQ(streaming.connect_stream(id), ok) << reason();
    RoIS_Common::Stream_Status status{};
    EXPECT_EQ(of_it.get_stream_status(id, status), ok) << reason();
    EXPECT_EQ(status, RoIS_Common::STREAMING_NOT_RUNNING);
    EXPECT_EQ(of_it.get_stream_status("nobody's", status), UNSUPPORTED);
    EXPECT_EQ(streaming.suspend_stream("nobody's"), BAD_PARAMETER) << reason();
    EXPECT_EQ(streaming.disconnect_stream(id), ok) << reason();
    EXPECT_EQ(of_it.get_stream_status(id, status), ok);
    EXPECT_EQ(status, RoIS_Common::STREAMING_NOT_CONNECTED);
    EXPECT_EQ(system.disconnect(), ok);
}

}  // namespace
