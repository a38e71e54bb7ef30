// Components that answer later, never or twice (decision 36).
#include "engine/asynchronous.hpp"

namespace rois {

// --- Queries ---

TEST_F(Asynchronous, AQueryIsAnsweredWhenItsComponentAnswers) {
    auto& robot = add(named("robot", navigation));
    auto desk = world.connect();
    auto const asked = query(desk);
    EXPECT_FALSE(asked->said);
    world.advance(900ms);
    EXPECT_FALSE(asked->said);
    EXPECT_EQ(desk.status_of("speech"), "READY") << "other components answer meanwhile";
    robot.answer_query("2.5");
    work();
    EXPECT_EQ(in_words(std::get<Query::Reply>(std::get<Reply>(asked->said.value())).results.parameters), "length=2.5");
}

TEST_F(Asynchronous, AQueryWithoutAnAnswerTimesOutAfterTheDeadline) {
    auto& robot = add(named("robot", navigation));
    auto desk = world.connect();
    desk.bind("robot");
    auto const asked = query(desk);
    world.advance(950ms);
    EXPECT_FALSE(asked->said);
    world.advance(50ms);
    EXPECT_EQ(code_of(*asked), ReturnCode::timeout);
    EXPECT_THAT(reason_of(*asked), HasSubstr("within 1 s"));
    EXPECT_THAT(desk.received(), ElementsAre("1 COMPONENT_NOT_RESPONDING robot"));
    EXPECT_EQ(desk.status_of("robot"), "ERROR");
    auto const again = query(desk);
    world.advance(1s);
    EXPECT_EQ(code_of(*again), ReturnCode::timeout);
    EXPECT_THAT(desk.received(), IsEmpty()) << "reported once";
    auto const strays = world.stray_answers();
    robot.answer_query("2.5");
    work();
    EXPECT_EQ(world.stray_answers(), strays + 1) << "too late";
    EXPECT_EQ(desk.status_of("robot"), "READY") << "it responds again";
}

TEST_F(Asynchronous, ASecondAnswerIsIgnored) {
    auto& robot = add(named("robot", navigation));
    auto desk = world.connect();
    auto const asked = query(desk);
    auto const ticket = robot.questions.front().ticket;
    robot.answer_query("2.5");
    robot.port().answered(ticket, std::vector<Results>{});
    robot.port().answered(Ticket{12'345}, Done{});
    work();
    EXPECT_EQ(code_of(*asked), ReturnCode::ok);
    EXPECT_EQ(world.stray_answers(), 2U);
}

TEST_F(Asynchronous, AnAnswerOfTheWrongKindIsAnError) {
    auto& robot = add(named("robot", navigation));
    auto desk = world.connect();
    auto const asked = query(desk);
    robot.answer("query", Done{});
    work();
    EXPECT_EQ(code_of(*asked), ReturnCode::error);
}

TEST_F(Asynchronous, AQueryAsksTheNextComponentIfTheFirstIsSlowOrFails) {
    auto& first = add(named("robot_a", navigation));
    auto& second = add(named("robot_b", navigation));
    auto desk = world.connect();
    auto const slow = query(desk);
    EXPECT_EQ(first.questions.size(), 1U);
    EXPECT_TRUE(second.questions.empty());
    world.advance(500ms);
    EXPECT_EQ(second.questions.size(), 1U) << "after half of the time";
    second.answer_query("2.5");
    work();
    EXPECT_EQ(std::get<Query::Reply>(std::get<Reply>(slow->said.value())).component_ref.code, "robot_b");
    first.questions.clear();
    first.port().changed({.status = ComponentStatus::ready, .location = {}, .parameters = {}});
    work();
    auto const failed = query(desk);
    first.answer("query", Failed{"no link"});
    work();
    EXPECT_FALSE(failed->said);
    second.answer_query("2.5");
    work();
    EXPECT_EQ(code_of(*failed), ReturnCode::ok);
}

TEST_F(Asynchronous, AConditionOnResultsAsksAllCandidatesAtOnce) {
    auto& first = add(named("robot_a", navigation));
    auto& second = add(named("robot_b", navigation));
    auto desk = world.connect();
    auto const asked = query(desk, equal("length", "2.5"));
    EXPECT_EQ(first.questions.size(), 1U);
    EXPECT_EQ(second.questions.size(), 1U);
    second.answer_query("2.5");
    work();
    EXPECT_FALSE(asked->said) << "the first one may match, too";
    first.answer_query("1.5");
    work();
    EXPECT_EQ(std::get<Query::Reply>(std::get<Reply>(asked->said.value())).component_ref.code, "robot_b");
}

TEST_F(Asynchronous, ASlowCandidateIsSkippedAtTheDeadline) {
    add(named("robot_a", navigation));
    auto& second = add(named("robot_b", navigation));
    auto desk = world.connect();
    auto const asked = query(desk, equal("length", "2.5"));
    second.answer_query("2.5");
    world.advance(1s);
    EXPECT_EQ(std::get<Query::Reply>(std::get<Reply>(asked->said.value())).component_ref.code, "robot_b");
}

TEST_F(Asynchronous, AQueryOfASessionThatEndsIsRefused) {
    auto& robot = add(named("robot", navigation));
    auto desk = world.connect();
    auto const asked = query(desk);
    world.engine->end(desk.session, world.now);
    robot.answer_query("2.5");
    work();
    EXPECT_EQ(std::get<Refusal>(asked->said.value()), Refusal::no_session);
}

TEST_F(Asynchronous, AComponentThatLeavesFailsItsQueries) {
    add(named("robot", navigation));
    auto desk = world.connect();
    auto const asked = query(desk);
    world.engine->change(leaving("robot"), world.now);
    EXPECT_EQ(code_of(*asked), ReturnCode::error);
}

// --- Binding ---

TEST_F(Asynchronous, ABindingMayHaveToBeConfirmed) {
    auto& robot = add(confirming(named("robot", navigation)));
    auto desk = world.connect();
    auto const bound = begin(desk, Bind{Application::identifier("robot")}, world);
    EXPECT_FALSE(bound->said);
    robot.answer("bind", Done{});
    work();
    EXPECT_EQ(code_of(*bound), ReturnCode::ok);
    auto other = world.connect();
    EXPECT_EQ(other.bind("robot"), ReturnCode::out_of_resources) << "known without asking";
}

TEST_F(Asynchronous, ABindingThatIsNotConfirmedIsNoBinding) {
    auto& robot = add(confirming(named("robot", navigation)));
    auto desk = world.connect();
    auto const late = begin(desk, Bind{Application::identifier("robot")}, world);
    world.advance(1s);
    EXPECT_EQ(code_of(*late), ReturnCode::timeout);
    robot.questions.clear();
    auto const refused = begin(desk, Bind{Application::identifier("robot")}, world);
    robot.answer("bind", Refused{"it is bound elsewhere"});
    work();
    EXPECT_EQ(code_of(*refused), ReturnCode::out_of_resources);
    EXPECT_EQ(reason_of(*refused), "it is bound elsewhere");
    auto const failed = begin(desk, Bind{Application::identifier("robot")}, world);
    robot.answer("bind", Failed{"no link"});
    work();
    EXPECT_EQ(code_of(*failed), ReturnCode::error);
    EXPECT_EQ(desk.get_parameter("robot").return_code, ReturnCode::error) << "it is not bound";
}

TEST_F(Asynchronous, OnlyOneOfTwoSessionsThatBindAtOnceGetsTheComponent) {
    auto& robot = add(confirming(named("robot", navigation)));
    auto desk = world.connect(), hall = world.connect();
    auto const first = begin(desk, Bind{Application::identifier("robot")}, world);
    auto const second = begin(hall, Bind{Application::identifier("robot")}, world);
    robot.answer("bind", Done{});
    robot.answer("bind", Done{});
    work();
    EXPECT_EQ(code_of(*first), ReturnCode::ok);
    EXPECT_EQ(code_of(*second), ReturnCode::out_of_resources);
}

TEST_F(Asynchronous, BindAnyTakesTheNextComponentIfOneDoesNotConfirm) {
    add(confirming(named("robot_a", navigation)));
    auto& second = add(confirming(named("robot_b", navigation)));
    auto desk = world.connect();
    auto const bound = begin(desk, BindAny{}, world);
    world.advance(500ms);
    second.answer("bind", Done{});
    work();
    EXPECT_EQ(std::get<BindAny::Reply>(std::get<Reply>(bound->said.value())).component_ref.code, "robot_b");
    auto hall = world.connect();
    auto const none = begin(hall, BindAny{equal("name", "robot_a")}, world);
    world.advance(1s);
    EXPECT_EQ(code_of(*none), ReturnCode::timeout);
}

// --- Commands ---

TEST_F(Asynchronous, ACommandBeginsWhenItIsPrepared) {
    auto& robot = add(named("robot", navigation));
    robot.answers_prepare = false;
    auto desk = world.connect();
    desk.bind("robot");
    auto const asked = execute(desk, go("go", "robot"));
    EXPECT_FALSE(asked->said);
    EXPECT_TRUE(robot.begun.empty());
    robot.let_prepare();
    work();
    EXPECT_EQ(code_of(*asked), ReturnCode::ok);
    EXPECT_EQ(robot.begun.size(), 1U);
    robot.port().completed(robot.begun.front(), CompletedStatus::ok);
    work();
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go OK"));
}

TEST_F(Asynchronous, NothingRunsIfOneOfTheCommandsIsNotPreparedInTime) {
    auto& robot = add(named("robot", navigation));
    robot.answers_prepare = false;
    auto desk = world.connect();
    desk.bind("robot");
    desk.bind("speech");
    auto const asked = execute(desk, say("say"), go("go", "robot"));
    world.advance(1s);
    EXPECT_EQ(code_of(*asked), ReturnCode::timeout);
    EXPECT_EQ(reason_of(*asked), "command_unit_list[2]: the component 'robot' did not answer within 1 s; no command has begun");
    EXPECT_THAT(world["speech"].calls, IsEmpty());
    EXPECT_EQ(desk.result_of("say"), "BAD_PARAMETER") << "the commands do not exist";
    robot.let_prepare();
    work();
    EXPECT_TRUE(robot.begun.empty());
}

TEST_F(Asynchronous, ACommandThatIsStoppedBeforeItIsPreparedDoesNotBegin) {
    auto& robot = add(moving(named("robot", navigation)));
    robot.answers_prepare = false;
    auto desk = world.connect();
    desk.bind("robot");
    auto const started = execute(desk, go("go", "robot"));
    auto const stopped = execute(desk, rois::stop("robot"));
    EXPECT_EQ(code_of(*stopped), ReturnCode::ok) << "a stop does not wait for anything";
    robot.let_prepare();
    work();
    EXPECT_EQ(code_of(*started), ReturnCode::error);
    EXPECT_THAT(reason_of(*started), HasSubstr("stopped before"));
    EXPECT_TRUE(robot.begun.empty());
}

TEST_F(Asynchronous, EachOfTwoStartsThatWereUnderWayAtOnceReplacesTheOneBefore) {
    auto& robot = add(moving(named("robot", navigation)));
    auto desk = world.connect();
    desk.bind("robot");
    execute(desk, go("first", "robot"));
    robot.answers_prepare = false;
    auto const second = execute(desk, go("second", "robot"));
    auto const third = execute(desk, go("third", "robot"));
    robot.let_prepare();
    robot.let_prepare();
    work();
    EXPECT_EQ(code_of(*second), ReturnCode::ok);
    EXPECT_EQ(code_of(*third), ReturnCode::ok);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed first ABORT", "2 completed second ABORT"));
    EXPECT_EQ(robot.begun.size(), 3U);
}

TEST_F(Asynchronous, ReleaseAndAStopOfEverythingKeepACommandFromBeginning) {
    auto& robot = add(named("robot", navigation));
    robot.answers_prepare = false;
    auto desk = world.connect();
    desk.bind("robot");
    auto const first = execute(desk, go("go", "robot"));
    desk.release("robot");
    robot.let_prepare();
    work();
    EXPECT_EQ(code_of(*first), ReturnCode::error);
    desk.bind("robot");
    auto const second = execute(desk, go("go", "robot"));
    world.engine->stop_everything(world.now);
    robot.let_prepare();
    work();
    EXPECT_EQ(code_of(*second), ReturnCode::error);
    EXPECT_TRUE(robot.begun.empty());
}

TEST_F(Asynchronous, TwoWaitingExecutesCannotHaveTheSameCommandId) {
    auto& robot = add(named("robot", navigation));
    robot.answers_prepare = false;
    auto desk = world.connect();
    desk.bind("robot");
    auto const first = execute(desk, go("go", "robot")), second = execute(desk, go("go", "robot"));
    robot.let_prepare();
    robot.let_prepare();
    work();
    EXPECT_EQ(code_of(*first), ReturnCode::ok);
    EXPECT_EQ(code_of(*second), ReturnCode::bad_parameter);
}

TEST_F(Asynchronous, SetParameterCompletesWhenTheComponentHasAcceptedTheValues) {
    auto& robot = add(named("robot", navigation));
    auto desk = world.connect();
    desk.bind("robot");
    auto const reply = desk.set_parameter("robot", {integer("time_limit", 5)});
    EXPECT_EQ(desk.result_of(reply.command_id.text), "RUNNING");
    robot.port().completed(robot.begun.front(), CompletedStatus::ok);
    work();
    EXPECT_EQ(desk.result_of(reply.command_id.text), "OK");
    desk.set_parameter("robot", {integer("time_limit", 6)});
    world.advance(5s);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed " + reply.command_id.text + " OK"));
}

TEST_F(Asynchronous, SuspendAndResumeCompleteWhenTheyAreConfirmed) {
    auto& robot = add(named("robot", navigation));
    auto desk = world.connect();
    desk.bind("robot");
    desk.execute(go("go", "robot"));
    desk.execute(named("wait", suspend("robot")));
    EXPECT_THAT(desk.received(), IsEmpty());
    robot.answer("suspend", Done{});
    work();
    EXPECT_THAT(desk.received(), ElementsAre("1 completed wait OK"));
    desk.execute(named("on", resume("robot")));
    robot.answer("resume", Done{});
    work();
    EXPECT_THAT(desk.received(), ElementsAre("2 completed on OK"));
}

TEST_F(Asynchronous, ASuspendThatIsNotConfirmedHaltsAMovingComponent) {
    auto& robot = add(moving(named("robot", navigation)));
    auto desk = world.connect();
    desk.bind("robot");
    desk.execute(go("go", "robot"));
    desk.execute(named("wait", suspend("robot")));
    world.advance(500ms);
    EXPECT_THAT(desk.received(),
                ElementsAre("1 completed go ABORT", "2 completed wait TIMEOUT", "3 COMPONENT_NOT_RESPONDING robot"));
    EXPECT_EQ(world.engine->not_halted(), std::vector<std::string>{}) << "the halt was confirmed";
    robot.answer("suspend", Done{});
    work();
    EXPECT_EQ(world.stray_answers(), 1U);
}

TEST_F(Asynchronous, AStopCompletesWhenTheHaltIsConfirmed) {
    auto& robot = add(named("robot", navigation));
    robot.answers_halts = false;
    auto desk = world.connect();
    desk.bind("robot");
    desk.execute(go("go", "robot"));
    desk.execute(named("stop", rois::stop("robot")));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go ABORT"));
    robot.confirm_halt();
    work();
    EXPECT_THAT(desk.received(), ElementsAre("2 completed stop OK"));
}

TEST_F(Asynchronous, AStopThatIsNotConfirmedTimesOutAndIsRepeated) {
    auto& robot = add(named("robot", navigation));
    robot.answers_halts = false;
    auto desk = world.connect();
    desk.bind("robot");
    desk.execute(go("go", "robot"));
    desk.execute(named("stop", rois::stop("robot")));
    world.advance(500ms);
    EXPECT_THAT(desk.received(), testing::Contains(HasSubstr("completed stop TIMEOUT")));
    EXPECT_THAT(world.engine->not_halted(), ElementsAre("robot"));
    world.advance(200ms);
    EXPECT_EQ(robot.questions.size(), 2U) << "asked again";
    robot.confirm_halt();
    work();
    EXPECT_THAT(world.engine->not_halted(), IsEmpty()) << "any of the halts confirms";
}

TEST_F(Asynchronous, AConfirmationOfAnEarlierHaltDoesNotConfirmALaterOne) {
    auto& robot = add(named("robot", navigation));
    auto desk = world.connect();
    desk.bind("robot");
    robot.answers_halts = false;
    desk.execute(rois::stop("robot"));
    auto const earlier = robot.questions.front().ticket;
    robot.confirm_halt();
    work();
    desk.execute(named("stop 2", rois::stop("robot")));
    robot.port().halted(earlier);
    work();
    EXPECT_EQ(desk.result_of("stop 2"), "RUNNING");
    robot.confirm_halt();
    work();
    EXPECT_EQ(desk.result_of("stop 2"), "OK");
}

// --- Many reports ---

TEST_F(Asynchronous, AFloodOfOneProviderDelaysOnlyItsOwnReports) {
    auto& loud = add(named("loud", navigation));
    auto& robot = add(named("robot", navigation));
    auto desk = world.connect();
    desk.subscribe("reached_target", equal("component_ref", "loud"));
    auto const asked = query(desk, equal("component_ref", "robot"));
    for (int i = 0; i < 1'000; ++i)
        loud.port().event("reached_target", {{text("target", "desk"), value("is_final_target", "bool", {"false"})}, {}});
    robot.answer_query("2.5");
    // One turn of the engine handles a few reports of each provider.
    world.engine->tick(world.now);
    EXPECT_EQ(code_of(*asked), ReturnCode::ok);
    EXPECT_EQ(desk.received().size(), 1'000U);
}

}  // namespace rois
