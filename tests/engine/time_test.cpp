// If the clock jumps by a day, no deadline is early or late, and documents have the new time.
#include "engine/world.hpp"

namespace rois {

namespace {

// The clock can be set forward and back.
struct Calendar : testing::TestWithParam<std::chrono::hours> {
    World world{navigation, speech, detection};
    Application desk = world.connect();

    Calendar() { desk.bind("navigation"); }
    void jump() {
        world.set_calendar(GetParam());
        world.engine->tick(world.now);
    }
};

}  // namespace

TEST_P(Calendar, MovesNoDelay) {
    desk.execute(after(1s, go("go")));
    jump();
    world.advance(950ms);
    EXPECT_EQ(desk.result_of("go"), "WAITING");
    world.advance(50ms);
    EXPECT_EQ(desk.result_of("go"), "RUNNING");
}

TEST_P(Calendar, MovesNoTimeout) {
    world["navigation"].on_start = OnStart::stays_silent;
    desk.execute(go("go"));
    jump();
    world.advance(4950ms);
    EXPECT_THAT(desk.received(), IsEmpty());
    world.advance(50ms);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go TIMEOUT", "2 COMPONENT_NOT_RESPONDING navigation"));
}

TEST_P(Calendar, EndsNoSessionAndForgetsNothing) {
    desk.subscribe("person_detected");
    world["detection"].fires("person_detected");
    desk.received();
    auto const event = desk.last_received<ReceiveEvent>().event_id;
    desk.execute(named("stop", stop("navigation")));
    auto silent = world.connect_without_link();
    jump();
    world.advance(29950ms);
    EXPECT_EQ(desk.detail_of(event).return_code, ReturnCode::ok);
    EXPECT_EQ(desk.result_of("stop"), "OK");
    EXPECT_EQ(silent.refusal_of(Search{}), std::nullopt);
    world.advance(50ms);
    EXPECT_EQ(silent.refusal_of(Search{}), Refusal::no_session);
    world.advance(30s);
    EXPECT_EQ(desk.detail_of(event).return_code, ReturnCode::bad_parameter);
}

TEST_P(Calendar, IsShownInDocuments) {
    auto const before = world.now.utc;
    jump();
    world["navigation"].reports(ErrorType::user_defined_error, "late");
    desk.received();
    auto const detail = desk.detail_of(desk.last_received<ReceiveError>().error_id);
    EXPECT_EQ(find(detail.results.parameters, "time")->values.front(), to_text(before + GetParam()));
}

INSTANTIATE_TEST_SUITE_P(ADay, Calendar, testing::Values(24h, -24h),
                         [](auto const& set) { return set.param > 0h ? "Forth" : "Back"; });

}  // namespace rois
