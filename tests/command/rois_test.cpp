// The `rois` program against the real gateway.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <cstdio>
#include <nlohmann/json.hpp>
#include <set>

#include "client/http_client.hpp"
#include "command/rois_process.hpp"

namespace rois::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

struct Rois : testing::Test {
    Ended run(std::vector<std::string> const& arguments, std::string const& input = {}) {
        return run_rois(arguments, input, at());
    }
    Variables at() const { return {{"ROIS_URL", shared_gateway().url()}}; }

    // Its objects, one a line.
    std::vector<json> objects(std::vector<std::string> arguments) {
        arguments.push_back("--json");
        auto const ended = run(arguments);
        EXPECT_EQ(ended.exit_code, 0) << ended.error;
        std::vector<json> all;
        for (auto const& line : lines_of(ended.out)) all.push_back(json::parse(line));
        return all;
    }

    void expect(int code, std::string const& says, std::vector<std::string> const& arguments) {
        auto const ended = run(arguments);
        EXPECT_EQ(ended.exit_code, code) << ended.out << ended.error;
        EXPECT_THAT(ended.error, HasSubstr(says));
    }
};

constexpr auto messages = "xmlns='urn:x-rois:psm:xml:message:1' xmlns:rois='http://www.omg.org/spec/RoIS/20240801'";

TEST_F(Rois, SearchesWithAConditionThatIsTypedOrInAFile) {
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
                AllOf(HasSubstr("reception"), HasSubstr("\nspeech_synthesis       SpeechSynthesis       reception\n")));
    EXPECT_THAT(run({"profile", "navigation"}).out,
                AllOf(HasSubstr("reached_target"), HasSubstr("time_limit       int       = 0")));
    EXPECT_EQ(objects({"profile", "reaction"})[0]["identifier"], "urn:x-rois:def:component:OMG::Reaction");
    EXPECT_THAT(run({"profile", "reaction", "--xml"}).out, StartsWith("<rois:HRIComponentProfile"));
    expect(3, "unknown component 'elevator'; there are ", {"profile", "elevator"});
}

TEST_F(Rois, AsksInThreeForms) {
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
    EXPECT_EQ(objects({"get", "navigation", "time_limit"})[0]["parameters"], (json{{"time_limit", 7000}}));
    EXPECT_EQ(objects({"get", "navigation"})[0]["parameters"]["target_position"], (json{"desk", "start"}));
    EXPECT_EQ(run({"set", "navigation", "time_limit=0"}).exit_code, 0);
    expect(2, "time_limit: 'soon' is not of the type int", {"set", "navigation", "time_limit=soon"});
    expect(2, "has no argument 'speed'; it has target_position", {"set", "navigation", "speed=1"});
    expect(3, "no parameter 'speed'", {"get", "navigation", "speed"});
}

TEST_F(Rois, StartsStopsAndExecutes) {
    EXPECT_EQ(run({"start", "speech_synthesis", "speech_text=Hi."}).out, "start speech_synthesis  OK\n");
    EXPECT_EQ(run({"stop", "navigation"}).out, "stop navigation  OK\n");
    expect(1, "", {"execute", "navigation", "resume"});
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
    expect(2, "cannot be read", {"execute", "/no/such/file.xml"});
}

TEST_F(Rois, StopsTheRobotWhenItIsInterrupted) {
    RoisProcess driving{{"start", "navigation", "target_position=exit", "time_limit=0"}, at()};
    RoisProcess watching{{"watch", "reached_target", "--where", "component_ref = navigation"}, at()};
    watching.line_with("open");
    // It is bound as soon as the command runs.
    std::string bound;
    for (int i = 0; i < 500 && bound.empty(); ++i) bound = run({"search", "name = navigation and bound = true"}).out;
    ASSERT_THAT(bound, StartsWith("navigation"));
    driving.signal(SIGINT);
    EXPECT_EQ(driving.wait().exit_code, 130);
    EXPECT_EQ(objects({"search", "name = navigation and bound = false"})[0]["component_ref_list"], json{"navigation"});
    watching.signal(SIGTERM);
    EXPECT_EQ(watching.wait().exit_code, 0);
}

TEST_F(Rois, HoldsASessionThatOthersActIn) {
    RoisProcess holding{{"bind", "reaction", "speech_synthesis"}, at()};
    auto const id = holding.line_with("session ").substr(8);
    expect(5, "OUT_OF_RESOURCES", {"start", "reaction", "reaction_ref=9"});
    EXPECT_EQ(run({"--session", id, "start", "reaction", "reaction_ref=9"}).out, "start reaction  OK\n");
    EXPECT_EQ(run({"--session", id, "subscribe", "person_detected"}).exit_code, 0);
    EXPECT_THAT(objects({"--session", id, "start", "speech_synthesis", "speech_text=Hi.", "--no-wait"})[0]["commands"].size(), 1);
    EXPECT_THAT(run({"--session", id, "watch", "--for", "1"}).out, HasSubstr("completed"));
    EXPECT_EQ(run({"--session", id, "release", "reaction"}).exit_code, 0);
    EXPECT_EQ(run({"start", "reaction", "reaction_ref=9"}).exit_code, 0);
    expect(2, "which session?", {"release", "reaction"});
    expect(2, "without --session", {"start", "reaction", "--no-wait"});
    expect(9, "no_session", {"--session", "nobody", "release", "reaction"});
    holding.signal(SIGINT);
    EXPECT_EQ(holding.wait().exit_code, 0);
}

TEST_F(Rois, BindsAnyThatIsMeantForSomeTime) {
    auto const ended = run({"bind", "--where", "type = Move", "--for", "0"});
    EXPECT_EQ(ended.exit_code, 0) << ended.error;
    EXPECT_THAT(ended.out, StartsWith("bound move\nsession "));
    expect(2, "which components?", {"bind"});
    expect(3, "unknown component 'elevator'", {"bind", "elevator"});
}

TEST_F(Rois, ShowsEventsAsTheyCome) {
    auto const said = objects({"watch", "person_detected", "--start", "person_detection", "--count", "1"});
    EXPECT_EQ(said.back()["notification"], "receive_event");
    EXPECT_TRUE(said.back()["results"]["number"].is_number());
    RoisProcess subscribed{{"subscribe", "person_detected", "--where", "number >= 0"}, at()};
    EXPECT_THAT(subscribed.line(), StartsWith("s-"));
    RoisProcess starting{{"start", "person_detection", "--for", "60"}, at()};
    EXPECT_THAT(subscribed.line(), HasSubstr("person_detected  person_detection  timestamp="));
    expect(4, "no component has an event 'rain'; there are ", {"watch", "rain"});
}

TEST_F(Rois, SendsAnyDocumentAndUnderlinesItsMistake) {
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

TEST_F(Rois, KnowsWhetherTheEngineIsReady) {
    EXPECT_EQ(run({"health"}).out, "healthy\n");
    EXPECT_EQ(objects({"health"})[0]["ready"], true);
    auto const nobody = run_rois({"health"});
    EXPECT_EQ(nobody.exit_code, 1);
    EXPECT_THAT(nobody.error, HasSubstr("not healthy"));
    auto const port = std::to_string(shared_gateway().port());
    EXPECT_EQ(run_rois({"health"}, {}, {{"ROIS_URL", ""}, {"ROIS_LISTEN", "0.0.0.0:" + port}}).exit_code, 0)
        << "beside a gateway";
}

TEST_F(Rois, SaysWhatIsWrongWithItsCommandLine) {
    expect(2, "bogus", {"bogus"});
    expect(2, "which command?", {});
    expect(2, "--colour", {"search", "--colour", "blue"});
    expect(2, "REF is required", {"start"});
    expect(2, "URL", {"search", "--url", "ftp://there"});
    EXPECT_EQ(run_rois({"search", "--timeout", "2"}).exit_code, 8);
    EXPECT_THAT(run({"--version"}).out, StartsWith("rois "));
    EXPECT_THAT(run({"search", "--colour", "always", "type = Move"}).out, HasSubstr("\x1b["));
}

TEST_F(Rois, SpeaksHttpToo) {
    EXPECT_EQ(run({"--http", "start", "speech_synthesis", "speech_text=Hi."}).out, "start speech_synthesis  OK\n");
}

// --- Recordings ---

TEST_F(Rois, ReplaysWhatItRecorded) {
    auto const file = file_named("day.jsonl");
    std::vector<std::string> const watch{"watch", "person_detected", "--start", "person_detection", "--count", "1", "--json"};
    auto recorded = watch;
    recorded.insert(recorded.end(), {"--record", file});
    auto const live = run(recorded);
    ASSERT_EQ(live.exit_code, 0) << live.error;
    auto const event = json::parse(lines_of(live.out).back());

    RoisProcess engine{{"replay", file, "--listen", "127.0.0.1:0", "--json", "--speed", "0"}};
    Variables const there{{"ROIS_URL", json::parse(engine.line())["listening"]}};
    for (auto const& way : {std::vector<std::string>{}, std::vector<std::string>{"--http"}}) {
        auto again = watch;
        again.insert(again.end(), way.begin(), way.end());
        auto const replayed = run_rois(again, {}, there);
        ASSERT_EQ(replayed.exit_code, 0) << replayed.error;
        auto told = json::parse(lines_of(replayed.out).back());
        told["sequence"] = event["sequence"];
        EXPECT_EQ(told, event);
    }
    EXPECT_EQ(run_rois({"health"}, {}, there).exit_code, 0);
    EXPECT_EQ(run_rois({"bind", "navigation"}, {}, there).exit_code, 4) << "never recorded";
    auto const bad = run_rois({"send", "-"}, "<bind " + std::string{messages} + "><component/></bind>", there);
    EXPECT_EQ(bad.exit_code, 9) << "validated like the gateway's";
    engine.signal(SIGTERM);
    EXPECT_EQ(engine.wait().exit_code, 0);
}

TEST_F(Rois, RefusesWhatIsNotServedThere) {
    RoisProcess between{{"record", file_named("refused.jsonl"), "--listen", "127.0.0.1:0", "--json"}, at()};
    auto const url = json::parse(between.line())["listening"].get<std::string>();
    auto const port = std::stoi(url.substr(url.rfind(':') + 1));
    client::HttpClient http{{.port = static_cast<std::uint16_t>(port)}};
    EXPECT_EQ(http.get("/elsewhere").fault(), "not_found");
    EXPECT_EQ(http.get("/elsewhere").reason(), "only sessions are served here: /rois, /rois/notifications");
    EXPECT_EQ(http.get("/rois").fault(), "upgrade_required");
    EXPECT_EQ(http.get("/readyz", {}, "PUT").reason(), "this method is not for /readyz");
    EXPECT_EQ(http.get("/rois/notifications?after=0&wait=0").fault(), "no_session");
    EXPECT_EQ(http.call("connect").return_code(), "OK");
    EXPECT_EQ(http.get("/rois/notifications?after=x&wait=0", {{"RoIS-Session", http.session}}).fault(), "not_well_formed");
    EXPECT_EQ(
        http.get("/rois/notifications", {{"RoIS-Session", http.session}, {"Accept", "text/event-stream"}, {"Last-Event-ID", "x"}})
            .reason(),
        "Last-Event-ID must be a whole number");
}

TEST_F(Rois, RecordsWhatOthersSay) {
    auto const file = file_named("others.jsonl");
    RoisProcess between{{"record", file, "--listen", "127.0.0.1:0", "--json"}, at()};
    Variables const there{{"ROIS_URL", json::parse(between.line())["listening"]}};
    EXPECT_EQ(run_rois({"start", "speech_synthesis", "speech_text=Hi."}, {}, there).out, "start speech_synthesis  OK\n");
    between.signal(SIGINT);
    EXPECT_EQ(between.wait().exit_code, 0);
    RoisProcess engine{{"replay", file, "--listen", "127.0.0.1:0", "--json", "--speed", "0"}};
    Variables const replayed{{"ROIS_URL", json::parse(engine.line())["listening"]}};
    EXPECT_EQ(run_rois({"start", "speech_synthesis", "speech_text=Hello."}, {}, replayed).out, "start speech_synthesis  OK\n")
        << "roughly the same";
}

TEST_F(Rois, RefusesWhatIsNoRecording) {
    expect(2, ":1: this is no recording", {"replay", file_with("none.jsonl", "<xml/>\n")});
    expect(2,
           ":2: ", {"replay", file_with("bad.jsonl", "{\"recording\":\"rois-recording-1\"}\n{\"at\":1,\"direction\":\"up\"}\n")});
    expect(2, "cannot be read", {"replay", "/no/such/file"});
    expect(2, "cannot be written", {"search", "--record", "/no/such/folder/file"});
}

// --- Scenarios ---

constexpr auto reception = ROIS_SOURCE_DIR "/client-cpp/scenarios/reception.xml";

TEST(TheReceptionAsAScenario, ReceivesFourVisitorsAndIsReplayed) {
    GatewayProcess const gateway{
        {"--scenario", ROIS_SOURCE_DIR "/tests/server/data/four_visitors.xml", "--sim-speed", "20", "--seed", "7"}};
    auto const file = file_named("reception.jsonl");
    auto const live =
        run_rois({"scenario", reception, "visitors=4", "identifying=1", "listening=2", "looking=2", "--quiet", "--record", file},
                 {}, {{"ROIS_URL", gateway.url()}});
    ASSERT_EQ(live.exit_code, 0) << live.error;
    EXPECT_THAT(lines_of(live.out), testing::UnorderedElementsAre(
                                        "tanaka: told \"Mr. Tanaka, your meeting is in room 3.\"",
                                        "suzuki: told \"Ms. Suzuki, your taxi is waiting at the entrance.\"",
                                        "somebody: told \"Welcome. How can I help you?\", heard \"Where is the exhibition?\"",
                                        "somebody: told \"Welcome. How can I help you?\"", "received 4 visitors"));
    RoisProcess engine{{"replay", file, "--listen", "127.0.0.1:0", "--json"}};
    auto const again = run_rois({"scenario", reception, "visitors=4", "identifying=1", "listening=2", "looking=2", "--quiet"}, {},
                                {{"ROIS_URL", json::parse(engine.line())["listening"]}});
    EXPECT_EQ(again.exit_code, 0) << again.error;
    EXPECT_EQ(again.out, live.out) << "without a robot";
}

std::string scenario_with(std::string const& states, std::string const& start = "a") {
    return file_with("scenario.xml", "<robot_scenario xmlns='urn:x-rois:scenario:1' start='" + start +
                                         "'>\n<component name='move'/>\n<variable name='x'/>\n" + states +
                                         "\n</robot_scenario>\n");
}

TEST_F(Rois, ReportsEachTransitionOfAScenario) {
    auto const file = scenario_with(
        "<state name='a'><command component='move' type='stop'/><completed status='OK' to='b'/></state>"
        "<end name='b' failed='true'><print>x is {x}</print></end>");
    auto const ended = run({"scenario", file, "x=1", "--json"});
    EXPECT_EQ(ended.exit_code, 1) << "failed";
    auto const lines = lines_of(ended.out);
    ASSERT_EQ(lines.size(), 2u) << ended.out << ended.error;
    auto const transition = json::parse(lines[0]);
    EXPECT_EQ(transition["from"], "a");
    EXPECT_EQ(transition["to"], "b");
    EXPECT_EQ(transition["by"], "completed OK");
    EXPECT_EQ(lines[1], "{\"print\":\"x is 1\"}");
}

TEST_F(Rois, SaysWhatIsWrongWithAScenario) {
    auto const end = std::string{"<end name='b'/>"};
    struct Wrong {
        std::string states;
        std::string says;
    };
    for (auto const& [states, says] : std::vector<Wrong>{
             {"<state name='a'><nothing/></state>", ":4:17: unknown element 'nothing' inside 'state'"},
             {"<state name='a'><at_once to='c'/></state>" + end, ":4:17: no state 'c'; there are a, b"},
             {"<state name='a'/>" + end, ":4:1: nothing leads out of this state"},
             {"<state name='a'><print>{y}</print><at_once to='b'/></state>" + end, ":4:17: no variable 'y'; there are x"},
             {"<state name='a'><command component='arm' type='stop'/><at_once to='b'/></state>" + end,
              ":4:17: no component 'arm'; there are move"},
             {"<state name='a'><completed to='b'/></state>" + end,
              ":4:1: this state waits for the end of its commands, and has none"},
             {"<state name='a'><at_once to='b'><when variable='x'/></at_once></state>" + end,
              ":4:33: a 'when' has one of is, is_not"},
             {"<state name='a'><after seconds='1' to='b'><take variable='x' result='r'/></after></state>" + end,
              "only events and answers have results"},
         }) {
        auto const file = scenario_with(states);
        expect(2, file + says.substr(0, says.starts_with(":") ? std::string::npos : 0), {"scenario", "--check", file});
        expect(2, says, {"scenario", "--check", file});
    }
    EXPECT_EQ(run({"scenario", "--check", reception}).out, "scenario ok\n");
    expect(2, "no variable 'guests'", {"scenario", reception, "guests=2"});
    expect(2, "robot_scenario", {"scenario", ROIS_SOURCE_DIR "/tests/server/data/one_visitor.xml"});
    auto const unexpected =
        scenario_with("<state name='a'><command component='move' type='resume'/><completed status='OK' to='b'/></state>" + end);
    expect(1, "ended with ERROR, and no trigger is for that", {"scenario", unexpected});
}

// --- What is installed beside the program ---

std::string text_of(std::string const& file) {
    std::string text;
    auto* const in = std::fopen(file.c_str(), "r");
    EXPECT_NE(in, nullptr) << file;
    for (int c = std::getc(in); c != EOF; c = std::getc(in)) text.push_back(static_cast<char>(c));
    std::fclose(in);
    return text;
}

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

}  // namespace
}  // namespace rois::test
