// Decisions 10 to 17 and 33 to 35 by number: command sequences, their results, and how motion is held and stopped.

#include <set>

#include "engine/world.hpp"

namespace rois {

using testing::StartsWith;

namespace {

// An application that has bound all components.
struct Owner {
    World world;
    Application desk;

    explicit Owner(std::vector<Part> const& parts = {navigation, speech, detection}, EngineSettings settings = {})
        : world{parts, settings}, desk{world.connect()} {
        for (auto const& part : parts) desk.bind(part.ref);
    }
};

struct Decision10 : testing::Test, Owner {};
struct Decision11 : testing::Test, Owner {};
struct Decision12 : testing::Test, Owner {};
struct Decision13 : testing::Test, Owner {};
struct Decision14 : testing::Test, Owner {};
struct Decision15 : testing::Test, Owner {};
struct Decision16 : testing::Test, Owner {};
struct Decision17 : testing::Test, Owner {};

}  // namespace

TEST_F(Decision10, OneBadUnitAndNothingRuns) {
    desk.release("detection");
    auto const reply_to = [&](CommandUnit bad) {
        return desk.execute(set("speech", {integer("volume", 1)}), branches({{go("a"), std::move(bad)}, {start("gripper")}}));
    };
    std::string const path = "command_unit_list[2]/branch_list[1]/command_list[2]: ";
    struct Case {
        CommandUnit bad;
        ReturnCode code;
        std::string reason;
    };
    for (auto const& [bad, code, reason] :
         {Case{start("arm"), ReturnCode::bad_parameter, "unknown component"},
          Case{command("fly", "detection"), ReturnCode::error, "not bound"},
          Case{command("fly", "navigation"), ReturnCode::bad_parameter, "no command 'fly'"},
          Case{start("navigation", {text("colour", "red")}), ReturnCode::bad_parameter, "unknown parameter 'colour'"},
          Case{start("navigation", {text("time_limit", "1")}), ReturnCode::bad_parameter, "its type is int"},
          Case{after(-1ms, go("b")), ReturnCode::bad_parameter, "delay_time"}}) {
        auto const reply = reply_to(bad);
        EXPECT_EQ(reply.return_code, code) << reason;
        EXPECT_THAT(reply.reason, testing::AllOf(StartsWith(path), HasSubstr(reason))) << "the first in document order";
    }
    world.advance(1min);
    for (auto const* ref : {"navigation", "speech"}) EXPECT_THAT(world[ref].calls, IsEmpty()) << ref;
    EXPECT_THAT(desk.received(), IsEmpty());
}

TEST_F(Decision11, EveryCommandHasAnIdThatTheAnswerReturns) {
    auto const reply = desk.execute(go("mine"), in_parallel({say(""), go("")}));
    auto const ids = ids_of(reply.command_unit_list.command_unit_list);
    EXPECT_EQ(std::set<std::string>(ids.begin(), ids.end()).size(), 3U);
    EXPECT_EQ(ids[0], "mine");
    for (auto const& id : ids) EXPECT_NE(desk.result_of(id), "BAD_PARAMETER") << id;
    EXPECT_THAT(desk.execute(say("a"), say("a")).reason, HasSubstr("'a' is given twice"));
    EXPECT_EQ(desk.execute(say("mine")).return_code, ReturnCode::bad_parameter) << "it is still known";
    EXPECT_FALSE(desk.set_parameter("speech", {}).command_id.text.empty());
}

TEST_F(Decision12, EveryCommandCompletesOnceWhateverHappens) {
    desk.execute(go("goes"), say("crashes"), go("never"));
    world["speech"].throws_in = {"start"};
    world["navigation"].finishes();
    world["navigation"].finishes();
    EXPECT_THAT(desk.received(), ElementsAre("1 completed goes OK", "2 completed crashes ERROR", "3 completed never ABORT",
                                             "4 COMPONENT_INTERNAL_ERROR speech"));
    world["speech"].throws_in = {};
    world["speech"].on_start = OnStart::stays_silent;
    desk.execute(say("is silent"));
    world.advance(5s);
    world["speech"].finishes();
    EXPECT_THAT(desk.received(), ElementsAre("5 completed is silent TIMEOUT", "6 COMPONENT_NOT_RESPONDING speech"));
    desk.execute(go("goes away"));
    world.change({"navigation"}, {});
    EXPECT_THAT(desk.received(), ElementsAre("7 completed goes away ABORT", "8 profile_changed"));
    world["speech"].on_start = OnStart::acts;
    desk.execute(say("is left"));
    world.engine->end(desk.session, world.now);
    EXPECT_THAT(desk.received(), ElementsAre("9 completed is left ABORT"));
    EXPECT_TRUE(desk.notifications_closed());
}

TEST_F(Decision13, ACommandThatIsNotOkEndsItsSequence) {
    desk.execute(branches({{go("a"), go("b")}, {say("c"), say("d")}}), go("e"));
    world["navigation"].finishes(CompletedStatus::timeout);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed a TIMEOUT", "2 completed b ABORT"));
    world["speech"].finishes();
    world["speech"].finishes();
    EXPECT_THAT(desk.received(), ElementsAre("3 completed c OK", "4 completed d OK", "5 completed e ABORT"))
        << "the other branch continues, then the unit counts as failed";
    desk.execute(go("f"), say("g"), go("h"));
    desk.release("speech");
    world["navigation"].finishes();
    EXPECT_THAT(desk.received(), ElementsAre("6 completed f OK", "7 completed g ABORT", "8 completed h ABORT"))
        << "a lost binding";
    desk.bind("speech");
    desk.execute(go("i"), say("j"));
    desk.release("speech");
    desk.bind("speech");
    world["navigation"].finishes();
    EXPECT_THAT(desk.received(), ElementsAre("9 completed i OK", "10 completed j ABORT")) << "a new binding does not change that";
}

TEST_F(Decision14, AllFormsOfSequencesAreAccepted) {
    auto const running = [&] {
        std::string all;
        for (auto const* id : {"a", "b", "c", "d"})
            if (desk.result_of(id) == "RUNNING") all += id;
        return all;
    };
    for (auto const& parallel :
         {in_parallel({in_sequence({go("a"), go("b")}), say("c")}), branches({{go("a"), go("b")}, {say("c")}})}) {
        EXPECT_EQ(desk.execute(parallel, say("d")).return_code, ReturnCode::ok);
        EXPECT_EQ(running(), "ac") << "each child is a branch";
        world["navigation"].finishes();
        world["speech"].finishes();
        EXPECT_EQ(running(), "b") << "the next unit waits for all branches";
        world["navigation"].finishes();
        EXPECT_EQ(running(), "d");
        desk.leave();
        desk = world.connect();
        for (auto const* ref : {"navigation", "speech"}) desk.bind(ref);
    }
    desk.execute(pause(100ms), flat({go("a"), say("c")}), say("d"));
    EXPECT_EQ(running(), "") << "a unit without a type only delays";
    world.advance(100ms);
    EXPECT_EQ(running(), "ac") << "each of the flat form is a branch";
    EXPECT_EQ(desk.execute(pause(100ms)).return_code, ReturnCode::bad_parameter) << "a sequence needs a command";
}

TEST_F(Decision15, ADelayCountsFromTheUnitsTurn) {
    desk.execute(after(200ms, go("a")), after(300ms, say("b")));
    world.advance(150ms);
    EXPECT_EQ(desk.result_of("a"), "WAITING") << "from the receipt of the request, for the first unit";
    world.set_calendar(24h);
    world.advance(50ms);
    EXPECT_EQ(desk.result_of("a"), "RUNNING") << "in real time, whatever the calendar says";
    world.advance(1min);
    world["navigation"].finishes();
    world.advance(250ms);
    EXPECT_EQ(desk.result_of("b"), "WAITING");
    world.advance(50ms);
    EXPECT_EQ(desk.result_of("b"), "RUNNING");
    EXPECT_EQ(desk.execute(after(-1ms, say("c"))).return_code, ReturnCode::bad_parameter);
}

TEST_F(Decision16, ACommandMustHaveStartedWithinItsTimeout) {
    for (auto const* ref : {"speech", "navigation"}) world[ref].on_start = OnStart::stays_silent;
    desk.execute(in_parallel({say("two seconds"), go("five"), named("half", stop("detection"))}));
    EXPECT_THAT(desk.received(), ElementsAre("1 completed half OK"));
    world.advance(1'950ms);
    EXPECT_THAT(desk.received(), IsEmpty());
    world.advance(50ms);
    EXPECT_THAT(desk.received(), ElementsAre("2 completed two seconds TIMEOUT", "3 COMPONENT_NOT_RESPONDING speech"))
        << "the timeout of its profile";
    world.advance(2'950ms);
    EXPECT_THAT(desk.received(), IsEmpty());
    world.advance(50ms);
    EXPECT_THAT(desk.received(), ElementsAre("4 completed five TIMEOUT", "5 COMPONENT_NOT_RESPONDING navigation"))
        << "five seconds without one";
    world["navigation"].on_start = OnStart::acts;
    desk.execute(go("begun"));
    world.advance(1h);
    EXPECT_EQ(desk.result_of("begun"), "RUNNING") << "the engine sets no timeout for a command that has started";
    world["navigation"].finishes(CompletedStatus::timeout);
    EXPECT_EQ(desk.result_of("begun"), "TIMEOUT") << "the component has its own time limit";
    world["navigation"].throws_in = {"start"};
    desk.execute(go("broken"));
    EXPECT_THAT(desk.received(),
                ElementsAre("6 completed begun TIMEOUT", "7 completed broken ERROR", "8 COMPONENT_INTERNAL_ERROR navigation"));
}

TEST_F(Decision17, ResultsReportTheStateOfACommand) {
    desk.execute(named("dock", command("dock", "navigation")), say("say"));
    EXPECT_EQ(desk.result_of("dock"), "RUNNING");
    EXPECT_EQ(desk.result_of("say"), "WAITING");
    world["navigation"].finishes(CompletedStatus::ok, {{integer("charge", 80)}, {}});
    EXPECT_EQ(desk.result_of("dock"), "OK charge=80");
    EXPECT_EQ(desk.result_of("nothing"), "BAD_PARAMETER");
    EXPECT_THAT(desk.ask(GetCommandResult{{"nothing"}, {}}).reason, HasSubstr("'nothing'"));
    world.advance(10min);
    EXPECT_EQ(desk.result_of("dock"), "BAD_PARAMETER") << "expired";
    EXPECT_EQ(desk.result_of("say"), "RUNNING");
    world["speech"].finishes();
    for (int i = 0; i < 1'000; ++i) desk.execute(stop("speech")), desk.received();
    EXPECT_EQ(desk.result_of("say"), "BAD_PARAMETER") << "a thousand commands came after it";
}

TEST(Decision33, MotionIsHeldWhenItsApplicationIsSilent) {
    auto wheels = navigation;
    wheels.moves = true;
    World world{wheels};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.execute(go("go"));
    world.advance(2s);
    EXPECT_THAT(world["navigation"].calls, ElementsAre("start", "suspend"));
    EXPECT_THAT(desk.received(), ElementsAre("1 USER_DEFINED_ERROR navigation"));
    desk.execute(named("on", resume("navigation")));
    EXPECT_THAT(world["navigation"].calls, ElementsAre("start", "suspend", "resume"));
}

TEST(Decision34, StopForEverythingNeedsNoSessionAndLastsUntilItIsCleared) {
    World world{navigation, speech};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.execute(go("go"));
    world.engine->stop_everything(world.now);
    EXPECT_THAT(world["navigation"].calls, ElementsAre("start", "halt"));
    EXPECT_THAT(world["speech"].calls, ElementsAre("halt"));
    EXPECT_EQ(desk.execute(go("again")).return_code, ReturnCode::error);
    world.engine->clear();
    EXPECT_EQ(desk.execute(go("again")).return_code, ReturnCode::ok);
}

TEST(Decision35, StopAlwaysReachesTheComponentAndIsOkOnlyWhenThatStandsStill) {
    World world{navigation};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.execute(named("idle", stop("navigation")));
    EXPECT_THAT(world["navigation"].calls, ElementsAre("halt"));
    world["navigation"].throws_in = {"halt"};
    desk.execute(named("fails", stop("navigation")));
    EXPECT_EQ(desk.status_of("navigation"), "ERROR");
    EXPECT_THAT(desk.received(),
                ElementsAre("1 completed idle OK", "2 completed fails ERROR", "3 COMPONENT_INTERNAL_ERROR navigation"));
    world["navigation"].throws_in = {};
    world.advance(200ms);
    EXPECT_EQ(desk.status_of("navigation"), "READY") << "the halt was repeated";
}

}  // namespace rois
