#include "main/choosing_section.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "main/engines_file.hpp"
#include "main/settings.hpp"
#include "main/temporary_file.hpp"

namespace rois::test {

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

choosing::Settings read(std::string const& section) {
    TemporaryFile const file{R"({"engines": [{"name": "robot1", "url": "ws://a"}, {"name": "hall", "url": "ws://b"}],)"
                             "\n" +
                             section + "}"};
    return read_choosing(file.name(), read_engines_file(file.name()));
}

// The complaint without the name of the file.
std::string complaint(std::string const& section) {
    try {
        read("\"choosing\": " + section);
    } catch (BadSettings const& bad) {
        std::string const what = bad.what();
        return what.substr(what.find(":2:") + 1);
    }
    return "";
}

}  // namespace

TEST(ChoosingSection, NamesLogicalComponentsEnginesAndAreas) {
    auto const settings = read(
        R"("choosing": {"logical": ["navigation", "move"], "sensing": ["person_detection"], "engines": ["hall.robot2", "robot1"],
        "areas": {"robot1": [[0, 0], [1, 0.5], [2, 2]]}})");
    EXPECT_THAT(settings.logical, ElementsAre("navigation", "move"));
    EXPECT_THAT(settings.sensing, ElementsAre("person_detection"));
    EXPECT_THAT(settings.engines, ElementsAre("hall.robot2", "robot1"));
    EXPECT_THAT(settings.areas.at("robot1"), ElementsAre(ElementsAre(0, 0), ElementsAre(1, 0.5), ElementsAre(2, 2)));
}

TEST(ChoosingSection, MayBeMissing) {
    TemporaryFile const file{R"({"engines": []})"};
    EXPECT_THAT(read_choosing(file.name(), {}).logical, IsEmpty());
}

TEST(ChoosingSection, MayStandBeforeTheEngines) {
    TemporaryFile const file{R"({"choosing": {"logical": ["move"], "engines": ["robot1"], "areas": {}},
                                 "engines": [{"name": "robot1", "url": "ws://a"}]})"};
    auto const engines = read_engines_file(file.name());
    ASSERT_EQ(engines.size(), 1u);
    EXPECT_THAT(read_choosing(file.name(), engines).logical, ElementsAre("move"));
}

TEST(ChoosingSection, IsRefusedWithThePlaceTheValueAndTheExpectation) {
    EXPECT_EQ(complaint("3"), "2:1: choosing must be an object, { ... }");
    std::string const expected =
        "expected \"engines\" (names of sub engines), \"logical\" and \"sensing\" (names of components, at least one of the two) "
        "and, if wanted, \"areas\" and \"low_battery\"";
    EXPECT_EQ(complaint(R"({"logical": ["a"]})"), "2:13: \"choosing\" is not complete: " + expected);
    EXPECT_EQ(complaint(R"({"engines": ["robot1"]})"), "2:13: \"choosing\" is not complete: " + expected);
    EXPECT_EQ(complaint(R"({"logical": ["a"], "engines": ["robot1"], "battery": 3})"),
              "2:55: 'battery' is not a key of \"choosing\": " + expected);
    EXPECT_EQ(complaint(R"({"logical": ["a"], "engines": ["robot1"], "sensing": ["a"]})"), "2:55: 'a' is in \"logical\" already");
    EXPECT_EQ(complaint(R"({"logical": [], "engines": ["robot1"]})"),
              "2:14: logical must be a list of different names, none of them empty, such as [\"robot1\", \"robot2\"], not '[]'");
    EXPECT_EQ(complaint(R"({"logical": ["a", "a"], "engines": ["robot1"]})"),
              "2:14: logical must be a list of different names, none of them empty, such as [\"robot1\", \"robot2\"], not "
              "'[\"a\",\"a\"]'");
    EXPECT_EQ(complaint(R"({"logical": ["robot1.a"], "engines": ["robot1"]})"),
              "2:14: 'robot1.a' must be the name of a component without its engine, such as \"navigation\"");
    EXPECT_EQ(complaint(R"({"logical": ["a"], "engines": ["robot3"]})"),
              "2:32: 'robot3' is not known: it must be the name of a sub engine of this file, or of an engine of one, such as "
              "\"hall.robot1\"");
    EXPECT_EQ(complaint(R"({"logical": ["a"], "engines": ["robot1"], "areas": []})"),
              "2:55: areas must be an object with the name and the area of an engine, not '[]'");
    EXPECT_EQ(complaint(R"({"logical": ["a"], "engines": ["robot1"], "areas": {"hall": []}})"),
              "2:55: areas: 'hall' is not in \"engines\"");
    EXPECT_EQ(complaint(R"({"logical": ["a"], "engines": ["robot1"], "areas": {"robot1": [[0, 0], [1, 1]]}})"),
              "2:55: the area of 'robot1' must have at least three corners, [x, y] in mm, not '[[0,0],[1,1]]'");
    EXPECT_EQ(complaint(R"({"logical": ["a"], "engines": ["robot1"], "areas": {"robot1": [[0, 0], [1, 1], [2, 2]]}})"),
              "2:55: the area of 'robot1' has no surface: its corners must not lie on one line, nor its sides cross, as "
              "'[[0,0],[1,1],[2,2]]' do");
    EXPECT_EQ(complaint(R"({"logical": ["a"], "engines": ["robot1"], "areas": {"robot1": [], "robot1": []}})"),
              "2:79: 'robot1' is given twice in \"areas\"");
    EXPECT_EQ(complaint(R"({"logical": ["system_information"], "engines": ["robot1"]})"),
              "2:14: 'system_information' cannot be logical: a query without a condition joins the answers of all engines");
    EXPECT_EQ(complaint(R"({"logical": ["person_detection"], "engines": ["robot1"]})"),
              "2:14: 'person_detection' senses: it belongs to \"sensing\"");
    EXPECT_EQ(complaint(R"({"sensing": ["navigation"], "engines": ["robot1"]})"),
              "2:14: 'navigation' acts: it belongs to \"logical\"");
    for (std::string const wrong : {"-1", "101", "2.5", "\"20\""})
        EXPECT_EQ(complaint(R"({"logical": ["a"], "engines": ["robot1"], "low_battery": )" + wrong + "}"),
                  "2:55: low_battery must be a number of percent, 0 to 100, not '" + wrong + "'");
    EXPECT_EQ(complaint(R"({"logical": ["a"], "logical": ["b"], "engines": ["robot1"]})"),
              "2:32: 'logical' is given twice in \"choosing\"");
}

}  // namespace rois::test
