// Components that fail: the end of their commands, the notified sessions, and the details (decisions 7, 16, 24; table 6).
#include "server/conversation.hpp"

namespace rois::test {
namespace {

using testing::Contains;
using testing::Key;
using testing::Not;
using testing::Pair;
using testing::UnorderedElementsAre;

GatewayProcess& unwell() {
    static GatewayProcess robot{{"--scenario", ROIS_SOURCE_DIR "/tests/server/data/unwell.xml", "--start-timeout", "0.2"}};
    return robot;
}

struct Errors : testing::TestWithParam<Transport> {
    Application desk{GetParam(), unwell()};
    Application other{GetParam(), unwell()};

    Errors() {
        desk.connect();
        other.connect();
        for (auto const* ref : {"navigation", "speech_synthesis"}) EXPECT_THAT(desk.bind(ref), IsOk());
    }

    Document detail_of(std::string const& id, Xml const& condition = {}) {
        return desk.ask("get_error_detail", text_element("error_id", id) + condition);
    }
    static Command drive(std::string const& id) {
        return {.component = "navigation", .id = id, .arguments = {target_position({"desk"})}};
    }
};
ROIS_OVER_BOTH_WAYS(Errors);

TEST_P(Errors, OfACommandEndItsSequence) {
    EXPECT_THAT(desk.execute(unit(drive("drive")) + unit({.component = "navigation", .type = "stop", .id = "next"})), IsOk());
    EXPECT_EQ(desk.status_of("next"), "ABORT");
    auto const error = desk.receive();
    EXPECT_THAT(lines(desk.history()), ElementsAre("completed drive ERROR", "completed next ABORT", "receive_error"));
    EXPECT_THAT(error.children(), ElementsAre("error_id", "error_type", "component_ref"));
    EXPECT_EQ(error.text("error_type"), "COMPONENT_INTERNAL_ERROR");
    EXPECT_EQ(error.ref(), "navigation");
}

TEST_P(Errors, HaveDetails) {
    desk.execute(drive("drive"));
    desk.status_of("drive");
    auto const id = desk.receive().text("error_id");
    auto const detail = detail_of(id);
    EXPECT_THAT(detail, IsOk());
    EXPECT_THAT(detail.children(), ElementsAre("results"));
    EXPECT_THAT(detail.values(), Contains(Pair("component_ref", ElementsAre("navigation"))));
    EXPECT_THAT(detail.values(), Contains(Pair("text", ElementsAre(testing::HasSubstr("failed")))));
    EXPECT_THAT(detail.values(), Contains(Key("time")));
    EXPECT_EQ(detail_of(id, where(equal("component_ref", "navigation"))).values(), detail.values());
    EXPECT_THAT(detail_of(id, where(equal("component_ref", "move"))).values(), IsEmpty());
    EXPECT_EQ(detail_of(id, where(like("text", "*failed*"))).values(), detail.values());
    EXPECT_THAT(detail_of(id, where(equal("colour", "red"))), IsRefused("BAD_PARAMETER", "colour"));
    EXPECT_THAT(detail_of(id, where(undefined_function("text"))), IsRefused("BAD_PARAMETER", "is_free"));
}

TEST_P(Errors, ReachSessionsThatHaveTheComponentBoundOrSubscribed) {
    Application witness{GetParam(), unwell()};
    witness.connect();
    EXPECT_THAT(witness.subscribe("reached_target"), IsOk());
    desk.execute(drive("drive"));
    EXPECT_EQ(witness.receive().name(), "receive_error");
    EXPECT_THAT(other.bind("reaction"), IsOk());
    other.execute({.component = "reaction", .type = "stop", .id = "fence"});
    EXPECT_EQ(other.status_of("fence"), "OK");
    EXPECT_THAT(lines(other.history()), Not(Contains("receive_error")));
}

TEST_P(Errors, AreTheStatusOfTheComponent) {
    auto const navigation = where(equal("component_ref", "navigation"));
    EXPECT_THAT(desk.query("component_status", navigation).values(), ElementsAre(Pair("status", ElementsAre("ERROR"))));
    EXPECT_THAT(other.query("component_status", navigation).values(), ElementsAre(Pair("status", ElementsAre("BUSY"))));
    EXPECT_THAT(desk.search(where(equal("status", "ERROR"))), ElementsAre("navigation", "system_information"));
}

TEST_P(Errors, AreReturnedByQueries) {
    EXPECT_THAT(desk.query("robot_position"), IsRefused("ERROR", "system_information"));
    EXPECT_THAT(desk.get_parameter("navigation"), IsOk()) << "the stored parameters, which the engine keeps";
}

TEST_P(Errors, OfAComponentThatDoesNotStartAreTimeouts) {
    desk.execute(unit(speak("Hello?", "speech")) + unit({.component = "speech_synthesis", .type = "stop", .id = "next"}));
    EXPECT_EQ(desk.status_of("next"), "ABORT");
    auto const error = desk.receive();
    EXPECT_THAT(lines(desk.history()), ElementsAre("completed speech TIMEOUT", "completed next ABORT", "receive_error"));
    EXPECT_EQ(error.text("error_type"), "COMPONENT_NOT_RESPONDING");
    EXPECT_EQ(error.ref(), "speech_synthesis");
    EXPECT_THAT(
        desk.get_command_result("speech").values(),
        UnorderedElementsAre(Pair("status", ElementsAre("TIMEOUT")),
                             Pair("reason", ElementsAre(testing::HasSubstr("did not start the command 'start' within 0.")))));
    EXPECT_THAT(detail_of(error.text("error_id")).values(), Contains(Pair("component_ref", ElementsAre("speech_synthesis"))));
}

struct OtherFaults : testing::TestWithParam<Transport> {
    GatewayProcess robot{{"--scenario", ROIS_SOURCE_DIR "/tests/server/data/complaining.xml", "--question-deadline", "0.2"}};
    Application desk{GetParam(), robot};

    OtherFaults() { desk.connect(); }
};
ROIS_OVER_BOTH_WAYS(OtherFaults);

TEST_P(OtherFaults, AQueryToASilentComponentReportsThatItDoesNotRespond) {
    EXPECT_THAT(desk.query("robot_position"), IsRefused("TIMEOUT", "within 0.2 s")) << "it is not bound yet";
    EXPECT_THAT(desk.bind("system_information"), IsOk());
    for (int i = 0; i < 3; ++i) EXPECT_THAT(desk.query("robot_position"), IsRefused("TIMEOUT", "within 0.2 s"));
    auto const error = desk.receive();
    EXPECT_EQ(error.text("error_type"), "COMPONENT_NOT_RESPONDING");
    EXPECT_EQ(error.ref(), "system_information");
    EXPECT_THAT(desk.bind("reaction"), IsOk());
    desk.execute({.component = "reaction", .type = "stop", .id = "fence"});
    EXPECT_EQ(desk.status_of("fence"), "OK");
    EXPECT_THAT(lines(desk.history()), ElementsAre("receive_error", "completed fence OK")) << "reported once";
}

TEST_P(OtherFaults, AComplainingComponentReportsItsOwnError) {
    EXPECT_THAT(desk.bind("move"), IsOk());
    auto const error = desk.receive();
    EXPECT_EQ(error.name(), "receive_error");
    EXPECT_EQ(error.text("error_type"), "USER_DEFINED_ERROR");
    EXPECT_EQ(error.ref(), "move");
}

}  // namespace
}  // namespace rois::test
