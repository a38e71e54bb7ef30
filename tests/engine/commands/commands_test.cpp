// Decisions 8, 9, 16 and 17: the effects of commands, their ends and their results.
#include "engine/world.hpp"

namespace rois {

namespace {

struct Commands : testing::Test {
    World world{navigation, speech, detection};
    Application desk = world.connect();

    Commands() {
        for (auto const* ref : {"navigation", "speech", "detection"}) desk.bind(ref);
    }
};

}  // namespace

TEST_F(Commands, AnActionMayFail) {
    desk.execute(go("go"));
    world["navigation"].finishes(CompletedStatus::timeout);
    desk.execute(say("say"));
    world["speech"].finishes(CompletedStatus::out_of_resources);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go TIMEOUT", "2 completed say OUT_OF_RESOURCES"));
}

TEST_F(Commands, StopEndsTheRunningAction) {
    desk.execute(go("go"));
    desk.execute(named("halt", stop("navigation")));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go ABORT", "2 completed halt OK"));
    EXPECT_THAT(world["navigation"].calls, ElementsAre("start", "halt"));
}

TEST_F(Commands, AnActiveFunctionIsStartedAgainAfterAHalt) {
    desk.execute(named("look", start("detection")), named("again", start("detection")));
    EXPECT_THAT(world["detection"].calls, ElementsAre("start", "halt", "start"));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed look OK", "2 completed again OK"));
}

TEST_F(Commands, MayBeCheckedOnly) {
    desk.execute(go("go"));
    auto const check = [&](auto... units) { return desk.ask(Execute{{std::vector<CommandUnit>{std::move(units)...}}, true}); };
    auto const sequence = std::vector<CommandUnit>{stop("navigation"), say("")};
    auto const reply = desk.ask(Execute{{sequence}, true});
    EXPECT_EQ(reply.return_code, ReturnCode::ok);
    EXPECT_EQ(std::get<CommandMessage>(reply.command_unit_list.command_unit_list.at(0).unit).command_id.text, "")
        << "as it was sent";
    EXPECT_EQ(check(command("dance", "navigation")).return_code, ReturnCode::bad_parameter);
    EXPECT_THAT(check(go("go")).reason, HasSubstr("the command_id 'go' is in use in this session"));
    EXPECT_EQ(check(start("navigation")).return_code, ReturnCode::ok);
    auto const set = SetParameter{Application::identifier("navigation"), {}, true};
    auto const checked = desk.ask(set);
    EXPECT_EQ(checked.return_code, ReturnCode::ok);
    EXPECT_EQ(checked.command_id.text, "");
    auto wrong = set;
    wrong.parameters = {value("speed of light", "int", {"1"})};
    EXPECT_EQ(desk.ask(wrong).return_code, ReturnCode::bad_parameter);
    EXPECT_THAT(desk.received(), IsEmpty());
    EXPECT_THAT(world["navigation"].calls, ElementsAre("start"));
    EXPECT_EQ(desk.result_of("go"), "RUNNING");
    auto other = world.connect();
    EXPECT_EQ(other.ask(set).return_code, ReturnCode::error) << "it is bound by another session";
}

TEST_F(Commands, SuspendAndResumeInAWrongStateFail) {
    desk.execute(named("idle", suspend("navigation")));
    desk.execute(named("idle too", resume("navigation")));
    desk.execute(go("go"));
    desk.execute(named("not held", resume("navigation")));
    desk.execute(named("hold", suspend("navigation")));
    desk.execute(named("held already", suspend("navigation")));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed idle ERROR", "2 completed idle too ERROR", "3 completed not held ERROR",
                                             "4 completed hold OK", "5 completed held already ERROR"));
    EXPECT_THAT(world["navigation"].calls, ElementsAre("start", "suspend"));
}

TEST_F(Commands, ASuspensionEndsWithItsAction) {
    desk.execute(go("go"));
    desk.execute(named("hold", suspend("navigation")));
    desk.execute(named("halt", stop("navigation")));
    desk.execute(go("again"));
    desk.execute(named("on", resume("navigation")));
    EXPECT_THAT(desk.received(),
                ElementsAre("1 completed hold OK", "2 completed go ABORT", "3 completed halt OK", "4 completed on ERROR"));
}

TEST_F(Commands, AFunctionThatIsActiveMayBeSuspended) {
    desk.execute(start("detection"), named("hold", suspend("detection")), named("on", resume("detection")));
    EXPECT_THAT(world["detection"].calls, ElementsAre("start", "suspend", "resume"));
}

TEST_F(Commands, AFunctionMayBecomeActiveWhileItIsHeld) {
    world["detection"].on_start = OnStart::stays_silent;
    desk.execute(named("look", start("detection")));
    desk.execute(named("hold", suspend("detection")));
    world["detection"].finishes(CompletedStatus::ok, {}, Afterwards::active);
    desk.execute(named("on", resume("detection")));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed hold OK", "2 completed look OK", "3 completed on OK"));
}

TEST_F(Commands, OfTheProfileMayMakeTheComponentActive) {
    desk.execute(named("dock", command("dock", "navigation")));
    world["navigation"].finishes(CompletedStatus::ok, {}, Afterwards::active);
    desk.execute(named("hold", suspend("navigation")), named("on", resume("navigation")));
    desk.execute(named("halt", stop("navigation")));
    desk.execute(named("idle", suspend("navigation")));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed dock OK", "2 completed hold OK", "3 completed on OK",
                                             "4 completed halt OK", "5 completed idle ERROR"));
    EXPECT_THAT(world["navigation"].calls, ElementsAre("dock", "suspend", "resume", "halt"));
}

TEST_F(Commands, OfTheProfileMayMakeTheComponentIdle) {
    for (auto const afterwards : {Afterwards::active, Afterwards::as_before, Afterwards::idle}) {
        desk.execute(command("dock", "navigation"));
        world["navigation"].finishes(CompletedStatus::ok, {}, afterwards);
    }
    desk.received();
    desk.execute(named("idle", suspend("navigation")));
    EXPECT_THAT(desk.received(), ElementsAre("4 completed idle ERROR"));
}

TEST_F(Commands, OfTheProfileLeaveAnActiveFunctionUnchanged) {
    desk.execute(command("dock", "navigation"));
    world["navigation"].finishes(CompletedStatus::ok, {}, Afterwards::active);
    desk.execute(command("dock", "navigation"));
    world["navigation"].finishes();
    desk.execute(command("dock", "navigation"));
    world["navigation"].finishes(CompletedStatus::error, {}, Afterwards::idle);
    desk.received();
    desk.execute(named("hold", suspend("navigation")));
    EXPECT_THAT(desk.received(), ElementsAre("4 completed hold OK"));
}

TEST_F(Commands, OfTheProfileDoNotEndAStartThatRuns) {
    desk.execute(go("go"));
    auto const start = world["navigation"].latest();
    for (auto const afterwards : {Afterwards::active, Afterwards::idle}) {
        desk.execute(command("dock", "navigation"));
        world["navigation"].finishes(CompletedStatus::ok, {}, afterwards);
    }
    world["navigation"].answers(start);
    desk.execute(named("idle", suspend("navigation")));
    EXPECT_THAT(desk.received(), ElementsAre(testing::_, testing::_, "3 completed go OK", "4 completed idle ERROR"));
}

TEST_F(Commands, AFunctionThatACommandOfTheProfileMadeActiveEndsWithTheBinding) {
    desk.execute(command("dock", "navigation"));
    world["navigation"].finishes(CompletedStatus::ok, {}, Afterwards::active);
    desk.release("navigation");
    EXPECT_THAT(world["navigation"].calls, ElementsAre("dock", "halt"));
}

TEST_F(Commands, AFunctionThatFailsToStartIsNotActive) {
    world["detection"].on_start = OnStart::stays_silent;
    desk.execute(named("look", start("detection")));
    world["detection"].finishes(CompletedStatus::error, {}, Afterwards::active);
    desk.execute(named("hold", suspend("detection")));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed look ERROR", "2 completed hold ERROR"));
}

TEST_F(Commands, OfTheComponentsOwnProfileHaveArgumentsAndResults) {
    desk.execute(named("dock", command("dock", "navigation", {text("side", "right")})));
    EXPECT_EQ(in_words(world["navigation"].started_with), "side=right times=1") << "missing arguments have their default values";
    EXPECT_EQ(desk.result_of("dock"), "RUNNING");
    world["navigation"].finishes(CompletedStatus::ok, {{integer("charge", 80)}, {}});
    EXPECT_THAT(desk.received(), ElementsAre("1 completed dock OK"));
    EXPECT_EQ(desk.result_of("dock"), "OK charge=80");
    EXPECT_EQ(in_words(desk.get_parameter("navigation").parameters), "time_limit=0 routing_policy=time")
        << "arguments of a command are not parameters";
}

TEST_F(Commands, OfAnUnknownTypeAreABadParameter) {
    auto const refused = desk.execute(command("fly", "navigation"));
    EXPECT_EQ(refused.return_code, ReturnCode::bad_parameter);
    EXPECT_EQ(refused.reason,
              "command_unit_list[1]: the component 'navigation' has no command 'fly'; it has set_parameter, "
              "dock, start, stop, suspend, resume");
    EXPECT_EQ(desk.execute(command("stop", "navigation", {text("side", "left")})).return_code, ReturnCode::bad_parameter);
    EXPECT_EQ(desk.execute(command("dock", "navigation", {integer("side", 1)})).return_code, ReturnCode::bad_parameter);
}

TEST(Follow, EndsWithOkWhenItIsStopped) {
    auto follow = named("follow", navigation);
    follow.status_when_stopped = CompletedStatus::ok;
    World world{follow};
    auto desk = world.connect();
    desk.bind("follow");
    desk.execute(go("follow", "follow"));
    desk.execute(named("enough", stop("follow")));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed follow OK", "2 completed enough OK"));
    desk.execute(go("follow again", "follow"));
    desk.execute(go("somebody else", "follow"));
    EXPECT_THAT(desk.received(), ElementsAre("3 completed follow again ABORT")) << "replaced is not stopped";
    desk.release("follow");
    EXPECT_THAT(desk.received(), ElementsAre("4 completed somebody else ABORT"));
}

// --- Starting in time (decision 16) ---

TEST_F(Commands, ThatHaveBegunMayTakeAsLongAsTheyNeed) {
    world["speech"].on_start = OnStart::stays_silent;
    desk.execute(say("say"));
    world.advance(1900ms);
    world["speech"].begins();
    world.advance(1h);
    EXPECT_THAT(desk.received(), IsEmpty());
    world["speech"].finishes();
    EXPECT_THAT(desk.received(), ElementsAre("1 completed say OK"));
}

TEST_F(Commands, OfTheComponentsOwnMustBeginInTimeToo) {
    desk.execute(named("dock", command("dock", "navigation")));
    world.advance(500ms);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed dock TIMEOUT", "2 COMPONENT_NOT_RESPONDING navigation"));
    EXPECT_EQ(world["navigation"].calls.back(), "halt");
}

TEST_F(Commands, TimeoutsEndWithTheCommand) {
    world["speech"].on_start = OnStart::stays_silent;
    desk.execute(say("say"));
    desk.execute(stop("speech"));
    desk.execute(say("again"));
    world.advance(1s);
    world["speech"].begins();
    desk.received();
    world.advance(10s);
    EXPECT_THAT(desk.received(), IsEmpty());
}

// --- Results (decision 17) ---

TEST_F(Commands, ReportWhyTheyDidNotEndWithOk) {
    desk.execute(go("first"));
    desk.execute(go("second"));
    EXPECT_EQ(desk.reason_of("first"), "another start replaced it");
    desk.execute(go("third"), say("then"));
    desk.release("navigation");
    EXPECT_EQ(desk.reason_of("third"), "its component was released");
    EXPECT_EQ(desk.reason_of("then"), "the command 'third' of its sequence ended with ABORT");
    EXPECT_EQ(desk.reason_of("second"), "another start replaced it");
}

TEST_F(Commands, HaveResultsThatAConditionSelects) {
    desk.execute(named("dock", command("dock", "navigation")));
    world["navigation"].finishes(CompletedStatus::ok, {{integer("charge", 80)}, {}});
    EXPECT_EQ(desk.result_of("dock", equal("charge", "80")), "OK charge=80");
    EXPECT_EQ(desk.result_of("dock", equal("status", "ERROR")), "");
    EXPECT_EQ(desk.result_of("dock", equal("colour", "red")), "BAD_PARAMETER");
}

TEST(Results, OfTheLastThousandAreKept) {
    EngineSettings settings;
    settings.max_command_results = 3;
    World world{{navigation}, settings};
    auto desk = world.connect();
    desk.bind("navigation");
    for (auto const* id : {"1", "2", "3", "4"}) desk.execute(named(id, stop("navigation")));
    EXPECT_EQ(desk.result_of("1"), "BAD_PARAMETER");
    EXPECT_EQ(desk.result_of("2"), "OK");
    EXPECT_EQ(desk.result_of("4"), "OK");
    EXPECT_EQ(desk.execute(named("1", stop("navigation"))).return_code, ReturnCode::ok) << "the command_id is free again";
}

TEST(Results, ThatHaveExpiredFreeTheirCommandId) {
    World world{navigation};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.execute(named("halt", stop("navigation")));
    world.now = world.now + 10min;  // without a tick in between
    EXPECT_EQ(desk.execute(named("halt", stop("navigation"))).return_code, ReturnCode::ok);
}

TEST(Results, OfEachSessionExpireSeparately) {
    EngineSettings settings;
    settings.max_command_results = 2;
    settings.command_results = 10s;
    settings.on_session_end = OnSessionEnd::continue_;
    World world{{navigation, speech, named("speech_b", speech)}, settings};
    auto desk = world.connect(), hall = world.connect(), door = world.connect();
    desk.bind("navigation");
    hall.bind("speech");
    door.bind("speech_b");
    auto const halt = [](Application& who, std::string const& id, std::string const& ref) { who.execute(named(id, stop(ref))); };
    halt(desk, "d1", "navigation");
    halt(door, "gone", "speech_b");
    world.advance(2s);
    halt(hall, "h1", "speech");
    halt(desk, "d2", "navigation");
    world.advance(2s);
    halt(desk, "d3", "navigation");  // d1 exceeds the limit
    EXPECT_EQ(desk.result_of("d1"), "BAD_PARAMETER");
    world.advance(1s);
    door.leave();  // before its result has expired
    world.advance(8s);
    auto const known = [&] {
        std::string words;
        for (auto const* id : {"d2", "d3"}) words += desk.result_of(id) + " ";
        return words + hall.result_of("h1");
    };
    EXPECT_EQ(known(), "BAD_PARAMETER OK BAD_PARAMETER");
    halt(hall, "h2", "speech");
    world.advance(2s);
    EXPECT_EQ(known(), "BAD_PARAMETER BAD_PARAMETER BAD_PARAMETER");
    EXPECT_EQ(hall.result_of("h2"), "OK");
    world.advance(8s);
    EXPECT_EQ(hall.result_of("h2"), "BAD_PARAMETER");
}

}  // namespace rois
