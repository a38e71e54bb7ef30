// Decision 18: a query goes to the one component that can answer best.
#include <gmock/gmock.h>

#include "world.hpp"

namespace rois {

using testing::HasSubstr;

TEST(Query, NamesWhoAnswered) {
    World world{navigation, speech};
    auto desk = world.connect();
    auto const reply = desk.query("route");
    EXPECT_EQ(reply.return_code, ReturnCode::ok);
    EXPECT_EQ(reply.component_ref, (Identifier{"navigation", "OMG", {}, {}}));
    EXPECT_EQ(in_words(reply.results.parameters), "length=2.5");
}

TEST(Query, PrefersWhatIsReadyThenTheLowestRef) {
    World world{named("robot_a", navigation), named("robot_b", navigation), named("robot_c", navigation)};
    auto desk = world.connect(), hall = world.connect();
    EXPECT_EQ(desk.query("route").component_ref.code, "robot_a");
    hall.bind("robot_a");
    EXPECT_EQ(desk.query("route").component_ref.code, "robot_b");
    EXPECT_EQ(hall.query("route").component_ref.code, "robot_a");
    world["robot_b"].status_now = ComponentStatus::warning;
    EXPECT_EQ(desk.query("route").component_ref.code, "robot_c");
    world["robot_c"].status_now = ComponentStatus::error;
    EXPECT_EQ(desk.query("route").component_ref.code, "robot_a") << "when none is READY";
}

TEST(Query, GoesWhereTheConditionSays) {
    World world{named("robot_a", navigation), named("robot_b", navigation), speech};
    auto desk = world.connect();
    EXPECT_EQ(desk.query("route", equal("component_ref", "robot_b")).component_ref.code, "robot_b");
    EXPECT_EQ(desk.query("route", equal("component_ref", "speech")).return_code, ReturnCode::unsupported);
    EXPECT_EQ(desk.query("route", equal("colour", "red")).return_code, ReturnCode::bad_parameter);
    EXPECT_EQ(desk.query("route", not_understood("what is this")).reason, "what is this");
}

TEST(Query, ThatNobodyKnowsIsUnsupported) {
    World world{navigation};
    auto const reply = world.connect().query("weather");
    EXPECT_EQ(reply.return_code, ReturnCode::unsupported);
    EXPECT_THAT(reply.reason, HasSubstr("'weather'"));
    EXPECT_EQ(world.connect().query("dock").return_code, ReturnCode::unsupported) << "a command is no query";
}

TEST(Query, ForParametersNeedsNoBinding) {
    World world{speech};
    auto desk = world.connect();
    auto const reply = desk.query("get_parameter");
    EXPECT_EQ(in_words(reply.results.parameters), "synthesizable_languages=en|ja volume=50 language=en");
}

TEST(Query, ForTheStatusIsTheEngines) {
    World world{navigation};
    auto const reply = world.connect().query("component_status");
    EXPECT_EQ(reply.results.parameters.front(), status_of("status", ComponentStatus::ready));
    EXPECT_EQ(reply.component_ref.code, "navigation");
}

TEST(Query, ThatCannotBeAnsweredNowIsAnError) {
    World world{navigation};
    world["navigation"].throws_in = {"nothing known"};
    auto const reply = world.connect().query("route");
    EXPECT_EQ(reply.return_code, ReturnCode::error);
    EXPECT_EQ(reply.reason, "the component 'navigation' could not answer");
}

}  // namespace rois
