// How commands end: execute, the five completed statuses (table 8, decisions 8, 9, 12), and get_command_result.
#include "server/conversation.hpp"

namespace rois::test {
namespace {

using testing::Pair;
using testing::UnorderedElementsAre;

struct Completion : Conversation {
    Completion() {
        for (auto const* ref : {"speech_synthesis", "navigation", "move"}) EXPECT_THAT(desk.bind(ref), IsOk());
    }

    // Drives back and forth until the test ends.
    static Command drive(std::string const& id) {
        return {.component = "navigation", .id = id, .arguments = {target_position(std::vector<std::string>(50, "desk"))}};
    }
    static Command of(std::string const& component, std::string const& type, std::string const& id) {
        return {.component = component, .type = type, .id = id};
    }
    std::vector<std::string> heard() { return lines(desk.history()); }
    std::string status_now(std::string const& id) { return desk.get_command_result(id).values()["status"].at(0); }
};
ROIS_OVER_BOTH_WAYS(Completion);

TEST_P(Completion, OkAtTheEndOfAnAction) {
    EXPECT_THAT(desk.execute(speak("Welcome.", "greet")), IsOk());
    auto const completed = desk.hear();
    EXPECT_EQ(completed.name(), "completed");
    EXPECT_THAT(completed.children(), ElementsAre("command_id", "status"));
    EXPECT_EQ(completed.text("command_id"), "greet");
    EXPECT_EQ(completed.text("status"), "OK");
}

TEST_P(Completion, OfNavigationComesAfterItsTargets) {
    desk.subscribe("reached_target", "", true);
    desk.execute(
        {.component = "navigation", .id = "go", .arguments = {target_position({"7000, 5000", "start"}), time_limit("0")}});
    EXPECT_EQ(desk.status_of("go"), "OK");
    EXPECT_THAT(heard(), ElementsAre("reached_target", "reached_target", "completed go OK"));
    EXPECT_THAT(desk.history()[0].values(),
                ElementsAre(Pair("is_final_target", ElementsAre("false")), Pair("target", ElementsAre("7000, 5000"))));
    EXPECT_THAT(desk.history()[1].values(),
                ElementsAre(Pair("is_final_target", ElementsAre("true")), Pair("target", ElementsAre("start"))));
}

TEST_P(Completion, ErrorInAWrongState) {
    desk.execute(of("speech_synthesis", "resume", "resume"));
    EXPECT_EQ(desk.status_of("resume"), "ERROR") << "nothing is suspended";
    desk.execute(of("speech_synthesis", "suspend", "suspend"));
    EXPECT_EQ(desk.status_of("suspend"), "ERROR") << "nothing runs";
}

TEST_P(Completion, SuspendHoldsAndResumeGoesOn) {
    desk.execute(speak("Good day.", "speech"));
    desk.execute(of("speech_synthesis", "suspend", "suspend"));
    desk.execute(of("speech_synthesis", "suspend", "again"));
    EXPECT_EQ(desk.status_of("again"), "ERROR");
    EXPECT_EQ(status_now("speech"), "RUNNING");
    desk.execute(of("speech_synthesis", "resume", "resume"));
    EXPECT_EQ(desk.status_of("speech"), "OK");
    EXPECT_THAT(heard(),
                ElementsAre("completed suspend OK", "completed again ERROR", "completed resume OK", "completed speech OK"));
}

TEST_P(Completion, AbortByStop) {
    desk.execute(speak_long("speech"));
    desk.execute(of("speech_synthesis", "stop", "stop"));
    EXPECT_EQ(desk.status_of("stop"), "OK");
    EXPECT_THAT(heard(), ElementsAre("completed speech ABORT", "completed stop OK"));
    desk.execute(of("speech_synthesis", "stop", "idle"));
    EXPECT_EQ(desk.status_of("idle"), "OK") << "when idle";
}

TEST_P(Completion, AbortByANewStart) {
    desk.execute(speak_long("long"));
    desk.execute(speak("Well.", "short"));
    EXPECT_EQ(desk.status_of("short"), "OK");
    EXPECT_THAT(heard(), ElementsAre("completed long ABORT", "completed short OK"));
}

TEST_P(Completion, AbortByRelease) {
    desk.execute(unit(speak_long("speech")) + unit(of("move", "stop", "next")));
    EXPECT_THAT(desk.release("speech_synthesis"), IsOk());
    EXPECT_EQ(desk.status_of("next"), "ABORT");
    EXPECT_THAT(heard(), ElementsAre("completed speech ABORT", "completed next ABORT"));
}

TEST_P(Completion, OutOfResourcesWhileAnotherComponentDrives) {
    desk.execute({.component = "move", .id = "move", .arguments = {{"line", "int[]", {"1000 0"}}, {"time", "int", {"600000"}}}});
    desk.execute(drive("drive"));
    EXPECT_EQ(desk.status_of("drive"), "OUT_OF_RESOURCES");
    EXPECT_EQ(status_now("move"), "RUNNING");
}

TEST_P(Completion, TimeoutAfterTheTimeLimit) {
    desk.execute({.component = "navigation", .id = "go", .arguments = {target_position({"meeting_room"}), time_limit("500")}});
    EXPECT_EQ(desk.status_of("go"), "TIMEOUT");
    EXPECT_EQ(status_now("go"), "TIMEOUT");
}

TEST_P(Completion, ErrorIfTheTargetCannotBeReached) {
    desk.execute({.component = "navigation", .id = "go", .arguments = {target_position({"90000, 90000"})}});
    EXPECT_EQ(desk.status_of("go"), "ERROR");
    EXPECT_THAT(
        desk.get_command_result("go").values(),
        UnorderedElementsAre(Pair("status", ElementsAre("ERROR")),
                             Pair("reason", ElementsAre("'90000, 90000' is outside of the hall, in a wall or in furniture"))));
}

TEST_P(Completion, HasAReasonUnlessItIsOk) {
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

TEST_P(Completion, ResultsWhileItWaitsAndRunsAndAfterwards) {
    desk.execute(unit(speak_long("now")) + unit(speak("Later.", "later")));
    auto const answer = desk.get_command_result("now");
    EXPECT_THAT(answer, IsOk());
    EXPECT_THAT(answer.children(), ElementsAre("results"));
    EXPECT_THAT(answer.values(), ElementsAre(Pair("status", ElementsAre("RUNNING"))));
    EXPECT_THAT(desk.get_command_result("later").values(), ElementsAre(Pair("status", ElementsAre("WAITING"))));
    desk.execute(of("speech_synthesis", "stop", "stop"));
    desk.status_of("stop");
    EXPECT_EQ(status_now("now"), "ABORT");
    EXPECT_EQ(status_now("later"), "ABORT");
    EXPECT_EQ(status_now("stop"), "OK");
}

TEST_P(Completion, AConditionChoosesAmongTheResults) {
    auto const id = desk.set_parameter("navigation", {time_limit("0")}).text("command_id");
    EXPECT_THAT(desk.get_command_result(id, where(equal("status", "OK"))).values(),
                ElementsAre(Pair("status", ElementsAre("OK"))));
    auto const none = desk.get_command_result(id, where(literal_first("ABORT", "status")));
    EXPECT_THAT(none, IsOk());
    EXPECT_THAT(none.values(), IsEmpty());
    EXPECT_THAT(desk.get_command_result(id, where(equal("colour", "red"))), IsRefused("BAD_PARAMETER", "colour"));
    EXPECT_THAT(desk.get_command_result(id, where(undefined_function("status"))), IsRefused("BAD_PARAMETER", "is_free"));
}

TEST_P(Completion, ResultsOfAnUnknownOrAnothersCommand) {
    EXPECT_THAT(desk.get_command_result("nobody"), IsRefused("BAD_PARAMETER", "nobody"));
    desk.execute(speak("Hello.", "mine"));
    Application rival{GetParam(), empty_hall()};
    rival.connect();
    EXPECT_THAT(rival.get_command_result("mine"), IsRefused("BAD_PARAMETER", "mine"));
}

TEST_P(Completion, ResultsThatHaveAgedOut) {
    GatewayProcess forgetful{{"--max-command-results", "1"}};
    Application application{GetParam(), forgetful};
    application.connect();
    application.bind("navigation");
    auto const first = application.set_parameter("navigation", {time_limit("1")}).text("command_id");
    auto const second = application.set_parameter("navigation", {time_limit("2")}).text("command_id");
    EXPECT_THAT(application.get_command_result(first), IsRefused("BAD_PARAMETER", "expired"));
    EXPECT_THAT(application.get_command_result(second), IsOk());
}

}  // namespace
}  // namespace rois::test
