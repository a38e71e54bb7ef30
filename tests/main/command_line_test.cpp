// Flags, variables and the configuration file together.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "main/command_line.hpp"
#include "main/temporary_file.hpp"

namespace rois::test {
namespace {

using testing::HasSubstr;
using testing::Not;

CommandLine read(std::vector<std::string> const& arguments) {
    std::vector<char const*> argv{"rois-gateway"};
    for (auto const& argument : arguments) argv.push_back(argument.c_str());
    return read_command_line(static_cast<int>(argv.size()), argv.data());
}

// Returns the error of these arguments, or "".
std::string complaint(std::vector<std::string> const& arguments) {
    try {
        read(arguments);
        return "";
    } catch (BadSettings const& error) {
        return error.what();
    }
}

void expect_complaint(std::string const& complaint, std::string const& wanted) {
    EXPECT_THAT(complaint, HasSubstr(wanted));
    EXPECT_THAT(complaint, Not(HasSubstr("\n")));
}

// Sets an environment variable as long as the object exists.
class Variable {
public:
    Variable(char const* name, char const* value) : name_{name} { setenv(name, value, 1); }
    ~Variable() { unsetenv(name_); }
    Variable(Variable const&) = delete;
    Variable& operator=(Variable const&) = delete;

private:
    char const* name_;
};

TEST(CommandLine, IsCheckedFlagByFlag) {
    expect_complaint(complaint({"--nonsense"}), "The following argument was not expected: --nonsense; see rois-gateway --help");
    expect_complaint(complaint({"--sim-speed", "fast"}), "--sim-speed must be 0, or a number from 0.01 to 1000, not 'fast'");
    expect_complaint(complaint({"--sim-speed", "0.001"}), "--sim-speed must be 0, or a number from 0.01 to 1000");
    expect_complaint(complaint({"--steering", "maybe"}), "--steering must be one of off|on");
    expect_complaint(complaint({"--threads", "0"}), "--threads must be a whole number from 1 to 256");
    expect_complaint(complaint({"--log-format", "xml"}), "--log-format must be one of text|json");
    expect_complaint(complaint({"--on-session-end", "explode"}), "one of stop|continue");
    for (auto const* listen : {"8080", "host", ":8080", "host:99999", "::1:8080", "host:x", "*:8080", ""}) {
        expect_complaint(complaint({"--listen", listen}), "--listen must be HOST:PORT");
    }
    expect_complaint(complaint({"--listen", "*:8080"}), "or 0.0.0.0:8080 for every address of this machine, not '*:8080'");
    expect_complaint(complaint({"--listen"}), "--listen: 1 required HOST:PORT missing");
    expect_complaint(complaint({"--listen", "--seed", "3"}), "--listen: a value is missing before '--seed'");
}

TEST(CommandLine, RefusesOriginsThatNoBrowserSends) {
    for (auto const* origins :
         {"console.example", "http://a.example/", "http://a.example, http://b.example", "http://a.example/x", "HTTP://a.example",
          "http://A.example", "http://a.example:80", "https://a.example:443", "http://a.example:99999",
          "http://a.example:", "http://", "://a.example", "http://a.example http://b.example/"}) {
        expect_complaint(complaint({"--allowed-origins", origins}),
                         "--allowed-origins must be origins such as https://console.example, in small letters and without a "
                         "path, separated by spaces");
    }
    auto const* const good = "http://a.example  https://b.example:8443 http://[::1]:8443 chrome-extension://abc";
    EXPECT_EQ(complaint({"--allowed-origins", good}), "");
}

TEST(CommandLine, RefusesEqualPortsOfGatewayAndMedia) {
    expect_complaint(complaint({"--listen", "127.0.0.1:8158", "--media", "127.0.0.1:8158"}),
                     "media and listen must not have the same port, 8158");
    EXPECT_EQ(complaint({"--listen", "127.0.0.1:0", "--media", "127.0.0.1:0"}), "");
}

TEST(CommandLine, NeedsAReadableConfigurationFile) {
    expect_complaint(complaint({"--config", ""}), "--config must be a FILE");
    expect_complaint(complaint({"--config", "/nowhere/at.all"}), "/nowhere/at.all: cannot be read");
    expect_complaint(complaint({"--config", "/"}), "/: cannot be read");
}

TEST(CommandLine, DistinguishesServingChecksAndPrintedAnswers) {
    using Wish = CommandLine::Wish;
    EXPECT_EQ(read({}).wish, Wish::serve);
    EXPECT_EQ(read({"--check-config"}).wish, Wish::check_config);
    EXPECT_EQ(read({"--check-health"}).wish, Wish::check_health);
    EXPECT_EQ(read({"--check-profiles", "folder"}).wish, Wish::check_profiles);
    EXPECT_EQ(read({"--check-profiles", "folder"}).folder, "folder");
    for (auto const* flag : {"--help", "--version", "--print-config"}) EXPECT_EQ(read({flag}).wish, Wish::say) << flag;
}

TEST(CommandLine, TakesTheMemoryBudgetInUnits) {
    for (auto const* good : {"512MiB", "1GiB", "65536KiB", "67108864"}) EXPECT_EQ(complaint({"--memory-budget", good}), "");
    for (auto const* bad : {"0", "63MiB", "512", "512MB", "-1", "", "MiB", "2000GiB", "99999999999999999999"})
        expect_complaint(complaint({"--memory-budget", bad}), "--memory-budget must be ");
    EXPECT_THAT(read({"--memory-budget", "1048576KiB", "--print-config"}).words, HasSubstr("\"memory_budget\": \"1GiB\""));
}

TEST(Environment, EmptyVariablesAreNotSet) {
    Variable const seed{"ROIS_SEED", ""};
    EXPECT_EQ(read({}).settings.seed, GatewaySettings{}.seed);
}

TEST(Precedence, IsFlagThenVariableThenFile) {
    TemporaryFile const file{"{\"sim_speed\": 2, \"seed\": 2, \"threads\": 2}"};
    Variable const speed{"ROIS_SIM_SPEED", "4"};
    Variable const seed{"ROIS_SEED", "4"};
    auto const settings = read({"--config", file.name(), "--seed", "3"}).settings;
    EXPECT_EQ(settings.seed, 3);
    EXPECT_EQ(settings.sim_speed, 4);
    EXPECT_EQ(settings.net.threads, 2);
}

TEST(Precedence, AFlagNamesTheFileBeforeTheVariable) {
    TemporaryFile const file{"{\"seed\": 2}"};
    Variable const other{"ROIS_CONFIG", "/nowhere/at.all"};
    EXPECT_EQ(read({"--config", file.name()}).settings.seed, 2);
    expect_complaint(complaint({}), "/nowhere/at.all: cannot be read");
}

}  // namespace
}  // namespace rois::test
