// Decisions 10 to 15: command unit sequences are checked as a whole, and run in order.
#include "engine/world.hpp"

namespace rois {

namespace {

struct Sequence : testing::Test {
    World world{navigation, speech, detection};
    Application desk = world.connect();
    ScriptedComponent& robot = world["navigation"];
    ScriptedComponent& voice = world["speech"];

    Sequence() {
        for (auto const* ref : {"navigation", "speech", "detection"}) desk.bind(ref);
    }

    // The path of the first bad unit.
    template <class... Units>
    std::string bad_unit(Units... units) {
        auto const reply = desk.execute(std::move(units)...);
        EXPECT_NE(reply.return_code, ReturnCode::ok);
        return reply.reason.substr(0, reply.reason.find(": "));
    }
};

CommandUnit bad() { return start("gripper"); }

}  // namespace

// --- The check before anything runs (decision 10) ---

TEST_F(Sequence, NamesTheFirstBadUnitByItsPath) {
    EXPECT_EQ(bad_unit(bad()), "command_unit_list[1]");
    EXPECT_EQ(bad_unit(go("a"), bad(), bad()), "command_unit_list[2]");
    EXPECT_EQ(bad_unit(go("a"), branches({{go("b"), bad()}, {bad()}})), "command_unit_list[2]/branch_list[1]/command_list[2]");
    EXPECT_EQ(bad_unit(branches({{go("b")}, {bad()}})), "command_unit_list[1]/branch_list[2]/command_list[1]");
    EXPECT_EQ(bad_unit(flat({go("b"), bad()})), "command_unit_list[1]/command_list[2]");
    EXPECT_EQ(bad_unit(in_sequence({go("a"), in_parallel({go("b"), in_sequence({bad()})})})),
              "command_unit_list[1]/command_unit_list[2]/command_unit_list[2]/command_unit_list[1]");
    EXPECT_EQ(bad_unit(go("a"), after(-1ms, go("b"))), "command_unit_list[2]");
    EXPECT_EQ(bad_unit(go("a"), pause(-5ms)), "command_unit_list[2]");
}

TEST_F(Sequence, WithAnInvalidDelayIsRefused) {
    EXPECT_THAT(desk.execute(after(-1ms, go("a"))).reason, HasSubstr("delay_time must be 0 to 86400000 milliseconds"));
    EXPECT_EQ(desk.execute(after(24h + 1ms, go("a"))).return_code, ReturnCode::bad_parameter);
    EXPECT_EQ(desk.execute(after(24h, go("a"))).return_code, ReturnCode::ok);
}

TEST_F(Sequence, WithoutUnitsIsRefused) {
    EXPECT_EQ(desk.execute().reason, "there is no command_unit_list");
    EXPECT_EQ(bad_unit(in_sequence({})), "command_unit_list[1]");
    EXPECT_EQ(bad_unit(in_parallel({})), "command_unit_list[1]");
    EXPECT_EQ(bad_unit(branches({})), "command_unit_list[1]");
    EXPECT_EQ(bad_unit(branches({{go("a")}, {}})), "command_unit_list[1]/branch_list[2]");
    ConcurrentCommands hollow{ConcurrentCommands::Form::command_list, {Branch{}}};
    EXPECT_EQ(bad_unit(CommandUnit{{}, hollow}), "command_unit_list[1]/branch_list[1]");
}

// --- Ids (decision 11) ---

TEST_F(Sequence, FillsInNoIdThatTheApplicationGives) {
    auto const ids = ids_of(desk.execute(go(""), say("c-1"), say("c-2")).command_unit_list.command_unit_list);
    EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), 3U);
}

TEST_F(Sequence, WithADuplicateCommandIdIsRefused) {
    EXPECT_THAT(desk.execute(go("a"), in_sequence({say("b"), say("a")})).reason,
                "command_unit_list[2]/command_unit_list[2]: the command_id 'a' is given twice");
    desk.execute(go("a"));
    EXPECT_THAT(desk.execute(say("a")).reason, HasSubstr("is in use in this session"));
    robot.finishes();
    EXPECT_THAT(desk.execute(say("a")).return_code, ReturnCode::bad_parameter) << "its results are still known";
    auto hall = world.connect();
    desk.release("navigation");
    hall.bind("navigation");
    EXPECT_EQ(hall.execute(go("a")).return_code, ReturnCode::ok) << "each session has its own command_ids";
}

// --- The order of things (decisions 13, 14) ---

TEST_F(Sequence, EndsWithTheFirstCommandThatIsNotOk) {
    desk.execute(go("go"), in_parallel({say("a"), in_sequence({go("b"), pause(1s)})}), go("c"));
    robot.finishes(CompletedStatus::error);
    EXPECT_THAT(desk.received(),
                ElementsAre("1 completed go ERROR", "2 completed a ABORT", "3 completed b ABORT", "4 completed c ABORT"));
    world.advance(10s);
    EXPECT_THAT(desk.received(), IsEmpty());
}

TEST_F(Sequence, FailsUpwardsThroughEveryLevel) {
    desk.execute(in_parallel({in_sequence({in_parallel({go("go")}), say("a")}), in_sequence({pause(1s), say("b")})}), say("c"));
    robot.finishes(CompletedStatus::error);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go ERROR", "2 completed a ABORT"));
    world.advance(1s);
    voice.finishes();
    EXPECT_THAT(desk.received(), ElementsAre("3 completed b OK", "4 completed c ABORT"));
}

TEST_F(Sequence, EndsWhereItsBindingIsLost) {
    auto hall = world.connect();
    desk.execute(go("go"), say("say"), go("back"));
    desk.release("speech");
    hall.bind("speech");
    robot.finishes();
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go OK", "2 completed say ABORT", "3 completed back ABORT"));
    EXPECT_THAT(voice.calls, ElementsAre("halt"));
}

TEST_F(Sequence, EndsWhenItsStartIsReplaced) {
    desk.execute(go("go"), say("say"));
    desk.execute(go("elsewhere"));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go ABORT", "2 completed say ABORT"));
}

TEST_F(Sequence, MayBeStoppedFromItsOwnParallelBranch) {
    desk.execute(in_parallel({go("go"), in_sequence({pause(1s), named("stop", stop("navigation"))})}), say("say"));
    world.advance(1s);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go ABORT", "2 completed stop OK", "3 completed say ABORT"));
}

TEST_F(Sequence, OfAThousandCommandsRunsThrough) {
    std::vector<CommandUnit> many;
    for (int i = 0; i < 1'000; ++i) many.push_back(stop("navigation"));
    desk.execute(in_sequence(many), go("go"));
    EXPECT_EQ(desk.received().size(), 1'000U);
    EXPECT_EQ(desk.result_of("go"), "RUNNING");
}

// --- Delays (decision 15) ---

TEST_F(Sequence, DelaysUnitsAndTheCommandsInsideThem) {
    desk.execute(after(100ms, branches({{after(100ms, go("go"))}, {say("say")}})));
    world.advance(50ms);
    EXPECT_EQ(desk.result_of("say"), "WAITING");
    world.advance(50ms);
    EXPECT_EQ(desk.result_of("say"), "RUNNING");
    EXPECT_EQ(desk.result_of("go"), "WAITING");
    world.advance(100ms);
    EXPECT_EQ(desk.result_of("go"), "RUNNING");
}

TEST_F(Sequence, MayHaveUnitsThatOnlyDelay) {
    desk.execute(pause(200ms), pause(0ms), CommandUnit{}, go("go"), pause(200ms));
    world.advance(150ms);
    EXPECT_EQ(desk.result_of("go"), "WAITING");
    world.advance(50ms);
    EXPECT_EQ(desk.result_of("go"), "RUNNING");
}

// Tables 10 and 13: a list of units holds at least one command message.
TEST_F(Sequence, ThatOnlyDelaysIsRefused) {
    auto const reason = [&](auto... units) {
        auto const reply = desk.execute(std::move(units)...);
        return reply.return_code == ReturnCode::bad_parameter ? reply.reason : std::string{to_text(reply.return_code)};
    };
    std::string const none = "there is no command message in the command_unit_list, only delays; at least one is expected";
    EXPECT_EQ(reason(pause(1s)), none);
    EXPECT_EQ(reason(pause(1s), CommandUnit{}), none);
    EXPECT_EQ(reason(go("go"), in_sequence({pause(1s)})), "command_unit_list[2]: " + none);
    EXPECT_EQ(reason(go("go"), in_parallel({say("say"), in_parallel({pause(1s), pause(2s)})})),
              "command_unit_list[2]/command_unit_list[2]: " + none);
    EXPECT_EQ(reason(in_parallel({say("say"), pause(1s)})), "OK") << "a branch may only delay, beside one that does not";
    EXPECT_EQ(desk.result_of("go"), "BAD_PARAMETER") << "no command of a refused sequence ran";
}

TEST_F(Sequence, ThatHasFailedDoesNotWakeAfterItsDelay) {
    desk.execute(in_parallel({go("go"), after(1s, say("say"))}));
    desk.leave();
    world.advance(2s);
    EXPECT_THAT(voice.calls, ElementsAre("halt"));
}

// The number of live commands of a session is limited.
TEST(LiveCommands, OfASessionAreLimited) {
    EngineSettings settings;
    settings.max_waiting_notifications = 3;
    World world{{speech}, settings};
    auto desk = world.connect();
    desk.bind("speech");
    EXPECT_EQ(desk.execute(say("1"), say("2")).return_code, ReturnCode::ok);
    auto const refused = desk.execute(say("3"), say("4"));
    EXPECT_EQ(refused.return_code, ReturnCode::out_of_resources);
    EXPECT_THAT(refused.reason, testing::HasSubstr("3 commands"));
    EXPECT_EQ(desk.result_of("3"), "BAD_PARAMETER");
    world["speech"].finishes();
    EXPECT_EQ(desk.execute(say("3"), say("4")).return_code, ReturnCode::ok);
}

}  // namespace rois
