// The command line, the configuration file and the environment.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "server/websocket_client.hpp"

namespace rois::test {
namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;

// A file that is there as long as the test.
class File {
public:
    explicit File(std::string const& text)
        : path_{std::filesystem::temp_directory_path() / ("rois-test-" + std::to_string(getpid()) + ".json")} {
        std::ofstream{path_} << text;
    }
    ~File() { std::filesystem::remove(path_); }
    File(File const&) = delete;
    File& operator=(File const&) = delete;

    std::string name() const { return path_; }

private:
    std::filesystem::path path_;
};

// One line on standard error, and exit code 2.
void expect_complaint(Ended const& ended, std::string const& wanted) {
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_THAT(ended.error, HasSubstr(wanted));
    EXPECT_EQ(std::ranges::count(ended.error, '\n'), 1) << ended.error;
    EXPECT_EQ(ended.out, "");
}

Ended check(std::string const& text) {
    File const file{text};
    auto ended = run_gateway({"--config", file.name(), "--check-config"});
    auto const at = ended.error.find(file.name());
    if (at != std::string::npos) ended.error.replace(at, file.name().size(), "FILE");
    return ended;
}

TEST(CommandLine, SaysWhatItIs) {
    auto const version = run_gateway({"--version"});
    EXPECT_EQ(version.exit_code, 0);
    EXPECT_EQ(version.out, "rois-gateway 0.1.0\n");
    auto const help = run_gateway({"--help"});
    EXPECT_EQ(help.exit_code, 0);
    for (auto const* part : {"--listen HOST:PORT", "--threads", "--config FILE", "--check-config", "--log-format", "--sim-speed",
                             "--seed", "--version", "--help", "Examples:", "Exit codes:"}) {
        EXPECT_THAT(help.out, HasSubstr(part));
    }
}

TEST(CommandLine, IsCheckedFlagByFlag) {
    expect_complaint(run_gateway({"--nonsense"}), "--nonsense");
    expect_complaint(run_gateway({"--sim-speed", "fast"}), "--sim-speed must be 0, or a number from 0.01 to 1000, not 'fast'");
    expect_complaint(run_gateway({"--sim-speed", "0.001"}), "--sim-speed must be 0, or a number from 0.01 to 1000");
    expect_complaint(run_gateway({"--steering", "maybe"}), "--steering must be one of off|on");
    expect_complaint(run_gateway({"--threads", "0"}), "--threads must be a whole number from 1 to 256");
    expect_complaint(run_gateway({"--log-format", "xml"}), "--log-format must be one of text|json");
    expect_complaint(run_gateway({"--on-session-end", "explode"}), "one of stop|continue");
    for (auto const* listen : {"8080", "host", ":8080", "host:99999", "::1:8080", "host:x", "*:8080", ""}) {
        expect_complaint(run_gateway({"--listen", listen}), "--listen must be HOST:PORT");
    }
    expect_complaint(run_gateway({"--listen", "*:8080"}), "or 0.0.0.0:8080 for every address of this machine, not '*:8080'");
    expect_complaint(run_gateway({"--listen"}), "--listen: 1 required HOST:PORT missing");
    expect_complaint(run_gateway({"--listen", "--seed", "3"}), "--listen: a value is missing before '--seed'");
}

TEST(CommandLine, RefusesOriginsThatNoBrowserSends) {
    for (auto const* origins : {"console.example", "http://a.example/", "http://a.example, http://b.example",
                                "http://a.example/x", "HTTP://a.example", "http://A.example", "http://a.example:80",
                                "https://a.example:443", "http://", "://a.example", "http://a.example http://b.example/"}) {
        expect_complaint(run_gateway({"--allowed-origins", origins, "--check-config"}),
                         "--allowed-origins must be origins such as https://console.example, in small letters and without a "
                         "path, separated by spaces");
    }
    auto const* const good = "http://a.example  https://b.example:8443 http://[::1]:80443 chrome-extension://abc";
    EXPECT_EQ(run_gateway({"--allowed-origins", good, "--check-config"}).exit_code, 0);
}

TEST(CommandLine, RefusesEqualPortsOfGatewayAndMedia) {
    expect_complaint(run_gateway({"--listen", "127.0.0.1:8158", "--media", "127.0.0.1:8158", "--check-config"}),
                     "media and listen must not have the same port, 8158");
    EXPECT_EQ(run_gateway({"--listen", "127.0.0.1:0", "--media", "127.0.0.1:0", "--check-config"}).exit_code, 0);
}

TEST(Environment, WarnsOfVariablesThatNobodyKnows) {
    Variables const variables{{"ROIS_SIM_SPED", "2"}, {"ROIS_URL", "http://h"}, {"ROIS_SESSION", "s"}, {"ROIS_SESSION_FILE", "f"},
                              {"ROIS_JOBS", "2"},     {"ROIS_SEED", "3"},       {"ROIS_ZOO\n", "1"},   {"ROIS_FOO", ""}};
    auto const wanted = "the environment variable 'ROIS_SIM_SPED' is unknown and ignored; --help lists the keys\n";
    auto const checked = run_gateway({"--check-config"}, variables);
    EXPECT_EQ(checked.exit_code, 0);
    EXPECT_THAT(checked.error, testing::StartsWith(std::string{"rois-gateway: warning: "} + wanted));
    EXPECT_THAT(checked.error, testing::EndsWith("variable 'ROIS_ZOO ' is unknown and ignored; --help lists the keys\n"));
    EXPECT_EQ(std::ranges::count(checked.error, '\n'), 2) << checked.error;
    GatewayProcess gateway{{}, variables};
    EXPECT_THAT(gateway.log_with(wanted), HasSubstr(std::string{"warning "} + wanted));
}

TEST(ConfigurationFile, ThatIsGoodIsOk) {
    auto const ended = check("// a comment\n{\n  \"sim_speed\": 2.5, // twice and a half\n  \"listen\": \"[::1]:9000\"\n}\n");
    EXPECT_EQ(ended.exit_code, 0) << ended.error;
    EXPECT_EQ(ended.out, "configuration ok\n");
}

TEST(ConfigurationFile, ThatIsPrintedIsGood) {
    auto const printed = run_gateway({"--print-config"});
    EXPECT_EQ(printed.exit_code, 0);
    EXPECT_THAT(printed.out, HasSubstr("\"session_timeout\": 60,\n"));
    EXPECT_EQ(check(printed.out).out, "configuration ok\n");
}

TEST(ConfigurationFile, WithAMistakeIsOneClearLine) {
    expect_complaint(check("{\n  \"sim_sped\": 2\n}"), "FILE:2:3: 'sim_sped' is not a configuration key");
    expect_complaint(check("{\n\n  // \"threads\": 1,\n  \"threads\": \"two\"\n}"),
                     "FILE:4:3: threads must be a whole number from 1 to 256, not '\"two\"'");
    expect_complaint(check("{\"listen\": 8080}"), "FILE:1:2: listen must be HOST:PORT");
    expect_complaint(check("{\"threads\": 1.5}"), "FILE:1:2: threads must be");
    expect_complaint(check("{\"session_timeout\": -1}"), "FILE:1:2: session_timeout must be a number of seconds");
    expect_complaint(check("{\n  \"seed\": 1,\n  \"threads\" 2\n}"),
                     "FILE:3:13: this is not JSON: unexpected number literal; expected ':'");
    expect_complaint(check("{\"listen\": \"x\"\n  \"threads\": 2}"),
                     "FILE:2:3: this is not JSON: unexpected string literal; expected ',' or '}'");
    expect_complaint(check("{\"seed\": 1 \"a,\" : 2}"),
                     "FILE:1:12: this is not JSON: unexpected string literal; expected ',' or '}'");
    expect_complaint(check("{\n  \"engine_name\": \"\xC3\xA9\" x}"),
                     "FILE:2:22: this is not JSON: invalid literal; last read: '\"\xC3\xA9\" x'");
    expect_complaint(check("{\n\"seed\": 1,\n"), "FILE:3:1: this is not JSON: unexpected end of input");
    expect_complaint(check("{\"engine_name\": \"\xFF\"}"), "FILE:1:18: this is not JSON: invalid string: ill-formed UTF-8 byte");
    expect_complaint(check("[]"), "FILE:1:1: the file must hold one object");
    expect_complaint(check("{\"sim_speed\": 1e999}"), "FILE:1:15: the number is too large");
    expect_complaint(check("{\n  \"seed\": 1,\n  \"seed\": 2\n}"), "FILE:3:3: 'seed' is given twice");
    expect_complaint(run_gateway({"--config", ""}), "--config must be a FILE");
    expect_complaint(run_gateway({"--config", "/nowhere/at.all"}), "/nowhere/at.all: cannot be read");
    expect_complaint(run_gateway({"--config", "/"}), "/: cannot be read");
}

TEST(ConfigurationFile, OfAFloorPlanIsCheckedToo) {
    File const plan{"<floor_plan"};
    expect_complaint(run_gateway({"--floor-plan", plan.name(), "--check-config"}), plan.name() + ":1:");
    expect_complaint(run_gateway({"--scenario", "/nowhere/at.all", "--check-config"}), "/nowhere/at.all: cannot be read");
}

TEST(ConfigurationFile, DoesNotNameTheEngineLikeItsRobot) {
    for (auto const* way : {"--check-config", "--listen=127.0.0.1:0"})
        expect_complaint(run_gateway({"--engine-name", "robot1", way}), "'robot1' is the name of a robot of the floor plan");
}

TEST(Precedence, IsFlagThenVariableThenFile) {
    File const file{"{\"sim_speed\": 2, \"seed\": 2, \"threads\": 2}"};
    auto const printed =
        run_gateway({"--config", file.name(), "--seed", "3", "--print-config"}, {{"ROIS_SIM_SPEED", "4"}, {"ROIS_SEED", "4"}});
    EXPECT_THAT(printed.out, HasSubstr("\"seed\": 3,"));
    EXPECT_THAT(printed.out, HasSubstr("\"sim_speed\": 4,"));
    EXPECT_THAT(printed.out, HasSubstr("\"threads\": 2,"));
    expect_complaint(run_gateway({}, {{"ROIS_SEED", "x"}}), "ROIS_SEED must be a whole number");
    expect_complaint(run_gateway({}, {{"ROIS_CONFIG", "/nowhere/at.all"}}), "/nowhere/at.all");
}

TEST(Listening, FailsInOneLineWhenThePortIsTaken) {
    auto const& gateway = shared_gateway();
    auto const ended = run_gateway({"--listen", "127.0.0.1:" + std::to_string(gateway.port())});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_EQ(ended.error,
              "rois-gateway: cannot listen on 127.0.0.1:" + std::to_string(gateway.port()) + ": Address already in use\n");
}

TEST(Listening, TakesIpv6) {
    GatewayProcess gateway{{"--listen", "[::1]:0"}};
    EXPECT_EQ(gateway.url(), "http://[::1]:" + std::to_string(gateway.port()));
    Line line{{.host = "::1", .port = gateway.port()}};
    line.send("GET /healthz HTTP/1.1\r\nHost: [::1]\r\n\r\n");
    EXPECT_EQ(line.take(12), "HTTP/1.1 200");
}

TEST(Health, IsCheckedByTheProgramItself) {
    auto const listen = "127.0.0.1:" + std::to_string(shared_gateway().port());
    EXPECT_EQ(run_gateway({"--listen", listen, "--check-health"}).exit_code, 0);
    auto const ended = run_gateway({"--listen", "127.0.0.1:1", "--check-health"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.error, HasSubstr("not healthy"));
}

TEST(Log, IsOneJsonObjectALine) {
    GatewayProcess gateway{{"--log-format", "json"}};
    gateway.signal(SIGTERM);
    auto const ended = gateway.wait();
    EXPECT_THAT(
        ended.error,
        ContainsRegex("^\\{\"time\":\"2[^\"]*Z\",\"level\":\"info\",\"message\":\"listening on http://127.0.0.1:[0-9]+\"\\}\n"));
}

// The lines that have this text, without their time and level.
std::vector<std::string> lines_with(std::string const& log, std::string const& text) {
    std::vector<std::string> lines;
    std::istringstream in{log};
    for (std::string line; std::getline(in, line);)
        if (auto const at = line.find(text); at != std::string::npos)
            lines.push_back(line.substr(line.find(' ', line.find(' ') + 1) + 1));
    return lines;
}

// Three sessions that do what the log speaks of.
void play(GatewayProcess& gateway) {
    HttpClient holder{gateway};
    EXPECT_EQ(holder.call("connect").header("RoIS-Session-Number"), "1");
    holder.call("bind", component_ref("navigation"));
    holder.call("set_parameter", component_ref("navigation") + parameters("time_limit", 5));
    {
        WebSocketClient other{gateway};
        other.call("connect");
        EXPECT_THAT(other.call("bind", component_ref("navigation")).child("reason").text().get(),
                    HasSubstr("'navigation' is bound by another session, number 1"));
        other.call("bind", component_ref("move"));
        auto const session = other.session();
        EXPECT_EQ(std::string{gateway.log_with("session 2 binds move")}.find(session), std::string::npos) << "it is a secret";
        other.vanish();
        WebSocketClient again{gateway};
        again.call("resume", "", {{"session", session}, {"last_sequence", "0"}});
        again.call("release", component_ref("move"));
        again.call("disconnect");
    }
    holder.call("nonsense\nforged");
    holder.get("/rois/pro\rfile");
    HttpClient page{gateway};
    EXPECT_EQ(shake_hands(page, {{"Origin", "http://evil.example"}}).status, 403);
    page.say("GET /healthz HTTP/1.1\r\nHost: evil@host\r\n\r\n");
}

TEST(Log, OnDebugTellsSessionsBindingsCommandsAndRefusals) {
    GatewayProcess gateway{{"--log-level", "debug"}};
    play(gateway);
    gateway.signal(SIGTERM);
    auto const log = gateway.wait().error;
    EXPECT_THAT(lines_with(log, "session 1"),
                ElementsAre(ContainsRegex("^session 1 opened over HTTP by 127.0.0.1:[0-9]+$"), "session 1 binds navigation",
                            ContainsRegex("^session 1: the command '[^']+', set_parameter of navigation, begins$"),
                            ContainsRegex("^session 1: the command '[^']+', set_parameter of navigation, ended with OK$"),
                            "session 1 releases navigation", "session 1 ended: it disconnected"));
    EXPECT_THAT(lines_with(log, "session 2"),
                ElementsAre(ContainsRegex("^session 2 opened over a WebSocket by 127.0.0.1:[0-9]+$"),
                            ContainsRegex("^session 2 is refused bind with OUT_OF_RESOURCES: .*, number 1$"),
                            "session 2 binds move", ContainsRegex("^session 2 resumed over a WebSocket by 127.0.0.1:[0-9]+$"),
                            "session 2 releases move", "session 2 ended: it disconnected"));
    EXPECT_THAT(lines_with(log, "refused '"),
                ElementsAre(ContainsRegex("^refused 'POST /rois' of 127.0.0.1:[0-9]+: not_well_formed: "),
                            ContainsRegex("^refused 'GET /rois/pro.*' of 127.0.0.1:[0-9]+: not_well_formed: "),
                            ContainsRegex("^refused 'GET /rois' of 127.0.0.1:[0-9]+: not_allowed: .*evil.example"),
                            ContainsRegex("^refused 'GET /healthz HTTP/1.1' of 127.0.0.1:[0-9]+: not_well_formed: .*Host")));
}

TEST(Log, OnInfoTellsSessionsAndWhoIsNotLetIn) {
    GatewayProcess gateway;
    play(gateway);
    gateway.signal(SIGTERM);
    auto const log = gateway.wait().error;
    EXPECT_THAT(lines_with(log, "session 1"), ElementsAre(HasSubstr("opened"), HasSubstr("ended")));
    EXPECT_THAT(lines_with(log, "session 2"), ElementsAre(HasSubstr("opened"), HasSubstr("resumed"), HasSubstr("ended")));
    EXPECT_THAT(lines_with(log, "refused '"), ElementsAre(HasSubstr("evil.example")));
}

TEST(Log, SaysWhyASessionEnded) {
    GatewayProcess gateway{{"--session-timeout", "0.1", "--resume-window", "0"}};
    HttpClient lost{gateway};
    lost.call("connect");
    EXPECT_THAT(gateway.log_with("session 1 ended"),
                HasSubstr("session 1 ended: its link was lost and it was not resumed in time\n"));
    lost.session.clear();
    WebSocketClient open{gateway};
    open.call("connect");
    open.vanish();
    gateway.signal(SIGTERM);
    EXPECT_THAT(gateway.wait().error, HasSubstr("session 2 ended: the gateway is shutting down\n"));
}

}  // namespace
}  // namespace rois::test
