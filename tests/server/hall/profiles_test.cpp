// Component profiles of users: the check, the components made from them, and reading them again while the gateway runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <signal.h>

#include "kit/profile_folder.hpp"
#include "server/application.hpp"
#include "server/http_client.hpp"

namespace rois::test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string const includes_common =
    "<rois:SubComponentProfile>urn:x-rois:def:Component:OMG::RoISCommon</rois:SubComponentProfile>";

TEST(CheckProfiles, SucceedsWithWarnings) {
    ProfileFolder const folder;
    EXPECT_EQ(run_gateway({"--check-profiles", folder.name()}).out, "0 files: 0 ok, 0 with warnings, 0 refused\n");
    folder.put("b.xml", profile_document("urn:b", "<rois:SubComponentProfile>urn:a</rois:SubComponentProfile>"));
    folder.put("z.xml", profile_document("urn:a",
                                         "<rois:ParameterProfile name='p'><rois:data_type_ref rois:code='int'/>"
                                         "</rois:ParameterProfile>"));
    auto const ended = run_gateway({"--check-profiles", folder.name()});
    EXPECT_EQ(ended.exit_code, 0) << ended.out;
    EXPECT_THAT(ended.out, HasSubstr("2 files: 1 ok, 1 with warnings, 0 refused\n"));
}

TEST(CheckProfiles, WarnsOfUnknownTypesLikeTheStart) {
    ProfileFolder const folder;
    folder.put("a.xml", profile_document("urn:a",
                                         "<rois:ParameterProfile rois:name='p'>\n<rois:data_type_ref rois:code='Shade'/>"
                                         "</rois:ParameterProfile>"));
    auto const ended = run_gateway({"--check-profiles", folder.name()});
    EXPECT_EQ(ended.exit_code, 0) << ended.out;
    std::string const finding = "a.xml:4:1: unknown data type 'Shade' of 'p': its values are not checked\n";
    EXPECT_THAT(ended.out, HasSubstr("warning: " + finding));
    GatewayProcess gateway{{"--profiles", folder.name()}};
    gateway.signal(SIGTERM);
    EXPECT_THAT(gateway.wait().error, HasSubstr("profiles: " + finding));
}

TEST(CheckProfiles, NeedsAFolder) {
    auto const ended = run_gateway({"--check-profiles", "/nowhere/at.all"});
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_THAT(ended.error, AllOf(StartsWith("rois-gateway: /nowhere/at.all: cannot be read: "), HasSubstr("No such file")));
    EXPECT_EQ(run_gateway({"--check-profiles"}).exit_code, 2);
}

std::string const stand_in = "<gml:metaDataProperty xlink:href=\"urn:x-rois:def:adapter:simulation::stand_in\"/>";

// A simulated lamp; its query `light` returns this.
std::string lamp(std::string const& colour) {
    return profile_document("urn:test::Lamp",
                            includes_common +
                                "<rois:MessageProfile xsi:type='rois:QueryMessageProfileType' rois:name='light'><rois:Results "
                                "rois:name='colour' rois:default_value='" +
                                colour + "'><rois:data_type_ref rois:code='String'/></rois:Results></rois:MessageProfile>",
                            stand_in);
}

std::string fan() { return profile_document("urn:test::Fan", includes_common, stand_in); }

class ProfilesOfUsers : public testing::TestWithParam<Transport> {
protected:
    ProfileFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(BothWays, ProfilesOfUsers, testing::ValuesIn(all_transports), testing::PrintToStringParamName());

TEST_P(ProfilesOfUsers, MakeComponents) {
    GatewayProcess gateway{{"--profiles", ROIS_SOURCE_DIR "/components/simulation/profiles"}};
    Application desk{GetParam(), gateway};
    desk.connect();
    EXPECT_THAT(desk.search(where(equal("component_type", "urn:x-rois:def:component:RoISGateway::PersonMonitor"))),
                ElementsAre("person_monitor"));
    EXPECT_EQ(desk.search().size(), 20U);
    auto const profile = desk.ask("get_profile", where(equal("component_ref", "person_monitor")));
    EXPECT_THAT(profile.children(), ElementsAre("rois:HRIEngineProfile", "components", "rois:HRIComponentProfile"));
    for (auto const& document : {profile.whole(), HttpClient{gateway}.get("/rois/profile/person_monitor").body}) {
        EXPECT_THAT(document, HasSubstr("<rois:SubComponentProfile>urn:x-rois:def:component:OMG::PersonDetection<"));
        EXPECT_THAT(document, HasSubstr("rois:name=\"person_detected\""));
        EXPECT_THAT(document, HasSubstr("rois:name=\"suspend\"")) << "of what it includes indirectly";
    }
    EXPECT_THAT(desk.query("wc_status_change").values(), testing::Contains(testing::Pair("wc_status", ElementsAre("stopped"))));
    EXPECT_EQ(desk.bind("wheelchair_robot").return_code(), "OK");
    auto const brake = [&](std::vector<Argument> const& arguments) {
        return desk.execute(Command{"wheelchair_robot", "brake", "b", arguments});
    };
    EXPECT_THAT(brake({}).reason(), HasSubstr("the argument 'status' is missing"));
    EXPECT_THAT(brake({{"status", "int", {"1"}}}).reason(), HasSubstr("its type is bool"));
    EXPECT_EQ(brake({{"status", "Boolean", {"true"}}}).return_code(), "OK");
    EXPECT_EQ(desk.status_of("b"), "OK");
}

// Annex C.4 sets `behaviour_tag` and gets `behavior_tag`.
TEST_P(ProfilesOfUsers, NameTheTagOfAWheelchairInBothPublishedSpellings) {
    GatewayProcess gateway{{"--profiles", ROIS_SOURCE_DIR "/components/simulation/profiles", "--scenario",
                            ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml", "--sim-speed", "20"}};
    Application desk{GetParam(), gateway};
    desk.connect();
    desk.bind("wheelchair_robot");
    EXPECT_EQ(desk.set_parameter("wheelchair_robot", {{"behavior_tag", "string", {"desk"}}}).return_code(), "OK");
    auto const parameters = desk.get_parameter("wheelchair_robot").values("parameters");
    EXPECT_THAT(parameters, testing::Contains(testing::Pair("behaviour_tag", ElementsAre("desk"))));
    EXPECT_EQ(parameters.count("behavior_tag"), 0U) << "it is reported in one spelling";
    EXPECT_EQ(desk.query("get_parameter", where(equal("Property/behavior_tag", "desk"))).ref(), "wheelchair_robot");
    EXPECT_EQ(
        desk.set_parameter("wheelchair_robot", {{"behaviour_tag", "string", {"start"}}, {"behavior_tag", "string", {"desk"}}})
            .reason(),
        "parameter 'behavior_tag' is given twice");
}

TEST_P(ProfilesOfUsers, BrakeAWheelchair) {
    GatewayProcess gateway{{"--profiles", ROIS_SOURCE_DIR "/components/simulation/profiles", "--scenario",
                            ROIS_SOURCE_DIR "/tests/server/data/empty_hall.xml", "--sim-speed", "20"}};
    Application desk{GetParam(), gateway};
    desk.connect();
    for (auto const* ref : {"wheelchair_robot", "speech_synthesis"}) desk.bind(ref);
    desk.subscribe("wc_status_change", "", true);
    auto const next_status = [&] { return desk.next_event("wc_status_change").values().at("wc_status").at(0); };
    auto const brake = [&](std::string const& status) {
        desk.execute(Command{"wheelchair_robot", "brake", "brake " + status, {{"status", "bool", {status}}}});
        EXPECT_EQ(desk.status_of("brake " + status), "OK");
    };
    std::vector<std::string> there_and_back;
    for (int i = 0; i < 25; ++i) there_and_back.insert(there_and_back.end(), {"meeting_room", "cloakroom"});
    desk.execute(Command{"wheelchair_robot", "start", "drive", {target_position(there_and_back)}});
    EXPECT_EQ(next_status(), "running");
    brake("true");
    auto const held = desk.query("wc_status_change").values();
    EXPECT_THAT(held.at("brake_status"), ElementsAre("true"));
    EXPECT_THAT(held.at("wc_status"), ElementsAre("brakes"));
    EXPECT_THAT(held.at("nav_status"), ElementsAre("running"));
    desk.execute(Command{"speech_synthesis", "start", "time passes", {speech_text("One, two, three, four, five.")}});
    EXPECT_EQ(desk.status_of("time passes"), "OK");
    EXPECT_EQ(desk.query("wc_status_change").values(), held) << "it stands";
    brake("false");
    desk.execute(Command{"speech_synthesis", "start", "more time", {speech_text("One, two, three, four, five.")}});
    EXPECT_EQ(desk.status_of("more time"), "OK");
    EXPECT_NE(desk.query("wc_status_change").values().at("position"), held.at("position"));
    EXPECT_EQ(desk.get_command_result("drive").values().at("status").at(0), "RUNNING");
}

TEST_P(ProfilesOfUsers, MakeComponentsThatAScenarioLetsFail) {
    folder_.put("fan.xml", fan());
    folder_.put("day.scenario",
                "<scenario xmlns='urn:x-rois:simulation:hall:1' name='day'>\n<fault component='fan' kind='failed'/></scenario>");
    auto const scenario = folder_.name() + "/day.scenario";
    GatewayProcess const gateway{{"--profiles", folder_.name(), "--scenario", scenario}};
    Application desk{GetParam(), gateway};
    desk.connect();
    EXPECT_THAT(desk.search(where(equal("status", "ERROR"))), ElementsAre("fan"));
    auto const without = run_gateway({"--scenario", scenario, "--check-config"});
    EXPECT_EQ(without.exit_code, 2);
    EXPECT_THAT(without.error, HasSubstr("day.scenario:2:1: unknown component 'fan'"));
}

TEST_P(ProfilesOfUsers, AreReadAgainAfterAHangUp) {
    folder_.put("lamp.xml", lamp("red"));
    GatewayProcess gateway{{"--profiles", folder_.name()}};
    HttpClient client{gateway};
    auto const engine_before = client.get("/rois/profile").header("ETag");
    auto const lamp_before = client.get("/rois/profile/lamp").header("ETag");
    Application desk{GetParam(), gateway};
    desk.connect();
    EXPECT_EQ(desk.bind("lamp").return_code(), "OK");

    folder_.put("fan.xml", fan());
    gateway.signal(SIGHUP);
    EXPECT_EQ(desk.receive().name(), "profile_changed");
    EXPECT_THAT(desk.search(), AllOf(testing::Contains("fan"), testing::Contains("lamp")));
    EXPECT_EQ(desk.execute(Command{"lamp", "start", "still mine"}).return_code(), "OK") << "the lamp has not changed";
    EXPECT_EQ(desk.status_of("still mine"), "OK");
    EXPECT_NE(client.get("/rois/profile").header("ETag"), engine_before);
    EXPECT_EQ(client.get("/rois/profile/lamp").header("ETag"), lamp_before);

    folder_.put("lamp.xml", lamp("green"));
    gateway.signal(SIGHUP);
    EXPECT_EQ(desk.receive().name(), "profile_changed");
    EXPECT_EQ(desk.execute(Command{"lamp"}).return_code(), "ERROR") << "another lamp is not bound";
    EXPECT_THAT(desk.query("light").values().at("colour"), ElementsAre("green"));
    EXPECT_NE(client.get("/rois/profile/lamp").header("ETag"), lamp_before);

    folder_.remove("lamp.xml");
    folder_.remove("fan.xml");
    gateway.signal(SIGHUP);
    EXPECT_EQ(desk.receive().name(), "profile_changed");
    EXPECT_EQ(desk.bind("lamp").return_code(), "BAD_PARAMETER");
    EXPECT_EQ(client.get("/rois/profile/lamp").status, 404);
}

TEST_P(ProfilesOfUsers, ThatAreInvalidLeaveTheComponentsUnchanged) {
    folder_.put("lamp.xml", lamp("red"));
    folder_.put("broken.xml", "<rois");
    GatewayProcess gateway{{"--profiles", folder_.name()}};
    Application desk{GetParam(), gateway};
    desk.connect();
    EXPECT_EQ(desk.bind("lamp").return_code(), "OK");
    folder_.put("lamp.xml", lamp("red") + "<and/>");
    folder_.put("fan.xml", fan());
    gateway.signal(SIGHUP);
    EXPECT_THAT(gateway.log_with("nothing is changed"), HasSubstr("nothing is changed: the folder of profiles: lamp.xml:"));
    EXPECT_EQ(desk.execute(Command{"lamp", "start", "on"}).return_code(), "OK") << "it is still there and bound";
    EXPECT_EQ(desk.status_of("on"), "OK");
    EXPECT_EQ(desk.bind("fan").return_code(), "BAD_PARAMETER") << "all changes or none";
    folder_.put("lamp.xml", lamp("red"));
    gateway.signal(SIGHUP);
    EXPECT_EQ(desk.receive().name(), "profile_changed");
    EXPECT_EQ(desk.bind("fan").return_code(), "OK") << "a file that was refused before does not matter";
    desk.disconnect();
    gateway.signal(SIGTERM);
    EXPECT_THAT(gateway.wait().error, HasSubstr("profiles: refused: broken.xml:1:1: "));
}

TEST_P(ProfilesOfUsers, WithOneNameReplaceEachOther) {
    folder_.put("a.xml", lamp("red"));
    folder_.put("b.xml", profile_document("urn:test2::Lamp", includes_common, stand_in));
    GatewayProcess gateway{{"--profiles", folder_.name()}};
    Application desk{GetParam(), gateway};
    desk.connect();
    auto const lamps_of_b = where(equal("component_type", "urn:test2::Lamp"));
    EXPECT_THAT(desk.search(lamps_of_b), testing::IsEmpty());
    folder_.remove("a.xml");
    gateway.signal(SIGHUP);
    EXPECT_EQ(desk.receive().name(), "profile_changed");
    EXPECT_THAT(desk.search(lamps_of_b), ElementsAre("lamp"));
}

std::string adapter(std::string const& name) {
    return "\n<gml:metaDataProperty xlink:href=\"urn:x-rois:def:adapter:simulation::" + name + "\"/>";
}

// Valid profiles that make no component, and the message about each.
struct Idlers {
    Idlers() {
        folder.put("b.xml", profile_document("urn:test::Navigation", includes_common, stand_in));
        folder.put("c.xml", profile_document("urn:test::Lost", includes_common, adapter("magic")));
        folder.put("d.xml", lamp("red"));
        folder.put("e.xml", named("lamp"));
        folder.put("f.xml", named("navigation"));
        folder.put("g.xml", profile_document("urn:test::Part",
                                             "<rois:SubComponentProfile>urn:test::Lost</rois:SubComponentProfile>", stand_in));
    }

    static std::string named(std::string const& name) {
        auto document = profile_document("urn:test::" + name + "Again", includes_common, adapter("stand_in"));
        return document.insert(document.find("<rois:Sub"), "<gml:name>" + name + "</gml:name>");
    }

    ProfileFolder folder;
    std::vector<std::string> const lines{
        "refused: b.xml:2:1: there is a component 'navigation' already: it is the gateway's own\n",
        "refused: c.xml:2:1: unknown adapter 'magic'; expected one of ",
        "refused: e.xml:4:1: there is a component 'lamp' already: it is that of d.xml\n",
        "refused: f.xml:4:1: there is a component 'navigation' already: it is the gateway's own\n",
        "refused: g.xml:3:1: no component profile 'urn:test::Lost' is known\n"};
};

TEST(CheckProfiles, ReportsProfilesWithoutAComponentLikeTheStart) {
    Idlers const idlers;
    auto const ended = run_gateway({"--check-profiles", idlers.folder.name()});
    EXPECT_EQ(ended.exit_code, 1);
    for (auto const& line : idlers.lines) EXPECT_THAT(ended.out, HasSubstr(line));
    EXPECT_THAT(ended.out, AllOf(HasSubstr("d.xml: ok\n"), HasSubstr("6 files: 1 ok, 0 with warnings, 5 refused\n")));
    GatewayProcess gateway{{"--profiles", idlers.folder.name()}};
    gateway.signal(SIGTERM);
    auto const log = gateway.wait().error;
    for (auto const& line : idlers.lines) EXPECT_THAT(log, HasSubstr("profiles: " + line));
}

TEST(ProfilesAtTheStart, AreReportedInTheLog) {
    ProfileFolder const folder;
    folder.put("a.xml", profile_document("urn:test::Idle", includes_common));
    folder.put("d.xml", lamp("red"));
    GatewayProcess gateway{{"--profiles", folder.name()}};
    gateway.signal(SIGTERM);
    auto const log = gateway.wait().error;
    for (auto const* line : {"a.xml: urn:test::Idle has no adapter, so no component is made", "d.xml: adds the component lamp\n"})
        EXPECT_THAT(log, HasSubstr(line));
}

TEST(ProfilesAtTheStart, AMissingFolderIsAnError) {
    auto const ended = run_gateway({"--profiles", "/nowhere/at.all"});
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_THAT(ended.error, HasSubstr("/nowhere/at.all: cannot be read"));
    EXPECT_EQ(run_gateway({"--check-config"}, {{"ROIS_PROFILES", "/nowhere/at.all"}}).exit_code, 2);
}

TEST(EngineParameters, AreInItsProfile) {
    GatewayProcess gateway{{"--sim-speed", "2.5"}};
    HttpClient client{gateway};
    auto const document = client.get("/rois/profile").body;
    EXPECT_THAT(document, HasSubstr("<rois:ParameterProfile rois:name=\"sim_speed\" rois:default_value=\"2.5\""));
    EXPECT_THAT(document, HasSubstr("rois:name=\"crs\" rois:default_value=\"urn:x-rois:def:crs:simulation::hall\""));
    EXPECT_THAT(document, HasSubstr("rois:name=\"instance\""));
    Application desk{Transport::http, gateway};
    desk.connect();
    EXPECT_THAT(desk.ask("get_profile").whole(), HasSubstr("rois:name=\"sim_speed\""));
    EXPECT_THAT(client.get("/rois/profile/navigation").body,
                HasSubstr("rois:codebook_ref=\"urn:x-rois:def:crs:simulation::hall\""));
}

}  // namespace
}  // namespace rois::test
