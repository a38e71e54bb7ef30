#include "main/engines_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

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
std::string complaint(std::string const& text) {
    TemporaryFile const file{text};
    try {
        read_engines_file(file.name());
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
    {"name": "robot-1", "url": "https://robot", "components": ["navigation"], "window": 1.5, "resume_window": 60,
     "motion_lease": 0.5, "most_components": 20, "longest_document": 200000, "position": [1, 2, 3], "orientation": [0, 0, 90],
     "covariance": [4, 0, 0, 0, 4, 0, 0, 0, 1]}
]})");
    ASSERT_EQ(engines.size(), 2u);
    EXPECT_EQ(engines[0].name, "hall");
    EXPECT_EQ(engines[0].window, 3s);
    EXPECT_FALSE(engines[0].placement);
    EXPECT_THAT(engines[1].components, ElementsAre("navigation"));
    EXPECT_EQ(engines[1].window, 1500ms);
    EXPECT_EQ(engines[1].resume_window, 60s);
    EXPECT_EQ(engines[1].motion_lease, 500ms);
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
    EXPECT_EQ(complaint(R"({"engines": 1})"), R"(1:2: expected only "engines": [ ... ], a list of sub engines)");
    EXPECT_EQ(complaint("{\n\"robots\": []}"), R"(2:1: expected only "engines": [ ... ], a list of sub engines)");
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
    std::string const good =
        "{\"engines\": [\n{\"name\": \"a\", \"url\": \"ws://a\"},\n{\"name\": \"b\", \"url\": \"ws://b\",\n ";
    auto const with = [&](std::string const& property) { return complaint(good + property + "}]}"); };
    EXPECT_EQ(
        with(R"("colour": 1)"),
        "4:2: sub engine 'b': 'colour' is not a key of a sub engine: expected one of name, url, joins, command, components, "
        "position, orientation, covariance, window, resume_window, motion_lease, most_components, longest_document");
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
    EXPECT_EQ(with(R"("window": 0)"), "4:2: sub engine 'b': window must be a number of seconds from 1.0 to 60.0, not '0'");
    EXPECT_EQ(
        with(R"("components": [])"),
        R"(4:2: sub engine 'b': components must be a list of refs of components, such as ["navigation", "speech"], not '[]')");
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

}  // namespace rois::test
