// Checks the rules of the house on the project itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "house/rules.hpp"
#include "house/text.hpp"

namespace rois::house {

namespace {

// One complaint per line.
std::string list(Complaints const& complaints) {
    std::string text;
    for (auto const& complaint : complaints) text += complaint + "\n";
    return text;
}

bool has_folder(Tree const& tree, std::string const& folder) {
    return std::ranges::any_of(tree, [&](auto const& file) { return file.first.starts_with(folder); });
}

}  // namespace

struct House : testing::Test {
    static void SetUpTestSuite() { tree = read_tree(ROIS_SOURCE_DIR); }
    static inline Tree tree;
};

TEST_F(House, IsReadCompletely) {
    EXPECT_TRUE(tree.contains("server/types/ids.hpp"));
    EXPECT_TRUE(tree.contains("dev"));
    EXPECT_TRUE(tree.contains(".ci/run"));
    EXPECT_FALSE(has_folder(tree, ".git/"));
    EXPECT_FALSE(has_folder(tree, "build/"));
}

TEST_F(House, KeepsItsLayers) { EXPECT_EQ(list(against_layers(tree)), ""); }
TEST_F(House, ReadsNoClockBelowTheNetwork) { EXPECT_EQ(list(against_passed_in_time(tree)), ""); }
TEST_F(House, HasNoBracesInAwaits) { EXPECT_EQ(list(against_braces_in_awaits(tree)), ""); }
TEST_F(House, HasFilesOf500LinesAtMost) { EXPECT_EQ(list(against_short_files(tree)), ""); }
TEST_F(House, HasLinesOf140CharactersAtMostInTheWebSources) { EXPECT_EQ(list(against_long_lines(tree)), ""); }
TEST_F(House, LetsDockerSeeAllThatCMakeReads) { EXPECT_EQ(list(against_incomplete_image(tree)), ""); }
TEST_F(House, HasNoBrokenLinks) { EXPECT_EQ(list(against_links(tree)), ""); }
TEST_F(House, HasATestForEachConformanceClaim) { EXPECT_EQ(list(against_proof(tree)), ""); }
TEST_F(House, UsesOnlyPublicNamesOfBoostInTheNetwork) {
    for (auto const& [file, text] : tree) {
        if (file.starts_with("server/net/")) {
            EXPECT_EQ(code_alone(text).find("detail::"), std::string::npos) << file;
        }
    }
}
TEST_F(House, NamesItsDependencies) { EXPECT_EQ(list(against_named_dependencies(tree)), ""); }

}  // namespace rois::house
