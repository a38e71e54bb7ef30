// Settings and the log, as a user sees them. tests/main tests the settings in detail.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "server/websocket_client.hpp"

namespace rois::test {
namespace {

using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;

// Expects one line on standard error, and exit code 2.
void expect_complaint(Ended const& ended, std::string const& wanted) {
    EXPECT_EQ(ended.exit_code, 2);
    EXPECT_THAT(ended.error, HasSubstr(wanted));
    EXPECT_EQ(std::ranges::count(ended.error, '\n'), 1) << ended.error;
    EXPECT_EQ(ended.out, "");
}

TEST(CommandLine, PrintsHelpAndVersion) {
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

TEST(CommandLine, ReportsAnErrorInOneLineAndExitsWith2) {
    expect_complaint(run_gateway({"--seed", "x"}), "rois-gateway: --seed must be a whole number");
    expect_complaint(run_gateway({}, {{"ROIS_SEED", "x"}}), "ROIS_SEED must be a whole number");
    expect_complaint(run_gateway({"--config", "/nowhere/at.all"}), "/nowhere/at.all: cannot be read");
}

TEST(Environment, UnknownVariablesCauseAWarning) {
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

TEST(ConfigurationFile, OfAFloorPlanIsCheckedToo) {
    std::string const no_plan = ROIS_SOURCE_DIR "/tests/server/data/three_visitors.txt";
    expect_complaint(run_gateway({"--floor-plan", no_plan, "--check-config"}), no_plan + ":1:");
    expect_complaint(run_gateway({"--scenario", "/nowhere/at.all", "--check-config"}), "/nowhere/at.all: cannot be read");
    for (std::string const key : {"--state", "--audit-log"})
        expect_complaint(run_gateway({key, "/nowhere/at.all", "--check-config"}), "cannot write '/nowhere': No such file");
    EXPECT_EQ(run_gateway({"--state", "/tmp/rois-not-made", "--audit-log", "/tmp/rois-not-made.log", "--check-config"}).exit_code,
              0);
    EXPECT_FALSE(std::filesystem::exists("/tmp/rois-not-made")) << "a check makes nothing";
}

TEST(ConfigurationFile, DoesNotNameTheEngineLikeItsRobot) {
    for (auto const* way : {"--check-config", "--listen=127.0.0.1:0"})
        expect_complaint(run_gateway({"--engine-name", "robot1", way}), "'robot1' is the name of a robot of the floor plan");
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
    EXPECT_EQ(ended.error, "rois-gateway: not healthy: no connection to 127.0.0.1:1: Connection refused\n");
}

TEST(Log, IsOneJsonObjectALine) {
    GatewayProcess gateway{{"--log-format", "json"}};
    gateway.signal(SIGTERM);
    auto const ended = gateway.wait();
    EXPECT_THAT(
        ended.error,
        ContainsRegex("^\\{\"time\":\"2[^\"]*Z\",\"level\":\"info\",\"message\":\"listening on http://127.0.0.1:[0-9]+\"\\}\n"));
}

// Returns the lines that contain this text, without their time and level.
std::vector<std::string> lines_with(std::string const& log, std::string const& text) {
    std::vector<std::string> lines;
    std::istringstream in{log};
    for (std::string line; std::getline(in, line);)
        if (auto const at = line.find(text); at != std::string::npos)
            lines.push_back(line.substr(line.find(' ', line.find(' ') + 1) + 1));
    return lines;
}

// Three sessions that cause the lines of the log. Returns the id of the second one, which is a secret.
std::string play(GatewayProcess& gateway) {
    HttpClient holder{gateway};
    EXPECT_EQ(holder.call("connect").header("RoIS-Session-Number"), "1");
    holder.call("bind", component_ref("navigation"));
    holder.call("set_parameter", component_ref("navigation") + parameters("time_limit", 5));
    std::string session;
    {
        WebSocketClient other{gateway};
        other.call("connect");
        EXPECT_THAT(other.call("bind", component_ref("navigation")).child("reason").text().get(),
                    HasSubstr("'navigation' is bound by another session, number 1"));
        other.call("bind", component_ref("move"));
        session = other.session();
        other.keep_session();
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
    return session;
}

TEST(Log, OnDebugHasSessionsBindingsCommandsAndRefusals) {
    GatewayProcess gateway{{"--log-level", "debug"}};
    auto const secret = play(gateway);
    gateway.signal(SIGTERM);
    auto const log = gateway.wait().error;
    EXPECT_THAT(log, testing::Not(HasSubstr(secret)));
    EXPECT_THAT(lines_with(log, "session 1"),
                ElementsAre(ContainsRegex("^session 1 opened over HTTP by 127.0.0.1:[0-9]+$"), "session 1 binds navigation",
                            ContainsRegex("^session 1: the command '[^']+', set_parameter of navigation, begins$"),
                            ContainsRegex("^session 1: the command '[^']+', set_parameter of navigation, ended with OK$"),
                            "session 1 releases navigation", "session 1 ended: it disconnected"));
    EXPECT_THAT(lines_with(log, "session 2"),
                ElementsAre(ContainsRegex("^session 2 opened over a WebSocket by 127.0.0.1:[0-9]+$"),
                            ContainsRegex("^session 2: bind refused with OUT_OF_RESOURCES: .*, number 1$"),
                            "session 2 binds move", ContainsRegex("^session 2 resumed over a WebSocket by 127.0.0.1:[0-9]+$"),
                            "session 2 releases move", "session 2 ended: it disconnected"));
    EXPECT_THAT(lines_with(log, "refused '"),
                ElementsAre(ContainsRegex("^refused 'POST /rois' of 127.0.0.1:[0-9]+: not_well_formed: "),
                            ContainsRegex("^refused 'GET /rois/pro.*' of 127.0.0.1:[0-9]+: not_well_formed: "),
                            ContainsRegex("^refused 'GET /rois' of 127.0.0.1:[0-9]+: not_allowed: .*evil.example"),
                            ContainsRegex("^refused 'GET /healthz HTTP/1.1' of 127.0.0.1:[0-9]+: not_well_formed: .*Host")));
}

TEST(Log, OnInfoHasSessionsAndRefusedConnections) {
    GatewayProcess gateway;
    auto const secret = play(gateway);
    gateway.signal(SIGTERM);
    auto const log = gateway.wait().error;
    EXPECT_THAT(log, testing::Not(HasSubstr(secret)));
    EXPECT_THAT(lines_with(log, "session 1"), ElementsAre(HasSubstr("opened"), HasSubstr("ended")));
    EXPECT_THAT(lines_with(log, "session 2"), ElementsAre(HasSubstr("opened"), HasSubstr("resumed"), HasSubstr("ended")));
    EXPECT_THAT(lines_with(log, "refused '"), ElementsAre(HasSubstr("evil.example")));
}

TEST(Log, HasTheReasonWhyASessionEnded) {
    GatewayProcess gateway{{"--session-timeout", "0.1", "--resume-window", "0"}};
    HttpClient lost{gateway};
    lost.call("connect");
    EXPECT_THAT(gateway.log_with("session 1 ended"),
                HasSubstr("session 1 ended: its link was lost and it was not resumed within its window\n"));
    lost.session.clear();
    WebSocketClient open{gateway};
    open.call("connect");
    open.keep_session();
    gateway.signal(SIGTERM);
    EXPECT_THAT(gateway.wait().error, HasSubstr("session 2 ended: the gateway is shutting down\n"));
}

}  // namespace
}  // namespace rois::test
