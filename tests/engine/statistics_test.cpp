// The engine's statistics of sessions and limits.
#include "engine/world.hpp"

namespace rois {

namespace {

std::uint64_t reached(World const& world, std::string_view what) {
    for (auto const& limit : world.engine->statistics().limits)
        if (limit.of == what) return limit.reached;
    ADD_FAILURE() << "there is no limit of " << what;
    return 0;
}

}  // namespace

TEST(Statistics, OfSessionsAreByTheirNumber) {
    World world{navigation, speech, detection};
    auto const begun = world.now.steady;
    auto desk = world.connect();
    world.advance(2s);
    auto hall = world.connect(), guest = world.connect();
    hall.leave();
    guest.bind("speech");
    guest.bind("navigation");
    guest.subscribe("reached_target");
    guest.execute(go("go"), go("and on"));
    world["navigation"].fires("reached_target");
    auto const all = world.engine->statistics().each_session;
    ASSERT_EQ(all.size(), 2U);
    EXPECT_EQ(all[0].number, 1U);
    EXPECT_EQ(all[0].connected, begun);
    EXPECT_THAT(all[0].bound, IsEmpty());
    EXPECT_EQ(all[1].number, 3U) << "the number of a session that has ended is not given again";
    EXPECT_EQ(all[1].connected, begun + 2s);
    EXPECT_THAT(all[1].bound, ElementsAre("navigation", "speech"));
    EXPECT_EQ(all[1].commands, 2U);
    EXPECT_EQ(all[1].subscriptions, 1U);
    EXPECT_EQ(all[1].waiting_notifications, 1U);
    guest.received();
    world["navigation"].finishes();
    guest.release("speech");
    auto const later = world.engine->statistics().each_session[1];
    EXPECT_THAT(later.bound, ElementsAre("navigation"));
    EXPECT_EQ(later.commands, 1U);
    EXPECT_EQ(later.waiting_notifications, 1U) << "the completion of one of them";
}

TEST(Statistics, CountHowOftenALimitWasReached) {
    EngineSettings settings;
    settings.max_sessions = 1;
    settings.max_waiting_notifications = 2;
    settings.max_subscribed_predicates = 1;
    World world{{navigation, detection}, settings};
    auto desk = world.connect();
    for (auto const* limit : {"sessions", "commands", "subscribed_predicates", "waiting_notifications"})
        EXPECT_EQ(reached(world, limit), 0U);
    EXPECT_EQ(world.engine->statistics().limits.front().most, 1U);

    EXPECT_TRUE(std::holds_alternative<Refusal>(world.say({}, Connect{})));
    EXPECT_EQ(reached(world, "sessions"), 1U);
    desk.bind("navigation");
    EXPECT_EQ(desk.execute(go("1"), go("2"), go("3")).return_code, ReturnCode::out_of_resources);
    EXPECT_EQ(reached(world, "commands"), 1U);
    EXPECT_EQ(desk.subscribe("person_detected", both({equal("name", "detection"), equal("bound", "false")})).return_code,
              ReturnCode::out_of_resources);
    EXPECT_EQ(reached(world, "subscribed_predicates"), 1U);

    desk.subscribe("person_detected");
    for (int i = 0; i < 5; ++i) world["detection"].fires("person_detected");
    EXPECT_EQ(reached(world, "waiting_notifications"), 3U) << "events that were dropped";
    desk.received();
    for (int i = 0; i < 3; ++i) world["navigation"].reports(ErrorType::user_defined_error, "tired");
    EXPECT_TRUE(desk.notifications_closed());
    EXPECT_EQ(reached(world, "waiting_notifications"), 4U) << "and a session that had to end";
}

}  // namespace rois
