// Operations over HTTP and over WebSocket, beyond the checks of rois-conformance: reasons, limits, and data that is forgotten.
#include <chrono>

#include "server/conversation.hpp"

namespace rois::test {
namespace {

using testing::Contains;
using testing::Pair;

struct Operations : Conversation {
    static Command of(std::string const& component, std::string const& type, std::string const& id = "") {
        return {.component = component, .type = type, .id = id};
    }
};
ROIS_OVER_BOTH_WAYS(Operations);

TEST_P(Operations, ParametersEndWithTheirBinding) {
    Application rival{GetParam(), empty_hall()};
    rival.connect();
    auto const defaults = desk.query("get_parameter", where(equal("name", "speech_synthesis"))).values();
    EXPECT_EQ(defaults.count("speech_text"), 0u);
    for (auto const* end : {"release", "disconnect"}) {
        for (auto const* ref : {"speech_synthesis", "navigation", "reaction", "follow", "move"}) desk.bind(ref);
        desk.set_parameter("speech_synthesis", {speech_text("a secret"), {"volume", "int", {"7"}}});
        desk.set_parameter("navigation", {target_position({"desk"})});
        desk.set_parameter("move", {{"line", "int[]", {"1000 0"}}});
        desk.set_parameter("reaction", {{"reaction_ref", "RoISIdentifier", {"1"}}});
        EXPECT_THAT(desk.query("get_parameter", where(equal("name", "speech_synthesis"))).values(),
                    Contains(Pair("speech_text", ElementsAre("a secret"))));
        EXPECT_EQ(rival.query("get_parameter", where(equal("name", "speech_synthesis"))).values(), defaults);
        EXPECT_THAT(rival.search(where(equal("Property/speech_text", "a secret"))), IsEmpty());
        if (std::string{end} == "disconnect") {
            desk.disconnect();
            desk.connect();
        } else {
            for (auto const* ref : {"speech_synthesis", "navigation", "reaction", "follow", "move"}) desk.release(ref);
        }
        for (auto const* ref : {"speech_synthesis", "navigation", "reaction", "follow", "move"}) {
            rival.bind(ref);
            EXPECT_THAT(rival.execute(Command{.component = ref}), IsRefused("BAD_PARAMETER", "command_unit_list[1]")) << ref;
            rival.release(ref);
        }
        EXPECT_EQ(desk.query("get_parameter", where(equal("name", "speech_synthesis"))).values(), defaults) << end;
    }
}

TEST_P(Operations, CommandsHaveAReasonUnlessTheyAreOk) {
    desk.bind("speech_synthesis");
    auto const why = [&](std::string const& id) { return desk.get_command_result(id).values()["reason"].at(0); };
    desk.execute(unit(speak_long("now")) + unit(speak("Later.", "later")));
    desk.execute(of("speech_synthesis", "stop", "stop"));
    desk.status_of("stop");
    EXPECT_EQ(why("now"), "it was stopped");
    EXPECT_EQ(why("later"), "the command 'now' of its sequence ended with ABORT");
    desk.execute(of("speech_synthesis", "resume", "on"));
    EXPECT_EQ(desk.status_of("on"), "ERROR");
    EXPECT_EQ(why("on"), "nothing is suspended");
    EXPECT_THAT(desk.get_command_result("on", where(equal("reason", "another"))).values(), IsEmpty());
    EXPECT_THAT(desk.get_command_result("stop").values(), ElementsAre(Pair("status", ElementsAre("OK"))));
}

TEST_P(Operations, CommandResultsAgeOut) {
    GatewayProcess forgetful{{"--max-command-results", "1"}};
    Application application{GetParam(), forgetful};
    application.connect();
    application.bind("navigation");
    auto const first = application.set_parameter("navigation", {time_limit("1")}).text("command_id");
    auto const second = application.set_parameter("navigation", {time_limit("2")}).text("command_id");
    EXPECT_THAT(application.get_command_result(first), IsRefused("BAD_PARAMETER", "expired"));
    EXPECT_THAT(application.get_command_result(second), IsOk());
}

TEST_P(Operations, EventDetailsExpire) {
    GatewayProcess forgetful{{"--event-details", "0.1"}};
    Application application{GetParam(), forgetful};
    application.connect();
    application.bind("person_detection");
    application.subscribe("person_detected");
    application.execute(Command{.component = "person_detection"});
    auto const id = application.next_event("person_detected").text("event_id");
    auto answer = application.get_event_detail(id);
    auto const until = std::chrono::steady_clock::now() + std::chrono::seconds{10};  // the default is 60 s
    while (answer.return_code() == "OK" && std::chrono::steady_clock::now() < until) answer = application.get_event_detail(id);
    EXPECT_THAT(answer, IsRefused("BAD_PARAMETER", "expired"));
}

TEST_P(Operations, CommandsOfASessionAreLimited) {
    desk.bind("navigation");
    Xml many = pause(600'000);
    for (int i = 0; i < 1'000; ++i) many += unit(of("navigation", "stop"));
    EXPECT_THAT(desk.execute(many), IsOk());
    EXPECT_THAT(desk.execute(many), IsRefused("OUT_OF_RESOURCES", "1024"));
    EXPECT_THAT(desk.execute(of("navigation", "stop", "one more")), IsOk());
}

}  // namespace
}  // namespace rois::test
