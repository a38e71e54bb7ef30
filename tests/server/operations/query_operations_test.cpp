// Query interface (table 4).
#include "server/conversation.hpp"

namespace rois::test {
namespace {

using testing::Contains;
using testing::Key;
using testing::Pair;
using testing::SizeIs;

struct QueryOperations : Conversation {};
ROIS_OVER_BOTH_WAYS(QueryOperations);

TEST_P(QueryOperations, GoesToTheComponentThatKnows) {
    auto const answer = desk.query("robot_position");
    EXPECT_THAT(answer, IsOk());
    EXPECT_THAT(answer.children(), ElementsAre("component_ref", "results"));
    EXPECT_EQ(answer.ref(), "system_information");
    auto const results = answer.values();
    EXPECT_THAT(results, SizeIs(3));
    EXPECT_THAT(results, Contains(Key("timestamp")));
    EXPECT_THAT(results, Contains(Pair("robot_ref", ElementsAre("robot1"))));
    EXPECT_THAT(results, Contains(Pair("position_data", SizeIs(1))));
    auto const located = answer.root().child("results").child("located");
    EXPECT_STREQ(located.attribute("of").value(), "position_data");
    EXPECT_STREQ(located.attribute("ref").value(), "robot1");
    EXPECT_STREQ(located.attribute("crs").value(), "urn:x-rois:def:crs:simulation::hall");
    EXPECT_TRUE(located.child("position"));
}

TEST_P(QueryOperations, TheStatusIsThatOfTheCaller) {
    Application rival{GetParam(), empty_hall()};
    rival.connect();
    rival.bind("navigation");
    auto const navigation = where(equal("component_ref", "navigation"));
    auto const answer = desk.query("component_status", navigation);
    EXPECT_THAT(answer, IsOk());
    EXPECT_EQ(answer.ref(), "navigation");
    EXPECT_THAT(answer.values(), ElementsAre(Pair("status", ElementsAre("BUSY"))));
    EXPECT_THAT(rival.query("component_status", navigation).values(), ElementsAre(Pair("status", ElementsAre("READY"))));
}

TEST_P(QueryOperations, PrefersReadyComponentsThenTheLowestRef) {
    EXPECT_EQ(desk.query("component_status").ref(), "face_detection");
    Application rival{GetParam(), empty_hall()};
    rival.connect();
    rival.bind("face_detection");
    EXPECT_EQ(desk.query("component_status").ref(), "face_localization");
}

TEST_P(QueryOperations, ReadsParametersWithoutABinding) {
    auto const answer = desk.query("get_parameter", where(literal_first("speech_recognition", "name")));
    EXPECT_THAT(answer, IsOk());
    EXPECT_EQ(answer.ref(), "speech_recognition");
    EXPECT_THAT(answer.values(), Contains(Pair("recognizable_languages", Contains("en"))));
}

TEST_P(QueryOperations, OfTheEngine) {
    EXPECT_THAT(desk.query("engine_status").values(), Contains(Pair("status", ElementsAre("READY"))));
}

TEST_P(QueryOperations, WithoutAComponentThatAnswersIsUnsupported) {
    EXPECT_THAT(desk.query("weather"), IsRefused("UNSUPPORTED", "weather"));
    EXPECT_THAT(desk.query("robot_position", where(equal("name", "navigation"))), IsRefused("UNSUPPORTED", "robot_position"));
}

TEST_P(QueryOperations, RefuseAnInvalidCondition) {
    EXPECT_THAT(desk.query("robot_position", where(undefined_function("name"))), IsRefused("BAD_PARAMETER", "is_free"));
    EXPECT_THAT(desk.query("robot_position", where(equal("colour", "red"))), IsRefused("BAD_PARAMETER", "colour"));
}

}  // namespace
}  // namespace rois::test
