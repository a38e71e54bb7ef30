// The configuration file, and the keys that it sets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "main/configuration_file.hpp"
#include "main/keys.hpp"
#include "main/temporary_file.hpp"

namespace rois::test {
namespace {

using testing::HasSubstr;

GatewaySettings settings_of(std::string const& text) {
    TemporaryFile const file{text};
    GatewaySettings settings;
    read_configuration_file(file.name(), settings);
    return settings;
}

// Returns the error in this text, with FILE in place of the file's name.
std::string complaint_about(std::string const& text) {
    TemporaryFile const file{text};
    GatewaySettings settings;
    try {
        read_configuration_file(file.name(), settings);
        return "";
    } catch (BadSettings const& error) {
        std::string words = error.what();
        return words.replace(words.find(file.name()), file.name().size(), "FILE");
    }
}

void expect_complaint(std::string const& complaint, std::string const& wanted) {
    EXPECT_THAT(complaint, HasSubstr(wanted));
    EXPECT_THAT(complaint, testing::Not(HasSubstr("\n")));
}

TEST(ConfigurationFile, SetsKeysAndIgnoresComments) {
    auto const settings =
        settings_of("// a comment\n{\n  \"sim_speed\": 2.5, // twice and a half\n  \"listen\": \"[::1]:9000\"\n}\n");
    EXPECT_EQ(settings.sim_speed, 2.5);
    EXPECT_EQ(settings.net.host, "::1");
    EXPECT_EQ(settings.net.port, 9000);
    EXPECT_EQ(settings.seed, GatewaySettings{}.seed);
}

TEST(ConfigurationFile, MayEndItsLinesWithACarriageReturn) {
    EXPECT_EQ(settings_of("// a comment\r{\"sim_speed\": 2.5}\r").sim_speed, 2.5);
}

TEST(ConfigurationFile, ThatIsPrintedSetsTheSameValues) {
    GatewaySettings settings;
    settings.seed = 77;
    auto const printed = commented_configuration(settings);
    EXPECT_THAT(printed, HasSubstr("\"session_timeout\": 60,\n"));
    auto const read = settings_of(printed);
    for (auto const& key : keys()) EXPECT_EQ(key.show(read), key.show(settings)) << key.name;
}

TEST(ConfigurationFile, WithAMistakeIsRefusedInOneLine) {
    using namespace std::string_literals;
    expect_complaint(complaint_about("{\"listen\": \"[::1]:9000\"}\n\0junk"s), "FILE:2:1: this is not JSON: a byte is 0");
    expect_complaint(complaint_about("{\n  \"sim_sped\": 2\n}"), "FILE:2:3: 'sim_sped' is not a configuration key");
    expect_complaint(complaint_about("{\n\n  // \"threads\": 1,\n  \"threads\": \"two\"\n}"),
                     "FILE:4:3: threads must be a whole number from 1 to 256, not '\"two\"'");
    expect_complaint(complaint_about("{\"listen\": 8080}"), "FILE:1:2: listen must be HOST:PORT");
    expect_complaint(complaint_about("{\"threads\": 1.5}"), "FILE:1:2: threads must be");
    expect_complaint(complaint_about("{\"session_timeout\": -1}"), "FILE:1:2: session_timeout must be a number of seconds");
    expect_complaint(complaint_about("{\n  \"seed\": 1,\n  \"threads\" 2\n}"),
                     "FILE:3:13: this is not JSON: unexpected number literal; expected ':'");
    expect_complaint(complaint_about("{\"listen\": \"x\"\n  \"threads\": 2}"),
                     "FILE:2:3: this is not JSON: unexpected string literal; expected ',' or '}'");
    expect_complaint(complaint_about("{\"seed\": 1 \"a,\" : 2}"),
                     "FILE:1:12: this is not JSON: unexpected string literal; expected ',' or '}'");
    expect_complaint(complaint_about("{\n  \"engine_name\": \"\xC3\xA9\" x}"),
                     "FILE:2:22: this is not JSON: invalid literal; last read: '\"\xC3\xA9\" x'");
    expect_complaint(complaint_about("{\n\"seed\": 1,\n"), "FILE:3:1: this is not JSON: unexpected end of input");
    expect_complaint(complaint_about("{\"engine_name\": \"\xFF\"}"),
                     "FILE:1:18: this is not JSON: invalid string: ill-formed UTF-8 byte");
    expect_complaint(complaint_about("[]"), "FILE:1:1: the file must hold one object");
    expect_complaint(complaint_about("{\"sim_speed\": 1e999}"), "FILE:1:15: the number is too large");
    expect_complaint(complaint_about("{\n  \"seed\": 1,\n  \"seed\": 2\n}"), "FILE:3:3: 'seed' is given twice");
}

TEST(Keys, AcceptTheValuesThatTheyShow) {
    GatewaySettings settings;
    for (auto const& key : keys()) {
        auto const shown = key.show(settings);
        EXPECT_TRUE(shown.empty() || key.set(settings, shown)) << key.name;
        EXPECT_EQ(key.show(settings), shown) << key.name;
    }
}

TEST(Keys, ChangeNothingIfAValueIsInvalid) {
    GatewaySettings settings;
    for (auto const& key : keys()) {
        if (key.kind != Key::Kind::number) continue;
        EXPECT_FALSE(key.set(settings, "x")) << key.name;
        EXPECT_EQ(key.show(settings), key.show(GatewaySettings{})) << key.name;
    }
}

// Finds two keys that set the same member of the settings.
TEST(Keys, SetOnlyTheirOwnValue) {
    GatewaySettings const before;
    for (auto const& key : keys()) {
        GatewaySettings after;
        auto const changes = [&](char const* value) { return key.set(after, value) && key.show(after) != key.show(before); };
        bool const changed = std::ranges::any_of(std::array{"0.5",         "3",
                                                            "7",           "300",
                                                            "2000",        "100000",
                                                            "20000000",    "x",
                                                            "127.0.0.1:1", "https://a.example",
                                                            "192.0.2.1",   "ws://a.example:1",
                                                            "100MiB",      "json",
                                                            "debug",       "none",
                                                            "on",          "yes",
                                                            "any",         "required",
                                                            "continue",    "full"},
                                                 changes);
        EXPECT_TRUE(changed) << key.name << ": no value of this test fits";
        for (auto const& other : keys()) {
            if (other.name != key.name) {
                EXPECT_EQ(other.show(after), other.show(before)) << key.name << " changes " << other.name;
            }
        }
    }
}

TEST(Keys, AreFlagsAndVariables) {
    Key key;
    key.name = "sim_speed";
    EXPECT_EQ(flag_of(key), "--sim-speed");
    EXPECT_EQ(variable_of(key), "ROIS_SIM_SPEED");
}

}  // namespace
}  // namespace rois::test
