// Tests of decisions 27 and 28 for robots.
#include <gmock/gmock.h>

#include "simulation/component_stage.hpp"

namespace rois::simulation::stage {
namespace {

using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::Not;

TEST(Decision27, PositionsAreMillimetresAndDegreesInANamedFrame) {
    Stage stage;
    auto const frame = "urn:x-rois:def:crs:simulation::hall";
    stage["navigation"].start({positions("target_position", {"5000, 3000, 90"}, frame)});
    EXPECT_EQ(stage.outcome("navigation"), "OK");
    EXPECT_NEAR(stage.robot().position.x(), 5, 0.1);
    EXPECT_NEAR(to_degrees(stage.robot().heading), 90, 5) << "counter-clockwise";
    auto const reported = stage["system_information"].query("robot_position");
    auto const text = value(reported, "position_data");
    EXPECT_THAT(text, MatchesRegex("[0-9.]+, [0-9.]+, [0-9.]+"));
    EXPECT_NEAR(std::stod(text), 5000, 150);
    EXPECT_EQ(codebook_of(reported, "position_data"), frame);
    ASSERT_EQ(reported.located.size(), 1U);
    EXPECT_EQ(reported.located[0].crs, frame);
    EXPECT_NEAR(reported.located[0].position[1], 3000, 150);
    EXPECT_NEAR(reported.located[0].orientation.at(2), 90, 5);
    EXPECT_TRUE(std::holds_alternative<Located::Covariance>(reported.located[0].certainty));
}

TEST(Decision28, LanguagesAreThoseOfIso639) {
    Stage stage;
    auto const languages = [&](std::string const& component, std::string const& parameter) {
        return find(stage[component].component().readable_parameters(), parameter)->values;
    };
    for (auto const& all :
         {languages("speech_recognition", "recognizable_languages"), languages("speech_synthesis", "synthesizable_languages")}) {
        EXPECT_THAT(all, Not(IsEmpty()));
        EXPECT_THAT(all, Each(MatchesRegex("[a-z][a-z]")));
        EXPECT_THAT(all, testing::Contains("ja"));
        EXPECT_THAT(all, Not(testing::Contains("jp")));
    }
    EXPECT_THAT(stage["speech_recognition"].refusal("set_parameter", {texts("languages", {"jp"})}).value_or(""),
                HasSubstr("'jp'"));
    EXPECT_THAT(stage["speech_synthesis"].refusal("set_parameter", {text("language", "jp")}).value_or(""), HasSubstr("'jp'"));
}

}  // namespace
}  // namespace rois::simulation::stage
