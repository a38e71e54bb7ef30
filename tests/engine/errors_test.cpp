// Decisions 16 and 24: failing components, and the sessions that are notified.
#include "engine/world.hpp"

namespace rois {

using testing::Contains;

namespace {

struct Errors : testing::Test {
    World world{navigation, speech, detection};
    Application desk = world.connect();
    ScriptedComponent& robot = world["navigation"];

    Errors() { desk.bind("navigation"); }
};

}  // namespace

TEST_F(Errors, OfAComponentDoNotGoToSubscribersOfAnother) {
    World two{named("robot_a", navigation), named("robot_b", navigation)};
    auto hall = two.connect();
    hall.subscribe("reached_target", equal("component_ref", "robot_a"));
    two["robot_b"].reports(ErrorType::user_defined_error, "a wheel is stuck");
    EXPECT_THAT(hall.received(), IsEmpty());
    two["robot_a"].reports(ErrorType::user_defined_error, "a wheel is stuck");
    EXPECT_THAT(hall.received(), ElementsAre("1 USER_DEFINED_ERROR robot_a"));
}

TEST_F(Errors, HaveDetailsForTenMinutes) {
    robot.reports(ErrorType::component_not_responding, "the wheels are gone");
    desk.received();
    auto const id = desk.last_received<ReceiveError>().error_id;
    EXPECT_EQ(in_words(desk.detail_of(id).results.parameters),
              "component_ref=navigation time=" + to_text(world.now.utc) + " text=the wheels are gone");
    EXPECT_THAT(desk.detail_of(id, equal("component_ref", "speech")).results.parameters, IsEmpty());
    EXPECT_EQ(desk.detail_of(id, equal("colour", "red")).return_code, ReturnCode::bad_parameter);
    world.advance(10min - 50ms);
    EXPECT_EQ(desk.detail_of(id).return_code, ReturnCode::ok);
    world.advance(50ms);
    EXPECT_THAT(desk.detail_of(id).reason, HasSubstr("expired"));
    EXPECT_THAT(desk.detail_of(ErrorId{"x-7"}).reason, HasSubstr("unknown"));
}

TEST_F(Errors, OfTheEngineGoToAll) {
    struct Broken : Device {
        int advanced = 0;
        void advance(Instant) override {
            ++advanced;
            throw std::runtime_error("the floor is gone");
        }
    };
    auto const broken = std::make_shared<Broken>();
    world.engine->add(broken);
    auto hall = world.connect();
    world.advance(200ms);
    EXPECT_THAT(desk.received(), ElementsAre("1 ENGINE_INTERNAL_ERROR"));
    EXPECT_THAT(hall.received(), ElementsAre("1 ENGINE_INTERNAL_ERROR"));
    EXPECT_EQ(broken->advanced, 4) << "it is advanced again, and reported once";
    auto const detail = desk.detail_of(desk.last_received<ReceiveError>().error_id);
    EXPECT_EQ(in_words(detail.results.parameters), "time=" + to_text(world.now.utc - 150ms) + " text=the floor is gone");
}

TEST_F(Errors, OfADeviceThatThrowsAnotherTypeGoToAllToo) {
    struct Broken : Device {
        void advance(Instant) override { throw 42; }
    };
    world.engine->add(std::make_shared<Broken>());
    world.advance(200ms);
    EXPECT_THAT(desk.received(), ElementsAre("1 ENGINE_INTERNAL_ERROR"));
}

TEST_F(Errors, InAStartEndItsSequenceOnly) {
    auto hall = world.connect();
    hall.bind("speech");
    hall.execute(say("say"));
    robot.throws_in = {"start"};
    desk.execute(go("go"), go("and on"));
    EXPECT_THAT(desk.received(),
                ElementsAre("1 completed go ERROR", "2 completed and on ABORT", "3 COMPONENT_INTERNAL_ERROR navigation"));
    EXPECT_EQ(hall.result_of("say"), "RUNNING");
    EXPECT_THAT(hall.received(), IsEmpty());
}

TEST_F(Errors, MakeTheStatusErrorUntilACommandSucceeds) {
    robot.throws_in = {"start"};
    desk.execute(go("go"));
    EXPECT_EQ(desk.status_of("navigation"), "ERROR");
    robot.throws_in = {};
    desk.execute(go("again"));
    robot.finishes();
    EXPECT_EQ(desk.status_of("navigation"), "READY");
}

TEST_F(Errors, InTheOtherCommandsEndThemWithError) {
    robot.throws_in = {"suspend", "resume", "parameters_changed", "perform"};
    desk.execute(go("go"));
    desk.execute(named("hold", suspend("navigation")));
    desk.execute(named("store", set("navigation", {integer("time_limit", 1)})));
    desk.execute(named("dock", command("dock", "navigation")));
    robot.throws_in = {"resume"};
    desk.execute(named("hold 2", suspend("navigation")));
    desk.execute(named("on", resume("navigation")));
    EXPECT_THAT(
        desk.received(),
        ElementsAre("1 completed hold ERROR", "2 COMPONENT_INTERNAL_ERROR navigation", "3 completed store ERROR",
                    "4 COMPONENT_INTERNAL_ERROR navigation", "5 completed dock ERROR", "6 COMPONENT_INTERNAL_ERROR navigation",
                    "7 completed hold 2 OK", "8 completed on ERROR", "9 COMPONENT_INTERNAL_ERROR navigation"));
    robot.throws_in = {};
    desk.execute(named("on 2", resume("navigation")));
    EXPECT_THAT(desk.received(), ElementsAre("10 completed on 2 OK")) << "it was still held";
}

TEST_F(Errors, ThatAreThrownAsAnotherTypeAreErrorsToo) {
    robot.throws_no_exception = true;
    robot.throws_in = {"query"};
    EXPECT_EQ(desk.query("route").return_code, ReturnCode::error);
    EXPECT_THAT(desk.received(), ElementsAre("1 COMPONENT_INTERNAL_ERROR navigation"));
    robot.throws_in = {"start"};
    desk.execute(go("go"));
    EXPECT_THAT(desk.received(), ElementsAre("2 completed go ERROR", "3 COMPONENT_INTERNAL_ERROR navigation"));
}

TEST_F(Errors, ThatAnyClientCanCauseAreReportedOnceUntilASuccess) {
    auto hall = world.connect();
    robot.throws_in = {"query"};
    for (int i = 0; i < 2'000; ++i) hall.query("route");
    EXPECT_THAT(desk.received(), ElementsAre("1 COMPONENT_INTERNAL_ERROR navigation"));
    EXPECT_EQ(desk.status_of("navigation"), "ERROR");
    robot.throws_in = {};
    EXPECT_EQ(hall.query("route").return_code, ReturnCode::ok);
    EXPECT_EQ(desk.status_of("navigation"), "READY");
    robot.throws_in = {"query"};
    hall.query("route");
    EXPECT_THAT(desk.received(), ElementsAre("2 COMPONENT_INTERNAL_ERROR navigation"));
}

// An error that went to no session, or to another one, is reported again after a binding.
TEST_F(Errors, ThatAnyClientCanCauseAreReportedAgainAfterABinding) {
    auto hall = world.connect();
    desk.release("navigation");
    robot.throws_in = {"query"};
    for (int i = 0; i < 2; ++i) EXPECT_EQ(desk.query("route").return_code, ReturnCode::error);
    EXPECT_THAT(desk.received(), IsEmpty()) << "no session has bound it";
    hall.bind("navigation");
    for (int i = 0; i < 3; ++i) desk.query("route");
    EXPECT_THAT(hall.received(), ElementsAre("1 COMPONENT_INTERNAL_ERROR navigation"));
    hall.bind("navigation");
    desk.query("route");
    EXPECT_THAT(hall.received(), IsEmpty()) << "it was bound already";
    hall.release("navigation");
    desk.bind("navigation");
    hall.query("route");
    EXPECT_THAT(desk.received(), ElementsAre("1 COMPONENT_INTERNAL_ERROR navigation"));
}

TEST_F(Errors, InTheStatusAreTheStatus) {
    robot.throws_in = {"status"};
    auto hall = world.connect();
    EXPECT_EQ(desk.status_of("navigation"), "ERROR");
    EXPECT_EQ(hall.status_of("navigation"), "BUSY");
    EXPECT_THAT(desk.search(equal("status", "ERROR")), ElementsAre("navigation"));
    EXPECT_THAT(desk.search(equal("status", "READY")), ElementsAre("detection", "speech"));
    EXPECT_THAT(desk.received(), ElementsAre("1 COMPONENT_INTERNAL_ERROR navigation")) << "asked three times, reported once";
}

TEST_F(Errors, BeforeAnythingRunsAreTheAnswer) {
    robot.throws_in = {"prepare"};
    auto const executed = desk.execute(go(""));
    EXPECT_EQ(executed.return_code, ReturnCode::error);
    EXPECT_EQ(executed.reason, "command_unit_list[1]: the component 'navigation' failed: prepare went wrong");
    EXPECT_EQ(desk.set_parameter("navigation", {}).return_code, ReturnCode::error);
    EXPECT_THAT(robot.calls, IsEmpty());
    EXPECT_EQ(in_words(desk.get_parameter("navigation").parameters), "time_limit=0 routing_policy=time");
}

TEST_F(Errors, InASecondPreparationEndTheCommand) {
    desk.execute(after(200ms, go("go")), go("and on"));
    desk.set_parameter("navigation", {integer("time_limit", 1)});
    desk.received();
    robot.throws_in = {"prepare"};
    world.advance(200ms);
    EXPECT_THAT(desk.received(),
                ElementsAre("2 completed go ERROR", "3 completed and on ABORT", "4 COMPONENT_INTERNAL_ERROR navigation"));
    EXPECT_THAT(robot.calls, ElementsAre("parameters_changed"));
}

TEST_F(Errors, InReadingParametersLeaveTheLastOnes) {
    desk.bind("speech");
    world["speech"].throws_in = {"readable_parameters"};
    EXPECT_EQ(desk.status_of("speech"), "ERROR");
    EXPECT_THAT(in_words(desk.get_parameter("speech").parameters), HasSubstr("synthesizable_languages=en|ja"));
    EXPECT_THAT(desk.received(), ElementsAre("1 COMPONENT_INTERNAL_ERROR speech")) << "reported once";
}

TEST_F(Errors, AParameterThatIsNotInTheProfileIsLeftOut) {
    robot.throws_in = {"more than is known"};
    EXPECT_EQ(in_words(desk.get_parameter("navigation").parameters), "time_limit=0 routing_policy=time");
}

TEST_F(Errors, InTheDescriptionComeTooLateToMatter) {
    robot.throws_in = {"description"};
    EXPECT_THAT(desk.search(), ElementsAre("detection", "navigation", "speech"));
    EXPECT_EQ(desk.execute(go("go")).return_code, ReturnCode::ok);
}

// --- Wrong answers ---

TEST_F(Errors, AnEventThatIsNotInTheProfileIsDropped) {
    desk.subscribe("reached_target");
    robot.fires("fell_over");
    EXPECT_THAT(desk.received(), ElementsAre("1 COMPONENT_INTERNAL_ERROR navigation"));
    EXPECT_THAT(in_words(desk.detail_of(desk.last_received<ReceiveError>().error_id).results.parameters),
                HasSubstr("'fell_over'"));
}

TEST_F(Errors, AnEventWithWrongResultsIsDroppedAndReportedOnce) {
    desk.subscribe("reached_target");
    for (auto const& results : {ParameterList{text("target", "desk"), text("colour", "red")}, ParameterList{integer("target", 3)},
                                ParameterList{value("is_final_target", "bool", {"perhaps"})}})
        robot.fires("reached_target", results);
    EXPECT_THAT(desk.received(), ElementsAre("1 COMPONENT_INTERNAL_ERROR navigation"));
    EXPECT_THAT(in_words(desk.detail_of(desk.last_received<ReceiveError>().error_id).results.parameters), HasSubstr("'colour'"));
    EXPECT_EQ(desk.status_of("navigation"), "ERROR");
    robot.fires("reached_target", {text("target", "desk")});
    EXPECT_THAT(desk.received(), ElementsAre("2 reached_target navigation"));
}

TEST_F(Errors, WrongResultsOfACommandEndItWithError) {
    desk.execute(named("dock", command("dock", "navigation")), go("and on"));
    robot.finishes(CompletedStatus::ok, {{text("charge", "full")}, {}});
    EXPECT_THAT(desk.received(),
                ElementsAre("1 completed dock ERROR", "2 completed and on ABORT", "3 COMPONENT_INTERNAL_ERROR navigation"));
    EXPECT_EQ(desk.result_of("dock"), "ERROR");
}

TEST_F(Errors, WrongResultsOfAQueryAreNoAnswer) {
    robot.throws_in = {"nothing right"};
    EXPECT_EQ(desk.query("route").return_code, ReturnCode::error);
    EXPECT_EQ(desk.query("route").return_code, ReturnCode::error);
    EXPECT_THAT(desk.received(), ElementsAre("1 COMPONENT_INTERNAL_ERROR navigation"));
    robot.throws_in = {};
    EXPECT_EQ(desk.query("route").return_code, ReturnCode::ok);
    EXPECT_EQ(desk.status_of("navigation"), "READY");
}

// --- Late and unexpected answers ---

TEST_F(Errors, ADoubleAnswerIsCountedAndDropped) {
    desk.execute(go("go"));
    robot.finishes();
    robot.finishes(CompletedStatus::error);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go OK"));
    EXPECT_EQ(world.stray_answers(), 1U);
}

TEST_F(Errors, ALateAnswerIsCountedAndDropped) {
    robot.on_start = OnStart::stays_silent;
    desk.execute(go("go"));
    world.advance(5s);
    robot.begins();
    robot.finishes();
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go TIMEOUT", "2 COMPONENT_NOT_RESPONDING navigation"));
    EXPECT_EQ(world.stray_answers(), 2U);
}

TEST_F(Errors, AnAnswerToAReplacedCommandDoesNotEndTheNewOne) {
    desk.execute(go("here"));
    auto const here = robot.latest();
    desk.execute(go("there"));
    robot.answers(here);
    EXPECT_EQ(desk.result_of("there"), "RUNNING");
    EXPECT_EQ(world.stray_answers(), 1U);
}

TEST_F(Errors, AnAnswerToACommandThatWaitsOrNeverWasIsDropped) {
    desk.execute(after(200ms, go("go")));
    robot.answers(CommandHandle{1});
    robot.answers(CommandHandle{77});
    EXPECT_EQ(desk.result_of("go"), "WAITING");
    EXPECT_EQ(world.stray_answers(), 2U);
}

}  // namespace rois
