// The output of `rois`, and its arguments.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "command/exit.hpp"
#include "command/input/arguments.hpp"
#include "command/output/pretty.hpp"
#include "command/output/terminal.hpp"

namespace rois::command {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(ATable, AlignsColumnsWithoutTrailingSpaces) {
    Table table;
    table.add({{"a"}, {"x"}, {}});
    table.add({{"größer"}, {""}, {"z"}});
    EXPECT_EQ(table.text(false, "  "), "  a       x\n  größer     z\n");
}

TEST(ATable, KnowsThatSomeCharactersTakeTwoColumnsOrNone) {
    Table table;
    table.add({{"日本"}, {"x"}});
    table.add({{"e\u0301"}, {"y"}});
    table.add({{"large"}, {"z"}});
    EXPECT_EQ(table.text(false), "日本   x\ne\u0301      y\nlarge  z\n");
}

TEST(ATable, PaintsOnlyTexts) {
    Table table;
    table.add({{"a", Colour::good}, {"b"}});
    EXPECT_EQ(table.text(true), "\x1b[32ma\x1b[0m  b\n");
}

TEST(TextFromOutside, DoesNotSteerTheTerminal) {
    EXPECT_EQ(harmless("a\x1b[31m\x07\nb\x7f\xc2\x9b"), "a?[31m? b??");
    EXPECT_EQ(harmless("größer, 日本"), "größer, 日本");
    EXPECT_EQ(harmless("gr\xf6\xdf"), "gr??") << "no UTF-8";
}

TEST(ADocument, IsIndented) {
    EXPECT_EQ(pretty("<?xml version='1.0'?><a b='1'><c>text</c><d><e/></d></a>"),
              "<a b=\"1\">\n  <c>text</c>\n  <d>\n    <e />\n  </d>\n</a>\n");
    EXPECT_EQ(pretty("no XML"), "no XML");
}

TEST(APlace, IsUnderlinedToTheEndOfItsTag) {
    EXPECT_EQ(underlined("<a>\r\n  <b c='1'/><d/>\r\n</a>", {2, 3}, false), "2 |   <b c='1'/><d/>\n  |   ^~~~~~~~~~\n");
    EXPECT_EQ(underlined("<größe x='1'>", {1, 8}, false), "1 | <größe x='1'>\n  |        ^~~~~~\n") << "characters, not bytes";
    EXPECT_EQ(underlined("<!-- 日本語日本語 --><bad/>", {1, 16}, false),
              "1 | <!-- 日本語日本語 --><bad/>\n  | " + std::string(21, ' ') + "^~~~~~\n");
    EXPECT_EQ(underlined("<日本/>", {1, 1}, false), "1 | <日本/>\n  | ^~~~~~~\n");
    EXPECT_EQ(underlined("<a>", {2, 1}, false), "");
    EXPECT_EQ(underlined("<a>", {1, 9}, false), "");
}

TEST(APlace, IsCutOutOfALongLine) {
    auto const text = std::string(500, 'x') + "<bad/>" + std::string(500, 'y');
    auto const shown = underlined(text, {1, 501}, false);
    EXPECT_EQ(shown, "1 | ..." + std::string(60, 'x') + "<bad/>" + std::string(54, 'y') + "...\n  |    " + std::string(60, ' ') +
                         "^~~~~~\n");
}

ComponentProfile profile() {
    auto const parameter = [](std::string name, std::string type) {
        return ParameterProfile{std::move(name), {std::move(type), {}, {}, {}}, {}, {}};
    };
    ComponentProfile profile;
    profile.object.name = "thing";
    profile.messages.push_back({MessageKind::command, "start", {}, {parameter("loud", "bool")}, {}});
    profile.parameters = {parameter("places", "string[]"), parameter("levels", "int[]"), parameter("volume", "int")};
    return profile;
}

TEST(Arguments, HaveTheTypesOfTheProfile) {
    auto const read =
        read_arguments(profile(), "start", {"volume=3", "places=desk", "Places=1, 2, 3", "levels=1", "levels=2", "loud=true"});
    ASSERT_EQ(read.size(), 4u);
    EXPECT_EQ(read[0].data_type_ref.code, "int");
    EXPECT_THAT(read[1].values, ElementsAre("desk", "1, 2, 3"));
    EXPECT_THAT(read[2].values, ElementsAre("1 2"));
    EXPECT_EQ(read[3].name, "loud");
    EXPECT_TRUE(read_arguments(profile(), "start", {"places="})[0].values.empty());
}

// Otherwise "1, 2, 3" would be in the frame of the component's own engine, while answers to queries are in this engine's.
TEST(Arguments, NameNoFrame) {
    auto placed = profile();
    placed.parameters[0].data_type_ref.codebook_ref = "urn:x-rois:def:crs:map::hall";
    EXPECT_EQ(read_arguments(placed, "start", {"places=1, 2, 3"})[0].data_type_ref.codebook_ref, "");
}

void expect_refused(std::vector<std::string> const& given, std::string const& says) {
    try {
        read_arguments(profile(), "start", given);
        ADD_FAILURE() << given.front() << " was accepted";
    } catch (Trouble const& trouble) {
        EXPECT_EQ(trouble.exit(), Exit::usage);
        EXPECT_THAT(trouble.what(), HasSubstr(says));
    }
}

TEST(Arguments, AreRefusedWithTheReason) {
    expect_refused({"volume"}, "'volume' is not NAME=VALUE");
    expect_refused({"=3"}, "is not NAME=VALUE");
    expect_refused({"pitch=3"}, "thing has no argument 'pitch'; it has loud, places, levels, volume");
    expect_refused({"volume=loud"}, "volume: ");
    expect_refused({"volume=1", "volume=2"}, "volume: ");
    expect_refused({"levels=1 x"}, "levels: ");
}

}  // namespace
}  // namespace rois::command
