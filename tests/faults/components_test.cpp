// Components that hang, throw, report wrong states, and answer late or twice; a calendar that jumps, and a suspended process: the
// clock goes on, and moving components halt.
#include "engine/world.hpp"

namespace rois {

using testing::Contains;

namespace {

Part moving(Part part) {
    part.moves = true;
    return part;
}

struct Misbehaving : testing::Test {
    World world{moving(navigation), speech};
    ScriptedComponent& robot = world["navigation"];
    ScriptedComponent& voice = world["speech"];
    Application desk = world.connect(), other = world.connect();

    Misbehaving() {
        desk.bind("navigation");
        other.bind("speech");
        voice.on_start = OnStart::is_done;
    }

    auto halts() { return std::ranges::count(robot.calls, "halt"); }

    // A delay of another application ends in time, whatever the robot does.
    void expect_time_to_pass() {
        other.execute(after(100ms, say("")));
        other.received();
        world.advance(100ms);
        EXPECT_THAT(other.received(), Contains(HasSubstr("completed")));
    }
};

}  // namespace

TEST_F(Misbehaving, AComponentThatThrowsInEveryCallIsHaltedUntilItCan) {
    for (bool const no_exception : {false, true}) {
        robot.throws_no_exception = no_exception;
        robot.throws_in = {"start", "halt", "suspend", "resume", "parameters_changed", "status", "query", "perform"};
        for (auto const& unit : {go(""), command("dock", "navigation"), suspend("navigation"), stop("navigation")})
            desk.execute(unit);
        world.advance(1s);
        EXPECT_THAT(world.engine->not_halted(), ElementsAre("navigation"));
        expect_time_to_pass();
        robot.throws_in = {};
        world.advance(200ms);
        EXPECT_THAT(world.engine->not_halted(), IsEmpty());
    }
}

TEST_F(Misbehaving, ASilentComponentIsHaltedInTime) {
    robot.on_start = OnStart::stays_silent;
    robot.halts_later = true;
    desk.execute(go("go"));
    world.advance(5s);
    EXPECT_EQ(desk.result_of("go"), "TIMEOUT");
    world.advance(1s);
    EXPECT_GE(halts(), 3) << "again and again, since it does not confirm";
    expect_time_to_pass();
}

TEST_F(Misbehaving, AComponentThatReportsAFalseEndIsHaltedWhenItsSessionEnds) {
    desk.execute(go("go"));
    robot.finishes();  // reports the end, but drives on
    EXPECT_EQ(desk.result_of("go"), "OK");
    desk.leave();
    EXPECT_THAT(robot.calls, Contains("halt"));
}

TEST_F(Misbehaving, AnswersTwiceAndLateAreCountedAndChangeNothing) {
    desk.execute(go("go"));
    auto const first = robot.latest();
    robot.answers(first);
    robot.answers(first, CompletedStatus::error);
    desk.execute(go("again"));
    desk.execute(stop("navigation"));
    auto const again = robot.latest();
    robot.answers(again);
    robot.stands_still();
    robot.answers(CommandHandle{4711});
    EXPECT_EQ(desk.result_of("go"), "OK");
    EXPECT_EQ(world.stray_answers(), 4);
    expect_time_to_pass();
}

TEST_F(Misbehaving, ACalendarThatJumpsMovesNoComponent) {
    for (auto const day : {24h, -48h}) {
        desk.execute(go(""));
        world.set_calendar(day);
        expect_time_to_pass();
        EXPECT_FALSE(desk.notifications_closed());
        world.engine->link_closed(desk.session, LinkKind::websocket, Closing::lost, world.now);
        world.advance(300ms);
        EXPECT_EQ(robot.calls.back(), "suspend") << "its lease has ended";
        world.engine->link_opened(desk.session, LinkKind::websocket, world.now);
    }
}

TEST_F(Misbehaving, AProcessSuspendedFor10SecondsHoldsMovingComponents) {
    desk.execute(go("go"));
    other.execute(after(5s, say("say")));
    world.now = world.now + 10s;
    world.engine->tick(world.now);
    EXPECT_EQ(robot.calls.back(), "suspend");
    EXPECT_EQ(other.result_of("say"), "OK") << "overdue actions are done";
    expect_time_to_pass();
}

}  // namespace rois
