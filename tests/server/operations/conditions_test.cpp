// Conditions (ISO 19143) of the operations, in the reception hall with its places and robots.
#include "server/conversation.hpp"

namespace rois::test {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::SizeIs;

struct Conditions : Conversation {};
ROIS_OVER_BOTH_WAYS(Conditions);

TEST_P(Conditions, KnowUnitsByTheirNamesInBothSpellings) {
    for (auto const* unit : {"m", "metre", "meter"})
        EXPECT_THAT(desk.search(where(related("DWithin", "location", place("desk") + distance("50", unit)))), SizeIs(15)) << unit;
    EXPECT_THAT(desk.search(where(related("DWithin", "location", place("desk") + distance("50", "millimeter")))), IsEmpty());
}

Xml gml(std::string const& name, Xml const& inside) {
    return element("gml:" + name, {{"xmlns:gml", "http://www.opengis.net/gml/3.2"}}, inside);
}

Xml ring(std::string const& points) {
    return gml("Polygon", gml("exterior", gml("LinearRing", text_element("gml:posList", points))));
}

Xml circle(std::string const& centre, std::string const& radius, std::string const& unit) {
    return gml("CircleByCenterPoint",
               text_element("gml:pos", centre) + element("gml:radius", {{"uom", unit}}, characters(radius)));
}

// All 15 components are at the position of their robot, within the hall of 20 m by 12 m.
TEST_P(Conditions, RelatePlacesByEachOperator) {
    auto const whole = ring("0 0 20000 0 20000 12000 0 12000 0 0");
    auto const found = [&](std::string const& relation, Xml const& other) {
        return desk.search(where(related(relation, "location", other))).size();
    };
    EXPECT_EQ(found("Within", whole), 15U);
    EXPECT_EQ(found("Intersects", whole), 15U);
    EXPECT_EQ(found("Disjoint", whole), 0U);
    for (auto const* never : {"Touches", "Overlaps", "Crosses", "Equals", "Contains"})
        EXPECT_EQ(found(never, whole), 0U) << never;
    EXPECT_EQ(desk.search(where(element("fes:Contains", whole + text_element("fes:ValueReference", "location")))).size(), 15U);
    EXPECT_EQ(found("Within", circle("10000 6000", "12", "m")), 15U);
    EXPECT_EQ(found("Disjoint", circle("10000 6000", "12", "m")), 0U);
    EXPECT_EQ(found("DWithin", gml("LineString", text_element("gml:posList", "0 0 20000 0")) + distance("12", "m")), 15U);
    auto const crossed = ring("0 0 1 1 1 0 0 1 0 0");
    EXPECT_THAT(desk.ask("search", where(related("Within", "location", crossed))),
                IsRefused("BAD_PARAMETER", "a polygon whose edges cross or touch one another"));
    EXPECT_THAT(desk.ask("search", where(related("Within", "location", circle("0 0", "0", "m")))),
                IsRefused("BAD_PARAMETER", "radius is not above 0"));
    EXPECT_THAT(desk.ask("search", where(related("Within", "location", box("5 5", "1 1")))),
                IsRefused("BAD_PARAMETER", "lowerCorner is above its upperCorner"));
}

// In the wrapper of the published examples.
Xml wrapped(Xml const& inside) {
    return "<condition xmlns:fes=\"http://www.opengis.net/fes/2.0\" xmlns:unr=\"http://www.irc.atr.jp/std/unr/0.1\">"
           "<unr:SearchCondition>" +
           inside + "</unr:SearchCondition></condition>";
}

TEST_P(Conditions, TakeATypeByItsUrnOrItsLastPart) {
    auto const of_type = [](std::string const& type) { return element("unr:ComponentCondition", {{"type", type}}); };
    auto const in_a_group = [&](std::string const& type) { return element("unr:ComponentGroupCondition", of_type(type)); };
    for (auto const* type : {"urn:x-rois:def:component:OMG::SpeechSynthesis", "unr:x-rois:def:component:OMG::speechsynthesis",
                             "SpeechSynthesis", "speechsynthesis"}) {
        EXPECT_THAT(desk.search(wrapped(of_type(type))), ElementsAre("speech_synthesis")) << type;
        EXPECT_THAT(desk.search(wrapped(in_a_group(type))), ElementsAre("speech_synthesis")) << type;
    }
    EXPECT_THAT(desk.search(wrapped(of_type("Synthesis"))), IsEmpty());
    EXPECT_EQ(desk.search(wrapped(of_type("Robot"))).size(), desk.search().size());
    EXPECT_EQ(desk.ask("bind_any", wrapped(of_type("Reaction"))).ref(), "reaction");
    EXPECT_EQ(desk.subscribe("person_detected", wrapped(of_type("PersonDetection"))).return_code(), "OK");
    EXPECT_THAT(desk.subscribe("person_detected", wrapped(of_type("Move"))), IsRefused("UNSUPPORTED", ""));
    EXPECT_EQ(desk.query("component_status", wrapped(of_type("Follow"))).ref(), "follow");
}

TEST_P(Conditions, OfTheWrapperOfThePublishedExamples) {
    Xml const group = "<unr:ComponentGroupCondition types=\"Robot\" aliases=\"a\">" +
                      related("Within", "a/Property/location", place("Reception hall")) +
                      "<unr:ComponentCondition type=\"unr:x-rois:def:component:OMG::Move\" "
                      "mode=\"exclusive\"><fes:filter/></unr:ComponentCondition>"
                      "<unr:ComponentCondition type=\"urn:x-rois:def:component:OMG::Follow\"/></unr:ComponentGroupCondition>";
    EXPECT_THAT(desk.search(wrapped(group)), ElementsAre("follow", "move"));
    EXPECT_THAT(desk.search(wrapped("<unr:ComponentCondition>" + equal("Name", "reaction") + "</unr:ComponentCondition>")),
                ElementsAre("reaction"));
    Application rival{GetParam(), empty_hall()};
    rival.connect();
    rival.bind("move");
    EXPECT_THAT(desk.search(wrapped(group)), IsEmpty()) << "the robot has none that is free";
}

TEST_P(Conditions, AreUnderstoodByAllOperationsThatTakeOne) {
    EXPECT_THAT(
        desk.ask("get_profile", where(like("name", "mov?"))).root().child("components").first_child().attribute("ref").value(),
        testing::StrEq("move"));
    EXPECT_EQ(desk.ask("bind_any", where(like("name", "speech_s*"))).ref(), "speech_synthesis");
    EXPECT_EQ(desk.query("get_parameter", where(negation(is_null("Property/routing_policy")))).ref(), "navigation");
    auto const id = desk.set_parameter("speech_synthesis", {speech_text("hello")}).text("command_id");
    EXPECT_EQ(desk.status_of(id), "OK");
    EXPECT_THAT(desk.get_command_result(id, where(like("status", "O?"))).values(), SizeIs(1));
    EXPECT_THAT(desk.get_command_result(id, where(like("status", "?"))).values(), IsEmpty());
}

struct Robots : testing::TestWithParam<Transport> {
    static GatewayProcess& hall() {
        static GatewayProcess two{{"--floor-plan", ROIS_SOURCE_DIR "/components/simulation/data/two-robots.xml", "--scenario",
                                   ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml", "--sim-speed", "20", "--seed", "1"}};
        return two;
    }

    Robots() {
        desk.connect();
        rival.connect();
    }

    Application desk{GetParam(), hall()};
    Application rival{GetParam(), hall()};
    Xml drives = equal("component_type", "urn:x-rois:def:component:OMG::Navigation");
};
ROIS_OVER_BOTH_WAYS(Robots);

TEST_P(Robots, TheNearestFreeRobotIsBound) {
    auto const bind_nearest = [&](Application& who) { return who.ask("bind_any", ordered(drives, nearest("exhibit"))); };
    EXPECT_EQ(bind_nearest(desk).ref(), "robot2.navigation");
    EXPECT_EQ(bind_nearest(rival).ref(), "navigation");
    EXPECT_THAT(bind_nearest(rival), IsOk());
}

TEST_P(Robots, AreEnginesOfTheHall) {
    auto const name_of_profile = [&](Xml const& condition) {
        return std::string{
            desk.ask("get_profile", condition).root().child("rois:HRIEngineProfile").child("gml:name").text().get()};
    };
    auto const whole = name_of_profile({});
    auto const answer = desk.ask("get_profile");
    auto const profile = answer.root().child("rois:HRIEngineProfile");
    EXPECT_FALSE(profile.child("rois:HRIComponent"));
    std::vector<std::string> subs;
    for (auto const sub : profile.children("rois:SubProfile")) {
        subs.emplace_back(sub.child("gml:name").text().get());
        auto const components = sub.children("rois:HRIComponent");
        EXPECT_EQ(std::distance(components.begin(), components.end()), 15) << subs.back();
    }
    EXPECT_THAT(subs, ElementsAre("robot1", "robot2"));
    for (auto const& main : {whole, std::string{}}) {
        auto const of_main = where(equal("engine", main));
        EXPECT_THAT(desk.search(of_main), SizeIs(30)) << main;
        EXPECT_EQ(name_of_profile(of_main), whole);
        EXPECT_EQ(desk.ask("bind_any", of_main).ref(), "face_detection");
        EXPECT_EQ(desk.release("face_detection").return_code(), "OK");
        EXPECT_EQ(desk.query("robot_position", of_main).values().at("robot_ref").size(), 2u);
        EXPECT_EQ(desk.subscribe("reached_target", of_main).text("subscribe_id"),
                  desk.subscribe("reached_target").text("subscribe_id"))
            << "it restricts nothing";
    }
    for (auto const* robot : {"robot1", "robot2"}) {
        auto const of_robot = where(equal("engine", robot));
        std::string const prefix = robot == std::string{"robot1"} ? "" : "robot2.";
        EXPECT_THAT(desk.search(of_robot), AllOf(SizeIs(15), Contains(prefix + "navigation")));
        EXPECT_EQ(name_of_profile(of_robot), robot);
        EXPECT_EQ(desk.ask("bind_any", of_robot).ref(), prefix + "face_detection");
        EXPECT_EQ(desk.release(prefix + "face_detection").return_code(), "OK");
        EXPECT_EQ(desk.query("engine_status", of_robot).ref(), prefix + "system_information");
        EXPECT_THAT(desk.query("robot_position", of_robot).values().at("robot_ref"), ElementsAre(robot));
        EXPECT_EQ(desk.subscribe("reached_target", of_robot).return_code(), "OK");
    }
    EXPECT_THAT(desk.search(where(compared("NotEqualTo", "engine", "robot1"))), AllOf(SizeIs(15), Contains("robot2.move")));
}

TEST_P(Robots, SystemInformationReportsAllRobots) {
    auto const answer = desk.query("robot_position");
    auto const values = answer.values();
    EXPECT_EQ(answer.ref(), "system_information");
    EXPECT_THAT(values.at("robot_ref"), ElementsAre("robot1", "robot2"));
    EXPECT_THAT(values.at("position_data"), SizeIs(2));
    EXPECT_THAT(values.at("timestamp"), SizeIs(1));
    std::vector<std::string> located;
    for (auto const each : answer.root().child("results").children("located")) {
        located.emplace_back(each.attribute("ref").value());
        EXPECT_STREQ(each.attribute("crs").value(), "urn:x-rois:def:crs:simulation::hall") << "the main engine's frame";
    }
    EXPECT_THAT(located, ElementsAre("robot1", "robot2"));
    auto const status = desk.query("engine_status").values();
    EXPECT_THAT(status.at("status"), ElementsAre("READY"));
    EXPECT_THAT(status.at("operable_time"), SizeIs(1));
}

// One visitor walks in from the entrance to (9000, 4500) and stays there.
struct Visitor : testing::TestWithParam<Transport> {
    Visitor() {
        desk.connect();
        desk.bind("person_localization");
    }

    void localize() { desk.execute(Command{.component = "person_localization"}); }

    GatewayProcess hall{{"--scenario", ROIS_SOURCE_DIR "/tests/server/data/one_visitor.xml", "--sim-speed", "20", "--seed", "3"}};
    Application desk{GetParam(), hall};
};
ROIS_OVER_BOTH_WAYS(Visitor);

TEST_P(Visitor, IsReportedOnlyWithinTheBox) {
    auto const there =
        desk.subscribe("person_localized", where(related("Within", "position_data", box("8000 3500", "10000 5500"))), true);
    EXPECT_THAT(there, IsOk());
    localize();
    auto const event = desk.next_event("person_localized");
    EXPECT_EQ(event.text("subscribe_id"), there.text("subscribe_id"));
    std::string const text = event.root().child("results").child("located").child("position").text().get();
    EXPECT_GE(std::stod(text), 8000) << text;
    EXPECT_GE(std::stod(text.substr(text.find(' '))), 3500) << "no target may be reported on the way: " << text;
}

TEST_P(Visitor, IsNotLocalizedBelowTheLowestThresholdOfTheProfile) {
    auto const profile = desk.ask("get_profile", where(equal("component_ref", "person_localization"))).whole();
    EXPECT_THAT(profile, HasSubstr("At least 125, because of the noise of this robot's sensor."));
    EXPECT_THAT(profile, HasSubstr("rois:default_value=\"200\""));
    auto const refused = desk.set_parameter("person_localization", {{"detection_threshold", "int", {"124"}}});
    EXPECT_THAT(refused, IsRefused("BAD_PARAMETER", "124 mm is less than the minimum of 125 mm"));
    EXPECT_THAT(desk.set_parameter("person_localization", {{"detection_threshold", "int", {"125"}}}), IsOk());
}

struct TalkingVisitor : testing::TestWithParam<Transport> {
    GatewayProcess hall{
        {"--scenario", ROIS_SOURCE_DIR "/tests/server/data/talking_visitor.xml", "--sim-speed", "20", "--seed", "3"}};
    Application desk{GetParam(), hall};
};
ROIS_OVER_BOTH_WAYS(TalkingVisitor);

TEST_P(TalkingVisitor, IsRecognizedOnlyWhenAskingForHelp) {
    desk.connect();
    desk.bind("speech_recognition");
    Xml const asks =
        "<fes:PropertyIsLike wildCard=\"*\" singleChar=\"?\" escapeChar=\"!\" matchCase=\"false\">"
        "<fes:ValueReference>recognized_text</fes:ValueReference><fes:Literal>*help*</fes:Literal></fes:PropertyIsLike>";
    EXPECT_THAT(desk.subscribe("speech_recognized", where(asks), true), IsOk());
    desk.execute(Command{.component = "speech_recognition"});
    EXPECT_THAT(desk.next_event("speech_recognized").values()["recognized_text"], ElementsAre("Can you HELP me, please?"));
}

}  // namespace
}  // namespace rois::test
