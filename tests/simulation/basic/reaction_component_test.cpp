#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "basic/components/reaction_types.hpp"
#include "simulation/component_stage.hpp"

namespace rois::simulation::stage {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

Parameter reaction_ref(std::string code) { return reference("reaction_ref", std::move(code)); }

TEST(Reaction, ShowsAReactionOfAnnexDForItsTime) {
    Stage stage;
    stage.step();
    auto const begun = stage.hall().now();
    stage["reaction"].start({reaction_ref("9")});
    stage.step();
    ASSERT_TRUE(stage.robot_state().showing);
    EXPECT_EQ(stage.robot_state().showing->reaction, "9");
    EXPECT_EQ(stage.outcome("reaction"), "OK");
    EXPECT_NEAR(in_seconds(stage.hall().now() - begun), reaction_type("9").duration, 0.05);
    stage.step();
    EXPECT_FALSE(stage.robot_state().showing);
}

TEST(Reaction, AcceptsItsName) {
    Stage stage;
    stage["reaction"].start({reaction_ref("Bow the head")});
    stage.step();
    ASSERT_TRUE(stage.robot_state().showing);
    EXPECT_EQ(stage.robot_state().showing->reaction, "9");
}

TEST(Reaction, AcceptsItsGestureName) {
    EXPECT_EQ(reaction_code("bow"), "9");
    EXPECT_EQ(reaction_code("Nod"), "1");
    EXPECT_EQ(reaction_code(" clap "), "14");
    Stage stage;
    stage["reaction"].start({reaction_ref("bow")});
    stage.step();
    ASSERT_TRUE(stage.robot_state().showing);
    EXPECT_EQ(stage.robot_state().showing->reaction, "9");
}

TEST(Reaction, RefusesUnknownReactions) {
    Stage stage;
    auto& reaction = stage["reaction"];
    for (auto code : {"0", "51", "-1", "dance", "9.5"})
        EXPECT_THAT(reaction.refusal("set_parameter", {reaction_ref(code)}).value_or(""), HasSubstr(code));
    EXPECT_THAT(reaction.refusal("start", {reaction_ref("dance")}).value_or(""), HasSubstr("bow (9)"));
    EXPECT_THAT(reaction.refusal("start", {}).value_or(""), HasSubstr("mandatory"));
    EXPECT_FALSE(reaction.refusal("set_parameter", {}));
    for (int code = 1; code <= 50; ++code) EXPECT_FALSE(reaction.refusal("start", {reaction_ref(std::to_string(code))})) << code;
}

TEST(Reaction, HasFiftyKinds) {
    Stage stage;
    auto const readable = stage["reaction"].readable_parameters();
    ASSERT_NE(find(readable, "available_reactions"), nullptr);
    EXPECT_THAT(find(readable, "available_reactions")->values, SizeIs(50));
    EXPECT_EQ(find(readable, "available_reactions")->data_type_ref.codebook_ref, "urn:x-rois:def:codebook:simulation::reaction");
    std::set<std::string> codes;
    for (auto const& type : reaction_types) {
        codes.insert(reaction_code(type.name));
        EXPECT_GT(type.duration, 0) << type.name;
    }
    EXPECT_THAT(codes, SizeIs(50));
}

TEST(Reaction, ShowsTheRestAfterResume) {
    Stage stage;
    stage["reaction"].start({reaction_ref("15")});
    stage.run(1);
    stage["reaction"].suspend();
    stage.run(30);
    EXPECT_FALSE(stage["reaction"].ended());
    EXPECT_FALSE(stage.robot_state().showing);
    stage["reaction"].resume();
    auto const resumed = stage.hall().now();
    stage.step();
    EXPECT_TRUE(stage.robot_state().showing);
    EXPECT_EQ(stage.outcome("reaction"), "OK");
    EXPECT_NEAR(in_seconds(stage.hall().now() - resumed), reaction_type("15").duration - 1, 0.05);
}

TEST(Reaction, EndsWhenStopped) {
    Stage stage;
    stage["reaction"].start({reaction_ref("15")});
    stage.run(1);
    stage["reaction"].stop();
    stage.step();
    EXPECT_FALSE(stage.robot_state().showing);
}

}  // namespace
}  // namespace rois::simulation::stage
