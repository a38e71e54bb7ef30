// `rois record` and `rois replay`.
#include <signal.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "command/rois_fixture.hpp"
#include "kit/http_client.hpp"

namespace rois::test {
namespace {

TEST_F(Rois, ReplaysItsRecording) {
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
        auto repeated = json::parse(lines_of(replayed.out).back());
        repeated["sequence"] = event["sequence"];
        EXPECT_EQ(repeated, event);
    }
    EXPECT_EQ(run_rois({"health"}, {}, there).exit_code, 0);
    EXPECT_EQ(run_rois({"bind", "navigation"}, {}, there).exit_code, 4) << "never recorded";
    auto const bad = run_rois({"send", "-"}, "<bind " + std::string{messages} + "><component/></bind>", there);
    EXPECT_EQ(bad.exit_code, 9) << "validated like the gateway's";
    engine.signal(SIGTERM);
    EXPECT_EQ(engine.wait().exit_code, 0);
}

TEST_F(Rois, RejectsUnknownPathsAndMethods) {
    RoisProcess between{{"record", file_named("refused.jsonl"), "--listen", "127.0.0.1:0", "--json"}, at()};
    auto const url = json::parse(between.line())["listening"].get<std::string>();
    auto const port = std::stoi(url.substr(url.rfind(':') + 1));
    kit::HttpClient http{{.port = static_cast<std::uint16_t>(port)}};
    EXPECT_EQ(http.get("/elsewhere").fault(), "not_found");
    EXPECT_EQ(http.get("/elsewhere").reason(), "only sessions are served here: /rois, /rois/notifications");
    EXPECT_EQ(http.get("/rois").fault(), "upgrade_required");
    EXPECT_EQ(http.get("/readyz", {}, "PUT").reason(), "/readyz does not allow this method");
    EXPECT_EQ(http.get("/rois/notifications?after=0&wait=0").fault(), "no_session");
    EXPECT_EQ(http.call("connect").return_code(), "OK");
    EXPECT_EQ(http.get("/rois/notifications?after=x&wait=0", {{"RoIS-Session", http.session}}).fault(), "not_well_formed");
    EXPECT_EQ(
        http.get("/rois/notifications", {{"RoIS-Session", http.session}, {"Accept", "text/event-stream"}, {"Last-Event-ID", "x"}})
            .reason(),
        "Last-Event-ID must be a whole number");
}

TEST_F(Rois, RecordsOtherApplications) {
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

TEST_F(Rois, KeepsAnOldRecordingUntilThereIsANewOne) {
    std::string const before = "a recording\n";
    auto const file = file_with("kept.jsonl", before);
    auto const unanswered = run_rois({"record", file, "--timeout", "1"});
    EXPECT_EQ(unanswered.exit_code, 8) << "no engine";
    expect(4, "no component has an event 'rain'", {"record", file, "rain"});
    expect(3, "unknown component 'elevator'", {"record", file, "--start", "elevator"});
    expect(3, "unknown component 'elevator'", {"watch", "person_detected", "--start", "elevator", "--record", file});
    expect(3, "unknown component 'elevator'", {"start", "elevator", "--record", file});
    EXPECT_EQ(run_rois({"search", "--timeout", "1", "--record", file}).exit_code, 8);
    {
        RoisProcess between{{"record", file, "--listen", "127.0.0.1:0", "--json"}};
        Variables const there{{"ROIS_URL", json::parse(between.line())["listening"]}};
        EXPECT_EQ(run_rois({"search", "--timeout", "1"}, {}, there).exit_code, 8);
    }
    EXPECT_EQ(text_of(file), before);
    EXPECT_EQ(run({"search", "--record", file}).exit_code, 0);
    EXPECT_THAT(lines_of(text_of(file)).front(), testing::StartsWith("{\"recording\":\"rois-recording-1\""));

    auto const none = file_named("none.jsonl");
    EXPECT_EQ(run_rois({"search", "--timeout", "1", "--record", none}).exit_code, 8);
    EXPECT_FALSE(std::filesystem::exists(none));
}

TEST_F(Rois, ReplaysARecordingWhoseLastLineIsCutOff) {
    auto const file = file_named("whole.jsonl");
    ASSERT_EQ(run({"search", "--record", file}).exit_code, 0);
    std::ifstream in{file};
    auto const cut = file_with("cut.jsonl", std::string{std::istreambuf_iterator<char>{in}, {}} + R"({"at":99,"direc)");
    RoisProcess engine{{"replay", cut, "--listen", "127.0.0.1:0", "--json"}};
    Variables const there{{"ROIS_URL", json::parse(engine.line())["listening"]}};
    EXPECT_EQ(run_rois({"search"}, {}, there).exit_code, 0);
}

// A recording whose engine switches navigation from robot1 to robot2.
std::string recording_with_a_switch() {
    auto const names = R"(xmlns=\"urn:x-rois:psm:xml:message:1\" xmlns:rois=\"http://www.omg.org/spec/RoIS/20240801\")";
    std::string text = "{\"recording\":\"rois-recording-1\"}\n";
    auto const add = [&](std::string const& direction, std::string document) {
        for (std::size_t at = 0; (at = document.find('$', at)) != document.npos;) document.replace(at, 1, names);
        text += R"({"at":1,"direction":")" + direction + R"(","document":")" + document + "\"}\n";
    };
    add("out", R"(<connect $ switches=\"true\"/>)");
    add("in", R"(<connect_response $ return_code=\"OK\"><session>s</session></connect_response>)");
    add("in", R"(<switched $ sequence=\"1\"><component_ref rois:code=\"navigation\"/><from>robot1.navigation</from>)"
              "<to>robot2.navigation</to><reason>the link was lost</reason></switched>");
    add("out", R"(<bind $ switching=\"restart\"><component_ref rois:code=\"navigation\"/></bind>)");
    add("in", R"(<bind_response $ return_code=\"OK\"/>)");
    add("out", R"(<search $ xmlns:fes=\"http://www.opengis.net/fes/2.0\"><condition><fes:Filter><fes:PropertyIsEqualTo>)"
               "<fes:ValueReference>bound</fes:ValueReference><fes:Literal>false</fes:Literal>"
               "</fes:PropertyIsEqualTo></fes:Filter></condition></search>");
    add("in", R"(<search_response $ return_code=\"OK\"><component_ref_list/></search_response>)");
    add("out", R"(<get_parameter $><component_ref rois:code=\"navigation\"/></get_parameter>)");
    add("in", R"(<get_parameter_response $ return_code=\"OK\"><parameters/></get_parameter_response>)");
    return file_with("switched.jsonl", text);
}

TEST_F(Rois, PrintsSwitches) {
    RoisProcess engine{{"replay", recording_with_a_switch(), "--listen", "127.0.0.1:0", "--json"}};
    Variables const there{{"ROIS_URL", json::parse(engine.line())["listening"]}};
    auto const watched = [&](std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {"watch", "switched", "--count", "1"});
        auto const ended = run_rois(arguments, {}, there);
        EXPECT_EQ(ended.exit_code, 0) << ended.error;
        return lines_of(ended.out).back();
    };
    EXPECT_THAT(watched({}),
                testing::EndsWith("  switched  navigation  from robot1.navigation to robot2.navigation: the link was lost"));
    EXPECT_EQ(json::parse(watched({"--json"})), (json{{"notification", "switched"},
                                                      {"sequence", 1},
                                                      {"component_ref", "navigation"},
                                                      {"from", "robot1.navigation"},
                                                      {"to", "robot2.navigation"},
                                                      {"reason", "the link was lost"}}));
}

TEST_F(Rois, RecordsSwitchesForThoseWhoAskForThem) {
    RoisProcess engine{{"replay", recording_with_a_switch(), "--listen", "127.0.0.1:0", "--json"}};
    auto const file = file_named("switches.jsonl");
    RoisProcess between{{"record", file, "--listen", "127.0.0.1:0", "--json"},
                        {{"ROIS_URL", json::parse(engine.line())["listening"]}}};
    Variables const there{{"ROIS_URL", json::parse(between.line())["listening"]}};
    auto const asks = [&] {
        auto const lines = lines_of(text_of(file));
        return std::ranges::count_if(lines, [](auto const& line) { return line.find("switches=") != line.npos; });
    };
    run_rois({"bind", "navigation", "--for", "0", "--switching", "restart"}, {}, there);
    EXPECT_EQ(asks(), 0);
    EXPECT_EQ(run_rois({"watch", "switched", "--count", "1"}, {}, there).exit_code, 0);
    EXPECT_EQ(asks(), 1);
}

TEST_F(Rois, BindsWithTheGivenSwitching) {
    RoisProcess engine{{"replay", recording_with_a_switch(), "--listen", "127.0.0.1:0", "--json"}};
    Variables const there{{"ROIS_URL", json::parse(engine.line())["listening"]}};
    auto const bound = [&](std::string const& switching) {
        return run_rois({"bind", "navigation", "--for", "0", "--switching", switching}, {}, there).exit_code;
    };
    EXPECT_EQ(bound("restart"), 0);
    EXPECT_EQ(bound("abort"), 4) << "never recorded";
    expect(2, "--switching: ", {"bind", "navigation", "--switching", "soon"});

    RoisProcess holding{{"bind", "navigation", "--switching", "restart"}, there};
    auto const id = holding.line_with("session ").substr(8);
    auto const kept = run_rois({"--session", id, "bind", "navigation"}, {}, there);
    EXPECT_EQ(kept.exit_code, 0) << kept.error;
    EXPECT_EQ(run_rois({"--session", id, "bind", "navigation", "--switching", "none"}, {}, there).exit_code, 4);
}

TEST_F(Rois, RejectsInvalidRecordings) {
    expect(2, ":1: this is not a recording", {"replay", file_with("none.jsonl", "<xml/>\n")});
    expect(2,
           ":2: ", {"replay", file_with("bad.jsonl", "{\"recording\":\"rois-recording-1\"}\n{\"at\":1,\"direction\":\"up\"}\n")});
    expect(2, ":2: this line is not JSON",
           {"replay", file_with("torn.jsonl", "{\"recording\":\"rois-recording-1\"}\n{\"at\"\n")});
    expect(2, "cannot be read", {"replay", "/no/such/file"});
    expect(2, "cannot be written", {"search", "--record", "/no/such/folder/file"});
}

TEST_F(Rois, ChecksItsAddressesBeforeItServes) {
    auto const file = file_named("listening.jsonl");
    ASSERT_EQ(run({"search", "--record", file}).exit_code, 0);
    for (std::string const address : {"*:0", ":0", "::1:0", "127.0.0.1"}) {
        expect(2, "--listen must be HOST:PORT, such as 127.0.0.1:8080, not '" + address, {"replay", file, "--listen", address});
        expect(2, "--listen must be HOST:PORT", {"record", file_named("none.jsonl"), "--listen", address});
    }
    expect(2, "--listen: 1 required HOST:PORT missing", {"replay", file, "--listen"});
    expect(2, "replay serves a recording and needs no gateway: leave out --url", {"replay", file, "--url", "http://there"});
    expect(2, "'http://127.0.0.1:99999' is not a URL of a gateway",
           {"record", file_named("none.jsonl"), "--listen", "127.0.0.1:0", "--url", "http://127.0.0.1:99999"});
}

}  // namespace
}  // namespace rois::test
