// The `rois` program against the real gateway.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

#include "command/rois_fixture.hpp"
#include "kit/profile_folder.hpp"

namespace rois::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST_F(Rois, SearchesByConditionTextOrFile) {
    EXPECT_EQ(run({"search", "type", "=", "Navigation"}).out, "navigation  Navigation\n");
    EXPECT_EQ(objects({"search", "--where", "type = Navigation or type = Move"})[0]["component_ref_list"],
              (json{"move", "navigation"}));
    auto const filter = file_with("filter.xml",
                                  "<?xml version='1.0'?>\n<fes:Filter xmlns:fes='http://www.opengis.net/fes/2.0'>"
                                  "<fes:PropertyIsEqualTo><fes:ValueReference>name</fes:ValueReference>"
                                  "<fes:Literal>reaction</fes:Literal></fes:PropertyIsEqualTo></fes:Filter>");
    EXPECT_EQ(run({"search", "--condition", filter}).out, "reaction  Reaction\n");
    auto const wrong =
        file_with("wrong.xml", "<fes:Filter xmlns:fes='http://www.opengis.net/fes/2.0'>\n  <fes:Nothing/></fes:Filter>");
    expect(2, wrong + ":2:3: ", {"search", "--condition", wrong});
    expect(2, "type =\n        ^", {"search", "type", "="});
    expect(3, "search: BAD_PARAMETER", {"search", "colour = red"});
}

TEST_F(Rois, ShowsProfiles) {
    EXPECT_THAT(run({"profile"}).out,
                AllOf(HasSubstr("reception"), HasSubstr("\nspeech_synthesis       SpeechSynthesis       robot1\n")));
    EXPECT_THAT(run({"profile", "navigation"}).out,
                AllOf(HasSubstr("reached_target"), HasSubstr("time_limit       int       = 0")));
    EXPECT_EQ(objects({"profile", "reaction"})[0]["identifier"], "urn:x-rois:def:component:OMG::Reaction");
    EXPECT_THAT(run({"profile", "reaction", "--xml"}).out, StartsWith("<rois:HRIComponentProfile"));
}

// Members of logical components are only shown to those who ask for them.
TEST(RoisWithLogicalComponents, FindsAMemberByItsRef) {
    kit::ProfileFolder const folder;
    folder.put("engines.json", R"({
        "engines": [{"name": "robot1", "joins": "robot1"}],
        "choosing": {"logical": ["navigation"], "engines": ["robot1"]}})");
    GatewayProcess gateway{{"--robots", "none", "--engines", folder.name() + "/engines.json"}};
    GatewayProcess const robot{{"--join", gateway.url(), "--join-as", "robot1"}};
    gateway.log_with("present with");
    auto const run = [&](std::vector<std::string> const& arguments) {
        return run_rois(arguments, {}, {{"ROIS_URL", gateway.url()}});
    };
    EXPECT_THAT(run({"profile"}).out, AllOf(HasSubstr("\nnavigation "), Not(HasSubstr("robot1.navigation"))));
    EXPECT_THAT(run({"profile", "robot1.navigation"}).out, HasSubstr("reached_target"));
    EXPECT_EQ(run({"set", "robot1.navigation", "time_limit=7000"}).exit_code, 0);
    EXPECT_EQ(run({"execute", "robot1.navigation", "stop"}).exit_code, 0);
    auto const unknown = run({"profile", "robot2.navigation"});
    EXPECT_EQ(unknown.exit_code, 3);
    EXPECT_THAT(unknown.error, HasSubstr("unknown component 'robot2.navigation'"));
}

TEST_F(Rois, QueriesInThreeForms) {
    EXPECT_THAT(run({"query", "robot_position"}).out, StartsWith("system_information\ntimestamp"));
    EXPECT_EQ(objects({"query", "component_status", "--of", "move"})[0]["results"], (json{{"status", "READY"}}));
    EXPECT_THAT(run({"query", "robot_position", "--xml"}).out, StartsWith("<query_response"));
    expect(4, "query: UNSUPPORTED", {"query", "weather"});
    auto const refused = run({"query", "weather", "--json"});
    EXPECT_EQ(refused.exit_code, 4);
    EXPECT_EQ(json::parse(refused.out)["return_code"], "UNSUPPORTED") << "a document like others";
    EXPECT_EQ(refused.error, "");
}

TEST_F(Rois, SetsAndGetsParametersByTheirTypes) {
    EXPECT_EQ(run({"set", "navigation", "time_limit=7000", "target_position=desk", "target_position=start"}).out,
              "set_parameter navigation  OK\n");
    EXPECT_EQ(objects({"get", "navigation"})[0]["parameters"], (json{{"routing_policy", "time"}, {"time_limit", 0}}))
        << "the defaults again: a parameter keeps its value only as long as the binding";
    expect(2, "time_limit: 'soon' is not of the type int", {"set", "navigation", "time_limit=soon"});
    expect(2, "has no argument 'speed'; it has target_position", {"set", "navigation", "speed=1"});
}

TEST_F(Rois, StartsStopsAndExecutes) {
    EXPECT_EQ(run({"start", "speech_synthesis", "speech_text=Hi."}).out, "start speech_synthesis  OK\n");
    EXPECT_EQ(run({"stop", "navigation"}).out, "stop navigation  OK\n");
    auto const failed = run({"execute", "navigation", "resume"});
    EXPECT_EQ(failed.exit_code, 1);
    EXPECT_THAT(failed.out, testing::MatchesRegex("resume navigation  ERROR  .*suspend.*\n")) << "with the reason";
    EXPECT_EQ(failed.error, "");
    expect(1, "resume navigation: ERROR: ", {"execute", "navigation", "resume", "--json"});
    EXPECT_THAT(run({"start", "navigation", "target_position=-5000,-5000,0"}).out, HasSubstr("start navigation  ERROR  "));
    expect(3, "has no command 'fly'", {"execute", "navigation", "fly"});
    expect(6, "", {"start", "navigation", "target_position=desk", "time_limit=1"});
    auto const sequence =
        file_with("sequence.xml",
                  "<rois:CommandUnitSequence xmlns:rois='http://www.omg.org/spec/RoIS/20240801' "
                  "xmlns:xsi='http://www.w3.org/2001/XMLSchema-instance'>\n"
                  "<rois:command_unit_list xsi:type='rois:CommandMessageType' rois:command_type='start' rois:command_id=''>"
                  "<rois:component_ref rois:code='person_detection'/></rois:command_unit_list>\n"
                  "<rois:command_unit_list xsi:type='rois:CommandMessageType' rois:command_type='stop' rois:command_id=''>"
                  "<rois:component_ref rois:code='person_detection'/></rois:command_unit_list>\n"
                  "</rois:CommandUnitSequence>");
    EXPECT_EQ(run({"execute", sequence}).out, "start person_detection  OK\nstop person_detection  OK\n");
    EXPECT_THAT(run({"execute", "person_detection", "start", "--results"}).out, HasSubstr("status  "));
    EXPECT_EQ(run({"execute", sequence, "--check-only"}).out, "possible; nothing has run\n");
    expect(3, "time_limit", {"execute", "navigation", "start", "target_position=desk", "time_limit=-5", "--check-only"});
    expect(2, "cannot be read", {"execute", "/no/such/file.xml"});
}

TEST_F(Rois, RejectsAFolderInPlaceOfAFile) {
    auto const folder = std::filesystem::path{file_named("")}.parent_path().string();
    for (auto const& arguments : std::vector<std::vector<std::string>>{{"send", folder},
                                                                       {"execute", folder},
                                                                       {"scenario", folder},
                                                                       {"replay", folder},
                                                                       {"search", "--condition", folder}}) {
        auto const ended = run(arguments);
        EXPECT_EQ(ended.exit_code, 2) << arguments.front();
        EXPECT_EQ(ended.out, "") << arguments.front();
        EXPECT_EQ(ended.error, "rois: " + folder + " cannot be read: this is a directory; name a file in it\n")
            << arguments.front();
    }
}

TEST_F(Rois, WritesADocumentForItsOwnErrors) {
    struct Refused {
        std::vector<std::string> arguments;
        int code;
        std::string operation;
        std::string says;
    };
    for (auto const& [arguments, code, operation, says] : std::vector<Refused>{
             {{"profile", "elevator"}, 3, "get_profile", "unknown component 'elevator'; there are "},
             {{"get", "elevator"}, 3, "get_profile", "unknown component 'elevator'; there are "},
             {{"get", "navigation", "speed"}, 3, "get_parameter", "navigation has no parameter 'speed' that is set; it has "},
             {{"query", "component_status", "--of", "elevator"}, 3, "get_profile", "unknown component 'elevator'; "},
             {{"set", "elevator", "floor=1"}, 3, "get_profile", "unknown component 'elevator'; there are "},
             {{"watch", "rain"}, 4, "subscribe", "no component has an event 'rain'; there are "},
             {{"watch", "--where", "colour = red"}, 4, "subscribe", "no event can meet the condition"},
         }) {
        auto const with = [&](std::string const& form) {
            auto all = arguments;
            all.push_back(form);
            auto ended = run(all);
            EXPECT_EQ(ended.exit_code, code) << ended.out << ended.error;
            EXPECT_EQ(ended.error, "") << "as for errors of the engine";
            return ended.out;
        };
        auto const lines = lines_of(with("--json"));
        ASSERT_EQ(lines.size(), 1u) << arguments.front();
        auto const object = json::parse(lines[0]);
        EXPECT_EQ(object["operation"], operation);
        EXPECT_EQ(object["return_code"], code == 3 ? "BAD_PARAMETER" : "UNSUPPORTED");
        EXPECT_THAT(object["reason"].get<std::string>(), StartsWith(says));
        EXPECT_THAT(with("--xml"), AllOf(StartsWith("<" + operation + "_response"), HasSubstr(">" + says)));
        expect(code, "rois: " + says, arguments);
    }
    auto const gone = run({"--session", "nobody", "release", "reaction", "--json"});
    EXPECT_EQ(gone.exit_code, 9);
    EXPECT_EQ(json::parse(gone.out)["fault"], "no_session");
    EXPECT_THAT(run({"--session", "nobody", "release", "reaction", "--xml"}).out, HasSubstr("code=\"no_session\""));
}

TEST_F(Rois, WritesNoDocumentWithoutARequest) {
    for (auto const& [arguments, code] : std::vector<std::pair<std::vector<std::string>, int>>{
             {{"search", "type", "=", "--json"}, 2},
             {{"send", "/no/such/file.xml", "--xml"}, 2},
             {{"set", "navigation", "speed=1", "--json"}, 2},
             {{"search", "--url", "http://127.0.0.1:1", "--timeout", "2", "--json"}, 8}}) {
        auto const ended = run(arguments);
        EXPECT_EQ(ended.exit_code, code) << ended.error;
        EXPECT_EQ(ended.out, "");
        EXPECT_THAT(ended.error, StartsWith("rois: "));
    }
}

TEST_F(Rois, StopsTheRobotWhenItIsInterrupted) {
    RoisProcess driving{{"start", "navigation", "target_position=exit", "time_limit=0"}, at()};
    RoisProcess watching{{"watch", "reached_target", "--where", "component_ref = navigation"}, at()};
    watching.line_with("open");
    // The component is bound as soon as the command runs.
    std::string bound;
    for (int i = 0; i < 500 && bound.empty(); ++i) bound = run({"search", "name = navigation and bound = true"}).out;
    ASSERT_THAT(bound, StartsWith("navigation"));
    driving.signal(SIGINT);
    EXPECT_EQ(driving.wait().exit_code, 130);
    EXPECT_EQ(objects({"search", "name = navigation and bound = false"})[0]["component_ref_list"], json{"navigation"});
    watching.signal(SIGTERM);
    EXPECT_EQ(watching.wait().exit_code, 0);
}

TEST_F(Rois, HoldsASessionForOtherCommands) {
    RoisProcess holding{{"bind", "reaction", "speech_synthesis"}, at()};
    auto const id = holding.line_with("session ").substr(8);
    expect(5, "OUT_OF_RESOURCES", {"start", "reaction", "reaction_ref=9"});
    EXPECT_EQ(run({"--session", id, "start", "reaction", "reaction_ref=9"}).out, "start reaction  OK\n");
    EXPECT_EQ(run({"--session", id, "set", "speech_synthesis", "volume=7"}).exit_code, 0);
    EXPECT_EQ(objects({"--session", id, "get", "speech_synthesis", "volume"})[0]["parameters"], (json{{"volume", 7}}));
    EXPECT_EQ(objects({"get", "speech_synthesis", "volume"})[0]["parameters"], (json{{"volume", 50}}))
        << "others read the default";
    EXPECT_EQ(run({"--session", id, "subscribe", "person_detected"}).exit_code, 0);
    EXPECT_THAT(objects({"--session", id, "start", "speech_synthesis", "speech_text=Hi.", "--no-wait"})[0]["commands"].size(), 1);
    EXPECT_THAT(run({"--session", id, "watch", "--for", "1"}).out, HasSubstr("completed"));
    EXPECT_EQ(run({"--session", id, "release", "reaction"}).exit_code, 0);
    EXPECT_EQ(run({"start", "reaction", "reaction_ref=9"}).exit_code, 0);
    expect(2, "release needs a session", {"release", "reaction"});
    expect(2, "without --session", {"start", "reaction", "--no-wait"});
    holding.signal(SIGINT);
    EXPECT_EQ(holding.wait().exit_code, 0);
}

TEST_F(Rois, ListsTheAlternativesToAnUnknownName) {
    expect(3, "unknown component 'elevator'; there are face_detection, ", {"start", "elevator"});
    expect(3, "unknown component 'elevator'; there are ", {"stop", "elevator"});
    expect(3, "unknown component 'elevator'; there are ", {"watch", "--start", "elevator"});
    expect(4, "; there are the queries component_status, ", {"query", "weather"});
    expect(4, "; there are the events ", {"subscribe", "rain"});
    expect(0, "no component meets the condition; the engine has ", {"search", "type = Elevator"});
    expect(0, "navigation (Navigation)", {"search", "name = elevator"});
    expect(4, "; the engine has face_detection (", {"bind", "--where", "type = Elevator"});
    expect(4, "; move has the queries ", {"query", "robot_positio", "--of", "move"});
    expect(4, "; the query is answered by system_information (engine robot1)",
           {"query", "robot_position", "--where", "engine = robot7"});
}

TEST_F(Rois, RemarksOnAnEmptyResult) {
    for (std::string const form : {"--json", "--xml"}) {
        expect(0, "no component meets the condition; the engine has ", {"search", form, "name = elevator"});
        expect(0, "no event arrived within the time of --for", {"watch", form, "gesture_recognized", "--for", "0"});
    }
    expect(4, "; person_detection has no parameters", {"get", "person_detection"});
    expect(0, "no event arrived within the time of --for", {"watch", "gesture_recognized", "--for", "0"});
    expect(6, "only 0 of 3 events arrived within the time of --for",
           {"watch", "gesture_recognized", "--count", "3", "--for", "0"});
}

TEST_F(Rois, EndsItsSessionWhenTwoSignalsArriveAtOnce) {
    RoisProcess holding{{"bind", "reaction"}, at()};
    holding.line_with("session ");
    holding.signal(SIGINT);
    holding.signal(SIGTERM);
    EXPECT_EQ(holding.wait().exit_code, 0);
    EXPECT_EQ(objects({"search", "name = reaction and bound = false"})[0]["component_ref_list"], json{"reaction"});
}

TEST_F(Rois, BindsAComponentByConditionForAGivenTime) {
    auto const ended = run({"bind", "--where", "type = Move", "--for", "0"});
    EXPECT_EQ(ended.exit_code, 0) << ended.error;
    EXPECT_THAT(ended.out, StartsWith("bound move\nsession "));
    EXPECT_EQ(lines_of(ended.out).size(), 2u) << "no line for the connection: " << ended.out;
    expect(2, "bind needs components", {"bind"});
    expect(3, "unknown component 'elevator'", {"bind", "elevator"});
}

TEST_F(Rois, ShowsEventsAtOnce) {
    auto const said = objects({"watch", "person_detected", "--start", "person_detection", "--count", "1"});
    EXPECT_EQ(said.back()["notification"], "receive_event");
    EXPECT_TRUE(said.back()["results"]["number"].is_number());
    RoisProcess subscribed{{"subscribe", "person_detected", "--where", "number >= 0"}, at()};
    EXPECT_THAT(subscribed.line(), StartsWith("s-"));
    RoisProcess starting{{"start", "person_detection", "--for", "60"}, at()};
    EXPECT_THAT(subscribed.line(), HasSubstr("person_detected  person_detection  timestamp="));
}

TEST_F(Rois, EndsQuietlyWhenItsReaderEnds) {
    RoisProcess watching{{"watch", "person_detected", "--start", "person_detection", "--for", "60"}, at()};
    watching.line_with("open");
    watching.stop_reading();
    auto const ended = watching.wait();
    EXPECT_EQ(ended.exit_code, 130);
    EXPECT_EQ(ended.error, "");
}

TEST(AGatewayThatRestarts, IsWatchedAgain) {
    auto gateway = std::make_unique<GatewayProcess>();
    Variables const there{{"ROIS_URL", gateway->url()}};
    RoisProcess watching{{"watch", "person_detected", "--start", "person_detection", "--for", "90", "--json"}, there};
    RoisProcess keeping{{"start", "sound_detection", "--for", "90"}, there};
    watching.line_with("receive_event");
    keeping.line_with("OK");
    std::vector<std::string> const listen{"--listen", "127.0.0.1:" + std::to_string(gateway->port())};
    gateway.reset();
    GatewayProcess const again{listen};
    watching.line_with("\"gap\":\"new_session\"");
    watching.line_with("receive_event");
    watching.signal(SIGINT);
    EXPECT_EQ(watching.wait().exit_code, 0);
    auto const ended = keeping.wait();
    EXPECT_EQ(ended.exit_code, 7) << ended.out;
    EXPECT_THAT(ended.error, HasSubstr("the session has ended, and its commands with it"));
}

TEST(AGatewayThatIsNotThereYet, IsWaitedForAndReported) {
    auto gateway = std::make_unique<GatewayProcess>();
    auto const port = std::to_string(gateway->port());
    Variables const there{{"ROIS_URL", gateway->url()}};
    gateway.reset();
    RoisProcess watching{{"watch", "person_detected", "--start", "person_detection", "--timeout", "60"}, there};
    EXPECT_THAT(watching.error_line(), testing::MatchesRegex("rois: http://127.0.0.1:" + port + ": .*refused; trying again"));
    GatewayProcess const again{{"--listen", "127.0.0.1:" + port}};
    watching.line_with("person_detected");
    watching.signal(SIGINT);
    EXPECT_EQ(watching.wait().error, "") << "the reason is reported once";
}

TEST(AMissingGateway, IsWaitedForUntilTheEndOfFor) {
    auto const seconds_of = [](std::vector<std::string> const& arguments, int exit_code) {
        auto const begun = std::chrono::steady_clock::now();
        auto const ended = run_rois(arguments);
        EXPECT_EQ(ended.exit_code, exit_code) << ended.error;
        EXPECT_THAT(ended.error, HasSubstr("refused")) << arguments.front();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    };
    for (std::string const command : {"watch", "subscribe"})
        EXPECT_LT(seconds_of({command, "person_detected", "--for", "0.5"}, 8), 8) << "less than the --timeout of 10 s";
    EXPECT_GE(seconds_of({"watch", "person_detected", "--for", "2", "--timeout", "60"}, 8), 1.9);
    EXPECT_LT(seconds_of({"watch", "person_detected", "--timeout", "0.5"}, 8), 8);
    EXPECT_LT(seconds_of({"bind", "navigation", "--session-file", file_named("absent"), "--timeout", "0.5"}, 8), 8);
}

TEST_F(Rois, RejectsEmptyValues) {
    for (std::string const option : {"--url", "--ca-file", "--session", "--session-file", "--record", "--where"})
        expect(2, option + ": the value is empty", {"search", option, ""});
    expect(2, "--url: ", {"search", "--url="});
    expect(2, "--start: the value is empty", {"watch", "--start", ""});
    expect(2, "REF: the value is empty", {"profile", ""});
    EXPECT_EQ(run_rois({"search", "--token", ""}, {}, {{"ROIS_URL", shared_gateway().url()}, {"ROIS_TOKEN", "t"}}).exit_code, 0);
}

TEST_F(Rois, RejectsAConditionThatIsGivenTwice) {
    expect(2, "use either the argument or --where", {"search", "type = Move", "--where", "type = Move"});
    expect(2, "use either the argument or --condition", {"search", "type = Move", "--condition", "move.xml"});
}

TEST_F(Rois, SendsAnyDocumentAndUnderlinesItsError) {
    auto const good = file_with("good.xml", "<search " + std::string{messages} + "/>");
    EXPECT_THAT(run({"send", good}).out, AllOf(StartsWith("<search_response"), HasSubstr("\n    <component_ref ")));
    EXPECT_THAT(run({"send", "-"}, "<search " + std::string{messages} + "/>").out, StartsWith("<search_response"));
    auto const bad = file_with("bad.xml", "<bind " + std::string{messages} + ">\n  <component rois:code='navigation'/>\n</bind>");
    auto const ended = run({"send", bad});
    EXPECT_EQ(ended.exit_code, 9);
    EXPECT_THAT(ended.out, HasSubstr("code=\"invalid\" line=\"2\" column=\"3\""));
    EXPECT_EQ(ended.error, "rois: " + bad +
                               ":2:3: invalid: unknown element 'component' inside 'bind': expected 'component_ref'\n"
                               "2 |   <component rois:code='navigation'/>\n  |   ^~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~\n");
    auto const unknown =
        run({"send", "-", "--json"}, "<bind " + std::string{messages} + "><component_ref rois:code='elevator'/></bind>");
    EXPECT_EQ(unknown.exit_code, 3);
    EXPECT_EQ(json::parse(unknown.out)["operation"], "bind");
}

TEST_F(Rois, SendsDocumentsThatAWebSocketCannotCarry) {
    auto const bind = "<bind " + std::string{messages} + ">\n";
    auto const latin = file_with("latin.xml", bind + "  <!-- gr\xf6\xdf --></bind>");
    expect(9, latin + ":2:10: not_well_formed: the document is not UTF-8\n2 |   <!-- gr", {"send", latin});
    auto const wide = file_with("wide.xml", std::string("\xff\xfe<\0a\0/\0>\0", 10));
    expect(9, wide + ":1:1: not_well_formed: the document is not UTF-8", {"send", wide});
    auto const long_one = file_with("long.xml", bind + "<!--" + std::string(2'000'000, 'x') + "--></bind>");
    expect(9, long_one + ": too_large: the body has ", {"send", long_one});
}

TEST_F(Rois, ReportsWhetherTheEngineIsReady) {
    EXPECT_EQ(run({"health"}).out, "healthy\n");
    EXPECT_EQ(objects({"health"})[0]["ready"], true);
    auto const unanswered = run_rois({"health"});
    EXPECT_EQ(unanswered.exit_code, 1);
    EXPECT_THAT(unanswered.error, HasSubstr("not healthy"));
    auto const port = std::to_string(shared_gateway().port());
    EXPECT_EQ(run_rois({"health"}, {}, {{"ROIS_URL", ""}, {"ROIS_LISTEN", "0.0.0.0:" + port}}).exit_code, 0)
        << "beside a gateway";
}

TEST_F(Rois, RefusesSessionOptionsOfCommandsWithoutASession) {
    for (std::string const command : {"health", "stop-all", "clear"}) {
        auto const refusal = command + " needs no session: ";
        expect(2, refusal + "--session has no effect here", {command, "--session", "s"});
        expect(2, refusal + "--http has no effect here", {"--http", command});
        expect(2, refusal + "--record has no effect here", {command, "--record", file_named("recording")});
    }
    expect(2, "health needs no session: --session-file has no effect here", {"health", "--session-file", file_named("session")});
    Variables const of_others{
        {"ROIS_URL", shared_gateway().url()}, {"ROIS_SESSION", "s"}, {"ROIS_SESSION_FILE", file_named("session")}};
    EXPECT_EQ(run_rois({"health"}, {}, of_others).out, "healthy\n");
    EXPECT_EQ(run_rois({"clear"}, {}, of_others).exit_code, 0);
}

TEST_F(Rois, ExplainsAWrongCommandLine) {
    expect(2, "a command is missing", {});
    expect(2, "--colour", {"search", "--colour", "blue"});
    expect(2, "REF is required; see rois start --help", {"start"});
    expect(2, "unknown command 'bogus'; see rois --help", {"bogus"});
    expect(2, "unknown command 'serch' (did you mean 'search'?); see ", {"serch", "type", "=", "Move"});
    expect(2, "unknown command 'subs' (did you mean 'subscribe'?); see ", {"--json", "subs"});
    expect(2, "--nothing", {"--nothing"});
    expect(2, "there is no file 'navigation'; if it is a component, add a command", {"execute", "navigation"});
    for (std::string const url : {"ftp://there", "http://127.0.0.1:99999", "http://127.0.0.1:0"})
        for (std::string const command : {"search", "health"})
            expect(2, "'" + url + "' is not a URL of a gateway", {command, "--url", url});
    for (std::string const time : {"nan", "inf", "-1", "soon"})
        expect(2, "--for: '" + time + "' is not a number from 0 to ", {"watch", "--for", time});
    expect(2, "is not a number from 0.01 to 86400", {"search", "--timeout", "nan"});
    expect(2, "--session-file (ROIS_SESSION_FILE)", {"release", "navigation"});
    expect(2, "--count: 1 required N missing", {"watch", "--count"});
    expect(2, "--count: '0' is not a number from 1 to 1000000000", {"watch", "--count", "0"});
    for (std::string const url : {"http:", "https:"})
        expect(2, "the file of trusted certificates '/none' cannot be read",
               {"search", "--url", url + "//a", "--ca-file", "/none"});
    for (std::string const command : {"search", "health"})
        EXPECT_THAT(run({command, "--url", shared_gateway().url() + "/rois/"}).error, HasSubstr("; leave /rois out of the URL"));
    EXPECT_EQ(run_rois({"search", "--timeout", "2"}).exit_code, 8);
    EXPECT_THAT(run({"--version"}).out, StartsWith("rois "));
    EXPECT_THAT(run({"search", "--colour", "always", "type = Move"}).out, HasSubstr("\x1b["));
}

TEST_F(Rois, WarnsOfUnknownVariables) {
    auto const warned = run_rois({"health"}, {}, {{"ROIS_URL", shared_gateway().url()}, {"ROIS_URLL", "x"}, {"ROIS_FOO", ""}});
    EXPECT_EQ(warned.exit_code, 0);
    EXPECT_EQ(warned.error, "rois: the environment variable 'ROIS_URLL' is unknown and ignored; man rois lists the variables\n");
}

TEST_F(Rois, KnowsTheVariablesOfTheGateway) {
    Variables variables{{"ROIS_URL", shared_gateway().url()}};
    auto const configuration = json::parse(kit::run_gateway({"--print-config"}).out, nullptr, true, true);
    for (auto const& [key, value] : configuration.items()) {
        std::string name = "ROIS_" + key;
        for (auto& letter : name) letter = static_cast<char>(std::toupper(static_cast<unsigned char>(letter)));
        variables.emplace(name, "1");
    }
    EXPECT_GT(variables.size(), 20u);
    EXPECT_EQ(run_rois({"health"}, {}, variables).error, "");
}

TEST_F(Rois, WorksOverHttp) {
    EXPECT_EQ(run({"--http", "start", "speech_synthesis", "speech_text=Hi."}).out, "start speech_synthesis  OK\n");
}

// --- Manual and completion ---

TEST_F(Rois, HasItsCommandsAndOptionsInTheManualAndTheCompletion) {
    auto const help = run({"--help-all"}).out;
    auto const manual = [] {
        std::string plain;
        for (char const c : text_of(ROIS_SOURCE_DIR "/client-cpp/command/rois.1"))
            if (c != '\\') plain.push_back(c);
        return plain;
    }();
    auto const completion = text_of(ROIS_SOURCE_DIR "/client-cpp/command/completion/rois");
    std::set<std::string> words;
    for (auto const* command : {"profile", "search", "bind", "release", "get", "set", "start", "stop", "execute", "query",
                                "subscribe", "watch", "send", "health", "record", "replay", "scenario"}) {
        EXPECT_THAT(help, HasSubstr(command));
        words.insert(command);
    }
    for (auto at = help.find("--"); at != std::string::npos; at = help.find("--", at + 2)) {
        auto const end = help.find_first_not_of("-abcdefghijklmnopqrstuvwxyz", at);
        words.insert(help.substr(at, end - at));
    }
    EXPECT_GT(words.size(), 35u);
    for (auto const& word : words) {
        EXPECT_THAT(manual, HasSubstr(word)) << "rois.1";
        EXPECT_THAT(completion, HasSubstr(word)) << "completion/rois";
    }
}

TEST(RoisEngines, ListsTheSubEngines) {
    kit::ProfileFolder folder;
    folder.put("engines.json", R"({"engines": [{"name": "lamps", "joins": "lamp"}]})");
    GatewayProcess gateway{{"--robots", "none", "--engines", folder.name() + "/engines.json"}};
    Variables const at{{"ROIS_URL", gateway.url()}};
    EXPECT_EQ(run_rois({"engines"}, {}, at).out,
              "name   state   link           round trip  components  last error\n"
              "lamps  absent  joins as lamp  -           0           -\n");
    EXPECT_EQ(json::parse(run_rois({"engines", "--json"}, {}, at).out),
              (json{{"name", "lamps"}, {"state", "absent"}, {"link", "joins as lamp"}, {"components", 0}, {"losses", 0}}));
    EXPECT_THAT(run_rois({"engines", "--xml"}, {}, at).out, HasSubstr("<engine name=\"lamps\""));
    EXPECT_EQ(run_rois({"engines", "--session", "x"}, {}, at).exit_code, 2);
    auto const none = run_rois({"engines"}, {}, {{"ROIS_URL", shared_gateway().url()}});
    EXPECT_EQ(none.exit_code, 0);
    EXPECT_EQ(none.out + none.error, "rois: the gateway has no sub engines\n");
}

}  // namespace
}  // namespace rois::test
