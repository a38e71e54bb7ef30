// Command unit sequences (7.4.3.1, decisions 10 to 15): all forms, their order, and rejected sequences.
#include <set>

#include "server/conversation.hpp"

namespace rois::test {
namespace {

using testing::Contains;
using testing::Not;

struct Sequences : Conversation {
    Sequences() {
        for (auto const* ref : {"speech_synthesis", "reaction", "navigation"}) EXPECT_THAT(desk.bind(ref), IsOk());
    }

    static Command bow(std::string const& id) {
        return {.component = "reaction", .id = id, .arguments = {{"reaction_ref", "RoISIdentifier", {"9"}}}};
    }
    // Completes at once.
    static Command halt(std::string const& id, std::string const& component = "navigation") {
        return {.component = component, .type = "stop", .id = id};
    }

    std::vector<std::string> played_until(std::string const& id) {
        desk.status_of(id);
        return lines(desk.history());
    }
    void refused(Xml const& units, std::string const& code, std::string const& path, std::string const& words) {
        auto const answer = desk.execute(units);
        EXPECT_THAT(answer, IsRefused(code, words));
        EXPECT_THAT(answer.reason(), testing::StartsWith(path + ": "));
    }
};
ROIS_OVER_BOTH_WAYS(Sequences);

TEST_P(Sequences, RunOneAfterTheOther) {
    EXPECT_THAT(desk.execute(unit(speak("One.", "1")) + unit(bow("2")) + unit(halt("3"))), IsOk());
    EXPECT_THAT(played_until("3"), ElementsAre("completed 1 OK", "completed 2 OK", "completed 3 OK"));
}

TEST_P(Sequences, AreEchoedWithEveryId) {
    auto const nested = side_by_side(one_after_another(unit(halt("")) + pause(1)) + unit(halt("")));
    auto const answer = desk.execute(unit(speak("One.", "mine")) +
                                     concurrent(branch({halt(""), halt("yours")}) + branch({halt("")})) + nested + pause(0));
    EXPECT_THAT(answer, IsOk());
    EXPECT_THAT(answer.children(), ElementsAre("rois:CommandUnitSequence"));
    auto const ids = command_ids(answer);
    ASSERT_EQ(ids.size(), 6u);
    EXPECT_EQ(ids[0], "mine");
    EXPECT_EQ(ids[2], "yours");
    EXPECT_EQ((std::set<std::string>{ids.begin(), ids.end()}).size(), 6u);
    EXPECT_THAT(ids, Not(Contains("")));
    std::vector<std::string> units;
    for (auto const unit : answer.root().first_child().children()) units.emplace_back(unit.attribute("xsi:type").value());
    EXPECT_THAT(units, ElementsAre("rois:CommandMessageType", "rois:ConcurrentCommandsType", "rois:ParallelCommandUnitType",
                                   testing::AnyOf("", "rois:CommandBaseType")));
    for (std::size_t i = 0; i < ids.size(); ++i) EXPECT_EQ(desk.hear().text("status"), "OK");
    std::multiset<std::string> completed;
    for (auto const& one : desk.history()) completed.insert(one.text("command_id"));
    EXPECT_EQ(completed, (std::multiset<std::string>{ids.begin(), ids.end()}));
}

TEST_P(Sequences, AreEchoedWithTheirCommands) {
    auto const answer = desk.execute(speak("Welcome.", "greet"));
    auto const echoed = answer.root().first_child().first_child();
    EXPECT_STREQ(echoed.attribute("rois:command_type").value(), "start");
    EXPECT_STREQ(echoed.child("rois:component_ref").attribute("rois:code").value(), "speech_synthesis");
    auto const argument = echoed.child("rois:arguments").child("rois:parameter");
    EXPECT_STREQ(argument.attribute("rois:name").value(), "speech_text");
    EXPECT_STREQ(argument.child("rois:value").text().get(), "Welcome.");
}

TEST_P(Sequences, BranchesRunSideBySideAndTheNextUnitWaitsForAll) {
    desk.execute(
        concurrent(branch({speak_long("speech"), halt("never")}) + branch({bow("bow"), halt("stop", "speech_synthesis")})) +
        unit(halt("after")));
    EXPECT_THAT(played_until("after"), ElementsAre("completed bow OK", "completed speech ABORT", "completed never ABORT",
                                                   "completed stop OK", "completed after ABORT"))
        << "a branch that fails lets the others run on; then the unit has failed";
}

TEST_P(Sequences, EachOfAFlatCommandListIsABranch) {
    desk.execute(concurrent(command_list(speak_long("speech")) + command_list(bow("bow")) +
                            command_list({.component = "navigation", .type = "stop", .id = "late", .delay = 300})));
    EXPECT_THAT(played_until("late"), ElementsAre("completed bow OK", "completed late OK"));
    EXPECT_EQ(desk.get_command_result("speech").values()["status"].at(0), "RUNNING");
}

TEST_P(Sequences, NestAsInTheSeed) {
    desk.execute(
        side_by_side(one_after_another(unit(speak("One.", "1")) + side_by_side(unit(bow("2")) + pause(400)) + unit(halt("3"))) +
                     unit(halt("beside"))) +
        unit(halt("after")));
    EXPECT_THAT(played_until("after"),
                ElementsAre("completed beside OK", "completed 1 OK", "completed 2 OK", "completed 3 OK", "completed after OK"));
}

TEST_P(Sequences, AUnitWithoutATypeOnlyDelays) {
    desk.execute(side_by_side(one_after_another(pause(50) + unit(halt("delayed"))) + unit(halt("at-once"))));
    EXPECT_THAT(played_until("delayed"), ElementsAre("completed at-once OK", "completed delayed OK"));
}

TEST_P(Sequences, WithoutACommandMessageAreRefused) {
    EXPECT_THAT(desk.execute(pause(50)), IsRefused("BAD_PARAMETER", "there is no command message in the command_unit_list"));
    refused(unit(halt("halt")) + one_after_another(pause(50) + pause(0)), "BAD_PARAMETER", "command_unit_list[2]",
            "no command message");
}

TEST_P(Sequences, DelayTimeOfACommandCountsFromItsTurn) {
    Command const delayed{.component = "navigation", .type = "stop", .id = "delayed", .delay = 50};
    desk.execute(side_by_side(one_after_another(unit(delayed) + unit(halt("next"))) + unit(halt("at-once"))));
    EXPECT_THAT(played_until("next"), ElementsAre("completed at-once OK", "completed delayed OK", "completed next OK"));
}

TEST_P(Sequences, EndWithACommandThatFails) {
    desk.execute(unit({.component = "navigation", .type = "resume", .id = "wrong"}) + unit(bow("never")));
    EXPECT_THAT(played_until("never"), ElementsAre("completed wrong ERROR", "completed never ABORT"));
}

TEST_P(Sequences, ABadUnitIsNamedByItsPath) {
    auto const good = unit(halt(""));
    Command const unknown{.component = "dishwasher"};
    Command const unbound{.component = "move", .type = "stop"};
    refused(unit(unknown), "BAD_PARAMETER", "command_unit_list[1]", "dishwasher");
    refused(good + unit(unbound), "ERROR", "command_unit_list[2]", "not bound");
    refused(good + concurrent(branch({halt("")}) + branch({halt(""), unbound})), "ERROR",
            "command_unit_list[2]/branch_list[2]/command_list[2]", "not bound");
    refused(concurrent(command_list(halt("")) + command_list(unknown)), "BAD_PARAMETER", "command_unit_list[1]/command_list[2]",
            "dishwasher");
    refused(side_by_side(good + one_after_another(good + unit(unknown))), "BAD_PARAMETER",
            "command_unit_list[1]/command_unit_list[2]/command_unit_list[2]", "dishwasher");
    refused(unit(unbound) + unit(unknown), "ERROR", "command_unit_list[1]", "not bound");
}

TEST_P(Sequences, RefuseInvalidCommands) {
    auto const path = "command_unit_list[1]";
    refused(unit({.component = "navigation", .type = "dance"}), "BAD_PARAMETER", path, "dance");
    refused(unit({.component = "navigation", .arguments = {{"colour", "string", {"red"}}}}), "BAD_PARAMETER", path, "colour");
    refused(unit({.component = "navigation", .arguments = {target_position({"desk"}), time_limit("soon")}}), "BAD_PARAMETER",
            path, "time_limit");
    refused(unit({.component = "navigation", .arguments = {target_position({"nowhere"})}}), "BAD_PARAMETER", path, "nowhere");
    desk.bind("follow");
    refused(unit({.component = "follow"}), "BAD_PARAMETER", path, "target_object_ref");
    refused(unit({.component = "navigation", .type = "stop", .delay = -1}), "BAD_PARAMETER", path, "delay_time");
    refused(pause(-5), "BAD_PARAMETER", path, "delay_time");
}

TEST_P(Sequences, AnIdIsThereOnce) {
    refused(unit(halt("a")) + unit(halt("a")), "BAD_PARAMETER", "command_unit_list[2]", "twice");
    desk.execute(halt("b"));
    refused(unit(halt("b")), "BAD_PARAMETER", "command_unit_list[1]", "in use");
    EXPECT_THAT(desk.execute(halt("a")), IsOk()) << "a refused sequence leaves no name";
}

TEST_P(Sequences, OfMoreCommandsThanASessionMayHave) {
    Xml many = pause(600'000);
    for (int i = 0; i < 1'000; ++i) many += unit(halt(""));
    EXPECT_THAT(desk.execute(many), IsOk());
    EXPECT_THAT(desk.execute(many), IsRefused("OUT_OF_RESOURCES", "1024"));
    EXPECT_THAT(desk.execute(halt("one more")), IsOk());
}

TEST_P(Sequences, ARefusedSequenceRunsNothing) {
    desk.execute(unit(halt("first")) + unit({.component = "dishwasher"}));
    EXPECT_THAT(desk.get_command_result("first"), IsRefused("BAD_PARAMETER", "first"));
    desk.execute(halt("fence"));
    EXPECT_THAT(played_until("fence"), ElementsAre("completed fence OK"));
}

}  // namespace
}  // namespace rois::test
