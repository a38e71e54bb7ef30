// Subscriptions of an engine with a journal (docs/journal.md).
#include "engine/journaled.hpp"

namespace rois {

namespace {

TEST_F(Journaled, ASubscriptionOfAnAbsentComponentCanBeEnded) {
    auto desk = world.connect();
    auto const id = desk.subscribe("reached_target").subscribe_id;
    auto resumed = die_and_resume(desk, {speech});
    EXPECT_EQ(resumed.unsubscribe(id), ReturnCode::ok);
    auto again = die_and_resume(resumed);
    world["navigation"].fires("reached_target");
    EXPECT_THAT(again.received(), IsEmpty());
}

TEST_F(Journaled, ASubscriptionThatIsRepeatedIsStoredOnce) {
    auto desk = world.connect();
    desk.subscribe("reached_target");
    auto const steps = journal().steps;
    desk.subscribe("reached_target");
    EXPECT_EQ(journal().steps, steps);
    desk.ask(Subscribe{"reached_target", {}, true});
    EXPECT_EQ(journal().steps, steps + 1) << "it has changed";
}

TEST_F(Journaled, ASubscriptionThatIsRepeatedAndEndsWhileTheDiskIsFullDoesNotReturn) {
    auto desk = world.connect();
    auto const stored = desk.subscribe("reached_target");
    journal().then = MemoryJournal::Then::not_stored;
    EXPECT_EQ(desk.subscribe("reached_target").subscribe_id, stored.subscribe_id);
    world.advance(300ms);
    EXPECT_EQ(desk.subscribe("reached_target").subscribe_id, stored.subscribe_id);
    EXPECT_EQ(desk.unsubscribe(stored.subscribe_id), ReturnCode::ok);
    journal().then = MemoryJournal::Then::stored;
    world.advance(300ms);
    auto resumed = die_and_resume(desk);
    world["navigation"].fires("reached_target");
    EXPECT_THAT(resumed.received(), IsEmpty());
}

TEST_F(Journaled, SubscriptionsWithOneConditionBelongToTheirSessions) {
    auto leaves = world.connect(), stays = world.connect();
    auto const id = leaves.subscribe("reached_target").subscribe_id;
    journal().then = MemoryJournal::Then::not_stored;
    EXPECT_EQ(stays.subscribe("reached_target").subscribe_id, id);
    world.advance(300ms);
    EXPECT_EQ(leaves.unsubscribe(id), ReturnCode::ok);
    world.advance(300ms);
    journal().then = MemoryJournal::Then::stored;
    world.advance(300ms);
    auto resumed = die_and_resume(stays);
    world["navigation"].fires("reached_target");
    EXPECT_THAT(resumed.received(), ElementsAre("1 reached_target navigation"));
    EXPECT_THAT((Application{world, leaves.session}.received()), IsEmpty());
}

}  // namespace

}  // namespace rois
