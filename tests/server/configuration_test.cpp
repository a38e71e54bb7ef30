// The command line, the configuration file and the environment.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "server/http_client.hpp"

namespace rois::test {
namespace {

using testing::ContainsRegex;
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
    for (auto const* listen : {"8080", "host", ":8080", "host:99999", "::1:8080", "host:x"}) {
        expect_complaint(run_gateway({"--listen", listen}), "--listen must be HOST:PORT");
    }
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
    expect_complaint(check("{\n  \"sim_sped\": 2\n}"), "FILE:2: 'sim_sped' is no configuration key");
    expect_complaint(check("{\n\n  // \"threads\": 1,\n  \"threads\": \"two\"\n}"),
                     "FILE:4: threads must be a whole number from 1 to 256, not '\"two\"'");
    expect_complaint(check("{\"listen\": 8080}"), "FILE:1: listen must be HOST:PORT");
    expect_complaint(check("{\"threads\": 1.5}"), "FILE:1: threads must be");
    expect_complaint(check("{\"session_timeout\": -1}"), "FILE:1: session_timeout must be a number of seconds");
    expect_complaint(check("{\n  \"seed\": 1,\n  \"threads\" 2\n}"), "FILE:3: this is not JSON");
    expect_complaint(check("[]"), "FILE:1: the file must hold one object");
    expect_complaint(check("{\"sim_speed\": 1e999}"), "FILE: a number in it is too large");
    expect_complaint(check("{\n  \"seed\": 1,\n  \"seed\": 2\n}"), "FILE:2: 'seed' is there twice");
    expect_complaint(run_gateway({"--config", ""}), "--config must be a FILE");
    expect_complaint(run_gateway({"--config", "/nowhere/at.all"}), "/nowhere/at.all: cannot be read");
    expect_complaint(run_gateway({"--config", "/"}), "/: cannot be read");
}

TEST(ConfigurationFile, OfAFloorPlanIsCheckedToo) {
    File const plan{"<floor_plan"};
    expect_complaint(run_gateway({"--floor-plan", plan.name(), "--check-config"}), plan.name() + ":1:");
    expect_complaint(run_gateway({"--scenario", "/nowhere/at.all", "--check-config"}), "/nowhere/at.all: cannot be read");
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

}  // namespace
}  // namespace rois::test
