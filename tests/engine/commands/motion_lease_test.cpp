// The motion lease (decision 33): the robot moves only while its application gives signs of life.
#include "engine/commands/motion_lease.hpp"

#include "engine/world.hpp"

namespace rois {

namespace {

Part moving(Part part) {
    part.moves = true;
    return part;
}

// An application whose robot is on its way. It has sent only requests so far.
class Lease : public testing::Test {
protected:
    Lease() {
        desk.bind("navigation");
        desk.bind("speech");
    }

    void open(LinkKind link = LinkKind::websocket) { world.engine->link_opened(desk.session, link, world.now); }
    void close(LinkKind link = LinkKind::websocket, Closing how = Closing::lost) {
        world.engine->link_closed(desk.session, link, how, world.now);
    }
    void pong() { world.engine->note_pong(desk.session, world.now); }
    bool is_asked() const { return world.engine->notifications(desk.session)->wants_signs_of_life(world.now.steady); }

    World world{moving(navigation), speech};
    ScriptedComponent& robot = world["navigation"];
    Application desk = world.connect_without_link();
};

}  // namespace

TEST_F(Lease, OfASilentWebSocketHoldsTheMotion) {
    open();
    desk.execute(go("go"));
    world.advance(1950ms);
    EXPECT_THAT(robot.calls, ElementsAre("start"));
    world.advance(50ms);
    EXPECT_THAT(robot.calls, ElementsAre("start", "suspend"));
    EXPECT_THAT(desk.received(), ElementsAre("1 USER_DEFINED_ERROR navigation"));
    auto const detail = desk.detail_of(desk.last_received<ReceiveError>().error_id);
    EXPECT_THAT(in_words(detail.results.parameters), HasSubstr("its application gave no sign of life"));
    world.advance(1s);
    EXPECT_THAT(robot.calls, ElementsAre("start", "suspend")) << "once is enough";
}

TEST_F(Lease, IsRenewedByPongsAndRequests) {
    open();
    desk.execute(go("go"));
    for (int i = 0; i < 4; ++i) {
        world.advance(1900ms);
        pong();
        world.advance(1900ms);
        desk.query("route");
    }
    EXPECT_THAT(robot.calls, ElementsAre("start"));
}

TEST_F(Lease, MayBeRenewedByRequestsAlone) {
    EXPECT_EQ(desk.ask(Connect{.motion_lease = {}, .motion_lease_http = {}, .motion_proof = MotionProof::request}).return_code,
              ReturnCode::ok);
    open();
    desk.execute(go("go"));
    world.advance(1900ms);
    pong();
    world.advance(100ms);
    EXPECT_THAT(robot.calls, ElementsAre("start", "suspend"));
}

TEST_F(Lease, OfAnOpenStreamMayBeRenewedByRequestsAlone) {
    EXPECT_EQ(
        desk.ask(Connect{.motion_lease = {}, .motion_lease_http = 3000ms, .motion_proof = MotionProof::request}).return_code,
        ReturnCode::ok);
    open(LinkKind::stream);
    desk.execute(go("go"));
    world.advance(1900ms);
    desk.query("route");
    world.advance(1950ms);
    EXPECT_THAT(robot.calls, ElementsAre("start"));
    world.advance(50ms);
    EXPECT_THAT(robot.calls, ElementsAre("start", "suspend"));
}

TEST_F(Lease, IsNotRenewedByTheAnswerToALongPollWhereRequestsAloneCount) {
    EXPECT_EQ(
        desk.ask(Connect{.motion_lease = {}, .motion_lease_http = 3000ms, .motion_proof = MotionProof::request}).return_code,
        ReturnCode::ok);
    desk.execute(go("go"));
    open(LinkKind::stream);
    world.advance(1s);
    close(LinkKind::stream, Closing::answered);
    world.advance(1950ms);
    EXPECT_THAT(robot.calls, ElementsAre("start"));
    world.advance(50ms);
    EXPECT_THAT(robot.calls, ElementsAre("start", "suspend"));
}

TEST_F(Lease, OfAWebSocketThatClosesEndsAtOnce) {
    open();
    desk.execute(go("go"));
    close();
    world.advance(200ms);
    EXPECT_THAT(robot.calls, ElementsAre("start"));
    world.advance(50ms);
    EXPECT_THAT(robot.calls, ElementsAre("start", "suspend"));
}

TEST_F(Lease, GoesOnWithALinkThatTakesThePlaceOfAnotherOne) {
    open();
    desk.execute(go("go"));
    close();
    world.advance(200ms);
    open();
    world.advance(1900ms);
    EXPECT_THAT(robot.calls, ElementsAre("start"));
}

TEST_F(Lease, OfAnOpenStreamLastsAsLongAsTheStream) {
    open(LinkKind::stream);
    desk.execute(go("go"));
    world.advance(60s);
    EXPECT_THAT(robot.calls, ElementsAre("start"));
    close(LinkKind::stream);
    world.advance(250ms);
    EXPECT_THAT(robot.calls, ElementsAre("start", "suspend"));
}

TEST_F(Lease, GoesOnBetweenTwoLongPolls) {
    desk.execute(go("go"));
    for (int i = 0; i < 5; ++i) {
        open(LinkKind::stream);
        world.advance(30s);
        close(LinkKind::stream, Closing::answered);
        world.advance(9900ms);
    }
    EXPECT_THAT(robot.calls, ElementsAre("start"));
    world.advance(100ms);
    EXPECT_THAT(robot.calls, ElementsAre("start", "suspend"));
}

TEST_F(Lease, OfRequestsAloneIsLonger) {
    desk.execute(go("go"));
    world.advance(9900ms);
    desk.query("route");
    world.advance(9950ms);
    EXPECT_THAT(robot.calls, ElementsAre("start"));
    world.advance(50ms);
    EXPECT_THAT(robot.calls, ElementsAre("start", "suspend"));
}

TEST_F(Lease, MayBeShorter) {
    EXPECT_EQ(desk.ask(Connect{.motion_lease = 1000ms, .motion_lease_http = 3000ms, .motion_proof = {}}).return_code,
              ReturnCode::ok);
    desk.execute(go("go"));
    world.advance(3s);
    EXPECT_THAT(robot.calls, ElementsAre("start", "suspend"));
    open();
    desk.execute(resume("navigation"));
    world.advance(1s);
    EXPECT_THAT(robot.calls, ElementsAre("start", "suspend", "resume", "suspend"));
}

TEST_F(Lease, IsNeitherLongerThanTheGatewaysNorTooShort) {
    for (auto const lease : {0ms, 999ms, 2001ms}) {
        auto const refused = desk.ask(Connect{.motion_lease = lease, .motion_lease_http = {}, .motion_proof = {}});
        EXPECT_EQ(refused.return_code, ReturnCode::bad_parameter);
        EXPECT_THAT(refused.reason,
                    HasSubstr("motion_lease must be 1000 to 2000 milliseconds, not " + std::to_string(lease.count())));
    }
    auto const refused = desk.ask(Connect{.motion_lease = {}, .motion_lease_http = 10001ms, .motion_proof = {}});
    EXPECT_THAT(refused.reason, HasSubstr("motion_lease_http must be 1000 to 10000"));
    EXPECT_EQ(world.engine->statistics().sessions, 1U);
}

TEST_F(Lease, HoldsOnlyComponentsThatMove) {
    desk.release("navigation");
    desk.execute(say("say"));
    world.advance(20s);
    EXPECT_THAT(world["speech"].calls, ElementsAre("start"));
    EXPECT_FALSE(is_asked());
}

TEST_F(Lease, HoldsACommandOfTheComponentsOwn) {
    desk.execute(command("dock", "navigation"));
    robot.begins();
    world.advance(10s);
    EXPECT_THAT(robot.calls, ElementsAre("dock", "suspend"));
}

TEST_F(Lease, HaltsAComponentThatCannotBeSuspended) {
    robot.throws_in = {"suspend"};
    desk.execute(go("go"));
    world.advance(10s);
    EXPECT_THAT(robot.calls, ElementsAre("start", "suspend", "halt"));
    EXPECT_EQ(desk.result_of("go"), "ABORT");
}

TEST_F(Lease, ThatHasEndedLetsOnlyResumeOrANewCommandGoOn) {
    desk.execute(go("go"));
    world.advance(10s);
    desk.query("route");
    world.advance(1s);
    EXPECT_THAT(robot.calls, ElementsAre("start", "suspend"));
    desk.execute(named("on", resume("navigation")));
    EXPECT_THAT(robot.calls, ElementsAre("start", "suspend", "resume"));
    world.advance(10s);
    desk.execute(go("elsewhere"));
    EXPECT_THAT(robot.calls, ElementsAre("start", "suspend", "resume", "suspend", "halt", "start"));
}

TEST_F(Lease, ThatHasEndedLetsNothingBeginByItself) {
    desk.execute(after(11s, go("late")));
    world.advance(11s);
    EXPECT_THAT(robot.calls, IsEmpty());
    EXPECT_THAT(desk.received(), ElementsAre("1 completed late ABORT"));
    EXPECT_THAT(desk.reason_of("late"), HasSubstr("gave no sign of life"));
}

TEST_F(Lease, AsksForSignsOfLifeWhileSomethingMovesOrWillMove) {
    open();
    world.advance(100ms);
    EXPECT_FALSE(is_asked());
    desk.execute(after(1s, go("go")));
    world.advance(50ms);
    EXPECT_TRUE(is_asked());
    world.advance(1s);
    robot.finishes();
    world.advance(1s);
    EXPECT_FALSE(is_asked());
}

TEST_F(Lease, EndsForAllWhenTheEngineItselfStoodStill) {
    open(LinkKind::stream);
    world.advance(50ms);
    desk.execute(go("go"));
    world.now = world.now + 10s;
    desk.query("route");
    world.advance(50ms);
    EXPECT_THAT(robot.calls, ElementsAre("start", "suspend"));
    auto const last = desk.received();
    EXPECT_THAT(last, ElementsAre("1 USER_DEFINED_ERROR navigation"));
    EXPECT_THAT(in_words(desk.detail_of(desk.last_received<ReceiveError>().error_id).results.parameters),
                HasSubstr("the engine stood still for 10.05 s"));
}

TEST_F(Lease, DoesNotDependOnTheCalendar) {
    open(LinkKind::stream);
    desk.execute(go("go"));
    world.set_calendar(std::chrono::hours{24});
    world.advance(1s);
    world.set_calendar(std::chrono::hours{-48});
    world.advance(1s);
    EXPECT_THAT(robot.calls, ElementsAre("start"));
}

TEST_F(Lease, CoversCommandsThatBeginWhileOthersAreHeld) {
    open();
    desk.execute(go("go"));
    world.advance(2s);
    desk.execute(command("dock", "navigation"));
    robot.begins();
    world.advance(2s);
    EXPECT_THAT(robot.calls, ElementsAre("start", "suspend", "dock", "suspend"));
}

TEST_F(Lease, CoversAStartWhileACommandOfItsOwnIsSuspended) {
    open();
    desk.execute(command("dock", "navigation"));
    robot.begins();
    desk.execute(suspend("navigation"));
    desk.execute(go("go"));
    world.advance(2s);
    EXPECT_THAT(robot.calls, ElementsAre("dock", "suspend", "start", "suspend"));
}

TEST_F(Lease, EndsWithTheSessionAlsoIfItsCommandsContinue) {
    EngineSettings settings;
    settings.on_session_end = OnSessionEnd::continue_;
    World lasting{{moving(navigation), speech}, settings};
    auto visitor = lasting.connect();
    visitor.bind("navigation");
    visitor.bind("speech");
    visitor.execute(go("go"));
    visitor.execute(rois::say("greet"));
    visitor.execute(after(1s, go("later")));
    visitor.leave();
    lasting.advance(2s);
    EXPECT_THAT(lasting["navigation"].calls, ElementsAre("start", "halt"));
    EXPECT_THAT(lasting["speech"].calls, ElementsAre("start"));
}

TEST_F(Lease, IsNotNeededByAnActionThatFailedToBegin) {
    robot.throws_in = {"start", "perform"};
    desk.execute(go("go"));
    desk.execute(command("dock", "navigation"));
    EXPECT_THAT(robot.calls, ElementsAre("start", "halt", "dock", "halt")) << "it may have begun nevertheless";
}

}  // namespace rois
