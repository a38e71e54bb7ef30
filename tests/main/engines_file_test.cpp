#include "main/engines_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "kit/gateway_process.hpp"
#include "main/settings.hpp"
#include "main/temporary_file.hpp"

namespace rois::test {

namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

std::vector<remote::SubEngine> read(std::string const& text) {
    TemporaryFile const file{text};
    return read_engines_file(file.name());
}

// The complaint without the name of the file.
std::string complaint(std::string const& text, TakenNames const& taken = {}) {
    TemporaryFile const file{text};
    try {
        read_engines_file(file.name(), taken);
    } catch (BadSettings const& bad) {
        return std::string{bad.what()}.substr(file.name().size() + 1);
    }
    return "";
}

}  // namespace

TEST(EnginesFile, ListsSubEngines) {
    auto const engines = read(R"(// with comments
{"engines": [
    {"name": "hall", "url": "ws://hall:8080"},
    {"name": "robot-1", "url": "https://robot", "components": ["navigation"], "engine": "hall.robot1", "window": 1.5, "resume_window": 60,
     "motion_lease": 1.5, "most_components": 20, "longest_document": 200000, "position": [1, 2, 3], "orientation": [0, 0, 90],
     "covariance": [4, 0, 0, 0, 4, 0, 0, 0, 1]}
]})");
    ASSERT_EQ(engines.size(), 2u);
    EXPECT_EQ(engines[0].name, "hall");
    EXPECT_EQ(engines[0].window, 3s);
    EXPECT_FALSE(engines[0].placement);
    EXPECT_THAT(engines[1].components, ElementsAre("navigation"));
    EXPECT_EQ(engines[0].engine, "");
    EXPECT_EQ(engines[1].engine, "hall.robot1");
    EXPECT_EQ(engines[1].window, 1500ms);
    EXPECT_EQ(engines[1].resume_window, 60s);
    EXPECT_EQ(engines[1].motion_lease, 1500ms);
    EXPECT_EQ(engines[1].most_components, 20u);
    EXPECT_EQ(engines[1].longest_document, 200'000u);
    ASSERT_TRUE(engines[1].placement);
    EXPECT_THAT(engines[1].placement->position, ElementsAre(1, 2, 3));
    EXPECT_THAT(engines[1].placement->orientation, ElementsAre(0, 0, 90));
    EXPECT_EQ(engines[1].placement->covariance.size(), 9u);
    EXPECT_THAT(read(R"({"engines": []})"), testing::IsEmpty());
}

TEST(EnginesFile, MayNameAProgramThatJoins) {
    auto const engines = read(R"({"engines": [{"name": "lamps", "command": ["sh", "-c", "lamp"]},
                                              {"name": "other", "joins": "o", "command": ["sh"]}]})");
    EXPECT_THAT(engines.at(0).command, ElementsAre("sh", "-c", "lamp"));
    EXPECT_EQ(engines.at(0).joins, "lamps");
    EXPECT_TRUE(std::filesystem::is_directory(engines.at(0).folder));
    EXPECT_EQ(engines.at(1).joins, "o");
}

TEST(EnginesFile, NamesThePlaceOfEachMistake) {
    EXPECT_EQ(complaint(""), "1:1: this is not JSON: unexpected end of input; expected '[', '{', or a literal");
    EXPECT_EQ(complaint("{}"), R"(1:1: expected "engines": [ ... ], a list of sub engines)");
    EXPECT_EQ(complaint(R"({"engines": 1})"), R"(1:2: "engines" must be a list of sub engines, [ ... ], not '1')");
    EXPECT_EQ(complaint("{\n\"robots\": []}"), R"(2:1: 'robots' is not a key of this file: expected "engines" or "choosing")");
    EXPECT_EQ(complaint(R"({"engines": ["hall"]})"), "1:2: each sub engine must be an object, { ... }");
    EXPECT_EQ(complaint(R"({"engines": [{"url": "ws://a"}]})"), "1:14: a sub engine has no 'name'");
    EXPECT_EQ(
        complaint(R"({"engines": [{"name": "a"}]})"),
        "1:15: sub engine 'a': needs either 'url' (this gateway connects) or 'joins' (the sub engine connects), and has neither");
    EXPECT_EQ(
        complaint(R"({"engines": [{"name": "a", "url": "ws://a", "joins": "a"}]})"),
        "1:15: sub engine 'a': needs either 'url' (this gateway connects) or 'joins' (the sub engine connects), and has both");
    EXPECT_EQ(complaint(R"({"engines": [{"name": "a", "joins": "x"}, {"name": "b", "joins": "x"}]})"),
              "1:57: two sub engines join as 'x'");
    EXPECT_EQ(complaint(R"({"engines": [{"name": "a", "url": "ws://x"}, {"name": "b", "url": "ws://x"}]})"),
              "1:60: two sub engines have the url 'ws://x'");
    std::string const good =
        "{\"engines\": [\n{\"name\": \"a\", \"url\": \"ws://a\"},\n{\"name\": \"b\", \"url\": \"ws://b\",\n ";
    auto const with = [&](std::string const& property) { return complaint(good + property + "}]}"); };
    EXPECT_EQ(
        with(R"("colour": 1)"),
        "4:2: sub engine 'b': 'colour' is not a key of a sub engine: expected one of name, url, joins, command, components, "
        "engine, position, orientation, covariance, token_file, ca_file, certificate_file, window, resume_window, motion_lease, "
        "most_components, longest_document");
    EXPECT_EQ(
        with(R"("command": "lamp")"),
        R"(4:2: sub engine 'b': command must be a program and its arguments, such as ["python3", "lamp.py"], not '"lamp"')");
    EXPECT_EQ(
        with(R"("command": ["sh", ""])"),
        R"(4:2: sub engine 'b': command must be a program and its arguments, such as ["python3", "lamp.py"], not '["sh",""]')");
    EXPECT_EQ(with(R"("command": ["no-such-program"])"),
              "4:2: sub engine 'b': program 'no-such-program' not found in PATH; the name of a program in the folder of this "
              "file begins with './'");
    EXPECT_THAT(
        with(R"("command": ["./engines.json"])"),
        testing::MatchesRegex("4:2: sub engine 'b': program './engines.json': '/.*/engines.json' is not an executable file"));
    EXPECT_EQ(with(R"("command": ["sh"])"), "4:2: sub engine 'b': 'command' and 'url' exclude each other: a program joins");
    EXPECT_EQ(with(R"("window": 0)"), "4:2: sub engine 'b': window must be a number of seconds from 1.0 to 30.0, not '0'");
    EXPECT_EQ(
        with(R"("components": [])"),
        R"(4:2: sub engine 'b': components must be a list of different refs of components, none of them empty, such as ["navigation", "speech"], not '[]')");
    EXPECT_EQ(with(R"("engine": "")"),
              R"(4:2: sub engine 'b': engine must be the name of an engine of the sub engine, such as "robot1", not '""')");
    EXPECT_EQ(with(R"("engine": 1)"),
              R"(4:2: sub engine 'b': engine must be the name of an engine of the sub engine, such as "robot1", not '1')");
    EXPECT_EQ(with(R"("position": [1, 2])"), "4:2: sub engine 'b': position must be [x, y, z] in mm, not '[1,2]'");
    EXPECT_EQ(with(R"("most_components": 0)"),
              "4:2: sub engine 'b': most_components must be a whole number from 1 to 100000, not '0'");
    EXPECT_EQ(with(R"("longest_document": 1)"),
              "4:2: sub engine 'b': longest_document must be a whole number from 100000 to 64000000, not '1'");
    EXPECT_EQ(with(R"("resume_window": 1)"),
              "4:2: sub engine 'b': resume_window (1.0 s) must not be shorter than window (3.0 s)");
    EXPECT_THAT(with(R"("covariance": [1, 0, 0, 0, -1, 0, 0, 0, 1])"), testing::StartsWith("4:2: sub engine 'b': "));
    EXPECT_EQ(complaint("{\"engines\": [{\"name\": \"a b\", \"url\": \"ws://a\"}]}"),
              "1:15: name must be a name of letters, digits, '_' and '-', with at most 64 characters, not '\"a b\"'");
    EXPECT_EQ(complaint("{\"engines\": [{\"name\": \"a\", \"url\": \"tcp://a\"}]}"),
              "1:28: sub engine 'a': url must be the URL of a gateway, such as ws://127.0.0.1:8081, not '\"tcp://a\"'");
    EXPECT_EQ(complaint("{\"engines\": [{\"name\": \"a\", \"url\": \"ws://a\"},\n{\"name\": \"a\", \"url\": \"ws://b\"}]}"),
              "2:2: there are two sub engines with the name 'a'");
}

TEST(EnginesFile, RefusesTimesThatAGatewayRefuses) {
    auto const with = [](std::string const& property) {
        return complaint("{\"engines\": [{\"name\": \"a\", \"joins\": \"a\",\n" + property + "}]}");
    };
    for (auto const* window : {"0.5", "30.5", "60", "null"})
        EXPECT_EQ(with("\"window\": " + std::string{window}),
                  "2:1: sub engine 'a': window must be a number of seconds from 1.0 to 30.0, not '" + std::string{window} + "'");
    for (auto const* lease : {"0.5", "2.5", "3", "3000"})
        EXPECT_EQ(
            with("\"motion_lease\": " + std::string{lease}),
            "2:1: sub engine 'a': motion_lease must be a number of seconds from 1.0 to 2.0, not '" + std::string{lease} + "'");
    for (auto const* good : {"\"window\": 1", "\"window\": 30", "\"motion_lease\": 1", "\"motion_lease\": 2"})
        EXPECT_EQ(with(good), "") << good;
}

TEST(EnginesFile, RefusesARefThatIsEmptyOrGivenTwice) {
    for (auto const* refs : {R"([""])", R"(["a","a"])", R"(["a",1])", R"("a")"})
        EXPECT_EQ(complaint(R"({"engines": [{"name": "x", "url": "ws://a", "components": )" + std::string{refs} + "}]}"),
                  R"(1:45: sub engine 'x': components must be a list of different refs of components, none of them empty, )"
                  R"(such as ["navigation", "speech"], not ')" +
                      std::string{refs} + "'");
}

TEST(EnginesFile, RefusesAKeyThatIsGivenTwice) {
    EXPECT_EQ(complaint("{\"engines\": [{\"name\": \"a\", \"url\": \"ws://a\",\n \"url\": \"ws://b\"}]}"),
              "2:2: 'url' is given twice in this sub engine");
    EXPECT_EQ(complaint("{\"engines\": [{\"name\": \"a\", \"url\": \"ws://a\", \"\\u006eame\": \"b\"}]}"),
              "1:45: 'name' is given twice in this sub engine");
    EXPECT_EQ(complaint("{\"engines\": [],\n\"engines\": []}"), "2:1: 'engines' is given twice");
}

TEST(EnginesFile, RefusesTheNameOfThisEngineAndOfItsRobots) {
    TakenNames const taken{{"reception", "this engine (engine_name); choose another name"}};
    std::string const entries =
        "{\"engines\": [{\"name\": \"a\", \"url\": \"ws://a\"},\n{\"name\": \"reception\", \"joins\": \"b\"}]}";
    EXPECT_EQ(complaint(entries, taken),
              "2:2: sub engine 'reception': name is already the name of this engine (engine_name); choose another name");
    EXPECT_EQ(complaint(entries), "");
}

// By the program, which knows the names.
TEST(EnginesFile, IsCheckedAgainstTheNamesOfTheGateway) {
    auto const complaint_of = [](std::string const& name, std::vector<std::string> const& more) {
        TemporaryFile const file{"{\"engines\": [{\"name\": \"" + name + "\", \"joins\": \"a\"}]}"};
        std::vector<std::string> arguments{"--check-config", "--engines", file.name()};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return kit::run_gateway(arguments).error;
    };
    EXPECT_THAT(complaint_of("reception", {}), testing::HasSubstr(":1:15: sub engine 'reception': name is already the name of "
                                                                  "this engine (engine_name); choose another name"));
    EXPECT_THAT(complaint_of("robot1", {}), testing::HasSubstr(":1:15: sub engine 'robot1': name is already the name of a "
                                                               "simulated robot; choose another name, or set robots to none"));
    EXPECT_EQ(complaint_of("reception", {"--engine-name", "hall"}), "");
    EXPECT_EQ(complaint_of("robot1", {"--robots", "none"}), "");
}

TEST(EnginesFile, NamesCertificatesThatExist) {
    EXPECT_EQ(complaint("{\"engines\": [{\"name\": \"a\", \"url\": \"wss://a\",\n \"ca_file\": \"/nowhere.pem\"}]}"),
              "2:2: sub engine 'a': ca_file: cannot use '/nowhere.pem': No such file or directory; expected certificates in "
              "PEM format");
}

TEST(EnginesFile, ReportsAMistakeInItsOwnEntry) {
    EXPECT_EQ(
        complaint("{\"engines\": [\n {\"name\": \"a\", \"url\": \"ws://a\", \"window\": 3, \"covariance\": [1,0,0,0,-1,0,0,0,1]},"
                  "\n {\"name\": \"b\", \"url\": \"ws://b\", \"resume_window\": 2}]}"),
        complaint(
            "{\"engines\": [\n {\"name\": \"a\", \"url\": \"ws://a\", \"window\": 3, \"covariance\": [1,0,0,0,-1,0,0,0,1]}]}"));
    // `joins` of the second entry follows from its name, and the third entry sets the key.
    EXPECT_EQ(complaint("{\"engines\": [{\"name\": \"a\", \"joins\": \"b\"},\n{\"name\": \"b\", \"command\": [\"sh\"]},\n"
                        "{\"name\": \"c\", \"joins\": \"c\"}]}"),
              "2:1: two sub engines join as 'b'");
    // Keys of objects inside of a value, and braces in comments, are not those of an entry.
    EXPECT_EQ(complaint("{\"engines\": [/* { */ {\"components\": {\"window\": 1},\n \"window\": 0, \"name\": \"a\"}]}"),
              "1:23: sub engine 'a': components must be a list of different refs of components, none of them empty, such as "
              "[\"navigation\", \"speech\"], not '{\"window\":1}'");
    EXPECT_EQ(complaint("{\"engines\": [/* { */ {\"most_components\": {\"longest_document\": 1},\n \"longest_document\": 0, "
                        "\"name\": \"a\"}]}"),
              "2:2: sub engine 'a': longest_document must be a whole number from 100000 to 64000000, not '0'");
}

TEST(EnginesFile, TakesOnlyUrlsOfGateways) {
    for (auto const* good : {"ws://a", "wss://a.example:8443", "http://127.0.0.1:8080/", "https://a/robots", "WS://A",
                             "ws://[::1]", "ws://[::1]:8080/x"})
        EXPECT_TRUE(is_gateway_url(good)) << good;
    for (auto const* bad : {"",
                            "a",
                            "ws:/a",
                            "ws://",
                            "ws:///x",
                            "tcp://a",
                            "ws://127.0.0.1:notaport",
                            "ws://127.0.0.1:99999",
                            "ws://a:0",
                            "ws://a:",
                            "ws://a:-1",
                            "ws://a:80:80",
                            "ws://:80",
                            "ws://user@host/?x=1",
                            "ws://user@host",
                            "ws://a/?x=1",
                            "ws://a#x",
                            "ws://a b",
                            "ws://a/b c",
                            "ws://[::1",
                            "ws://::1]",
                            "ws://[::1]8080",
                            "ws://[a]",
                            "ws://a..b"})
        EXPECT_FALSE(is_gateway_url(bad)) << bad;
}

}  // namespace rois::test
