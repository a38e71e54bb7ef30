// Decisions 22 and 23 in sessions: the notifications that an application receives, and sessions that do not read.
#include "engine/world.hpp"

namespace rois {

namespace {

EngineSettings few(std::size_t waiting) {
    EngineSettings settings;
    settings.max_waiting_notifications = waiting;
    return settings;
}

}  // namespace

TEST(Notifications, NotifyTheOutbox) {
    World world{navigation};
    auto desk = world.connect(), hall = world.connect();
    desk.bind("navigation");
    EXPECT_THAT(world.notified, IsEmpty());
    desk.execute(named("stop", stop("navigation")));
    EXPECT_EQ(world.notified[desk.session], 1);
    desk.leave();
    EXPECT_EQ(world.notified[desk.session], 2) << "also for the end";
    EXPECT_EQ(world.notified[hall.session], 0);
}

TEST(Notifications, ThatMustNotBeLostEndASessionThatNeverReads) {
    World world{{navigation, speech}, few(3)};
    auto desk = world.connect(), hall = world.connect();
    desk.bind("navigation");
    desk.execute(go("go"));
    desk.bind("speech");
    for (auto const* id : {"1", "2", "3"}) desk.execute(named(id, stop("speech")));
    EXPECT_FALSE(desk.notifications_closed());
    EXPECT_EQ(desk.execute(named("4", stop("speech"))).return_code, ReturnCode::ok) << "it still gets an answer";
    EXPECT_TRUE(desk.notifications_closed());
    EXPECT_EQ(desk.refusal_of(Search{}), Refusal::no_session);
    EXPECT_THAT(world["navigation"].calls, ElementsAre("start", "halt", "parameters_changed"));
    EXPECT_EQ(hall.bind("navigation"), ReturnCode::ok);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed 1 OK", "2 completed 2 OK", "3 completed 3 OK", "4 completed 4 OK",
                                             "5 completed go ABORT"))
        << "each command completes, read or not";
}

TEST(Notifications, OfOtherSessionsAreNotAffectedByOneThatNeverReads) {
    World world{{navigation, detection}, few(3)};
    auto never_reads = world.connect(), desk = world.connect();
    never_reads.bind("detection");
    desk.subscribe("person_detected");
    for (int i = 1; i <= 5; ++i) {
        world["detection"].reports(ErrorType::user_defined_error, "dust");
        EXPECT_EQ(desk.received().size(), 1U);
    }
    EXPECT_TRUE(never_reads.notifications_closed());
    EXPECT_FALSE(desk.notifications_closed());
}

TEST(Notifications, AreCountedInTheStatistics) {
    World world{navigation, speech};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.subscribe("reached_target");
    desk.execute(go("go"));
    world["navigation"].fires("reached_target");
    world["navigation"].reports(ErrorType::user_defined_error, "tired");
    world["navigation"].finishes(CompletedStatus::timeout);
    auto const numbers = world.engine->statistics();
    EXPECT_EQ(numbers.sessions, 1U);
    EXPECT_EQ(numbers.components, 2U);
    EXPECT_EQ(numbers.subscriptions, 1U);
    EXPECT_EQ(numbers.events, 1U);
    EXPECT_EQ(numbers.errors, 1U);
    EXPECT_EQ(numbers.notifications, 3U);
    EXPECT_THAT(numbers.commands_completed, ElementsAre(0U, 0U, 0U, 0U, 1U));
}

}  // namespace rois
