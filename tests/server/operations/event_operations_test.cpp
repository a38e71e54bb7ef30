// Event interface (table 5): subscribe, unsubscribe, get_event_detail; and the event itself.
#include "server/conversation.hpp"

namespace rois::test {
namespace {

using testing::Contains;
using testing::Key;
using testing::Not;
using testing::Pair;

constexpr auto detected = "person_detected";

// In the empty hall, the first measurement after `start` reports zero people.
struct EventOperations : Conversation {
    EventOperations() { desk.bind("person_detection"); }

    void detect(Application& application) { application.execute(Command{.component = "person_detection"}); }
};
ROIS_OVER_BOTH_WAYS(EventOperations);

TEST_P(EventOperations, ASubscriberReceivesEvents) {
    auto const subscribed = desk.subscribe(detected);
    EXPECT_THAT(subscribed, IsOk());
    EXPECT_THAT(subscribed.children(), ElementsAre("subscribe_id"));
    detect(desk);
    auto const event = desk.hear_event(detected);
    EXPECT_EQ(event.name(), "receive_event");
    EXPECT_THAT(event.children(), ElementsAre("event_id", "event_type", "subscribe_id", "expire", "component_ref"));
    EXPECT_EQ(event.text("subscribe_id"), subscribed.text("subscribe_id"));
    EXPECT_EQ(event.ref(), "person_detection");
    EXPECT_THAT(event.text("expire"), testing::MatchesRegex("[0-9-]{10}T[0-9:.]{12}Z"));
}

TEST_P(EventOperations, ResultsComeWithTheEventWhenInline) {
    desk.subscribe(detected, "", true);
    detect(desk);
    auto const event = desk.hear_event(detected);
    EXPECT_THAT(event.children(), Contains("results"));
    EXPECT_THAT(event.values(), Contains(Pair("number", ElementsAre("0"))));
    EXPECT_THAT(event.values(), Contains(Key("timestamp")));
}

TEST_P(EventOperations, DetailsOfAnEvent) {
    desk.subscribe(detected);
    detect(desk);
    auto const id = desk.hear_event(detected).text("event_id");
    auto const answer = desk.get_event_detail(id);
    EXPECT_THAT(answer, IsOk());
    EXPECT_THAT(answer.children(), ElementsAre("results"));
    EXPECT_THAT(answer.values(), Contains(Pair("number", ElementsAre("0"))));
    EXPECT_EQ(desk.get_event_detail(id, where(equal("number", "0"))).values(), answer.values());
    auto const none = desk.get_event_detail(id, where(literal_first("3", "number")));
    EXPECT_THAT(none, IsOk());
    EXPECT_THAT(none.values(), IsEmpty());
    EXPECT_THAT(desk.get_event_detail(id, where(equal("colour", "red"))), IsRefused("BAD_PARAMETER", "colour"));
    EXPECT_THAT(desk.get_event_detail(id, where(undefined_function("number"))), IsRefused("BAD_PARAMETER", "is_free"));
}

TEST_P(EventOperations, DetailsOfAnUnknownEvent) {
    EXPECT_THAT(desk.get_event_detail("nobody"), IsRefused("BAD_PARAMETER", "unknown"));
}

TEST_P(EventOperations, DetailsExpire) {
    GatewayProcess forgetful{{"--event-details", "0.1"}};
    Application application{GetParam(), forgetful};
    application.connect();
    application.bind("person_detection");
    application.subscribe(detected);
    detect(application);
    auto const id = application.hear_event(detected).text("event_id");
    auto answer = application.get_event_detail(id);
    while (answer.return_code() == "OK") answer = application.get_event_detail(id);
    EXPECT_THAT(answer, IsRefused("BAD_PARAMETER", "expired"));
}

TEST_P(EventOperations, SubscribingAgainIsTheSameSubscription) {
    auto const id = desk.subscribe(detected).text("subscribe_id");
    auto const again = desk.subscribe(detected, "", true);
    EXPECT_THAT(again, IsOk());
    EXPECT_EQ(again.text("subscribe_id"), id);
    detect(desk);
    EXPECT_THAT(desk.hear_event(detected).children(), Contains("results")) << "the last inline_results wins";
    desk.execute({.component = "person_detection", .type = "stop", .id = "stop"});
    EXPECT_EQ(desk.status_of("stop"), "OK");
    EXPECT_THAT(lines(desk.history()),
                testing::UnorderedElementsAre(testing::StartsWith("completed c-"), detected, "completed stop OK"))
        << "heard once";
}

TEST_P(EventOperations, OperandsInAnotherOrderAreTheSameCondition) {
    auto const one = equal("component_ref", "person_detection");
    auto const other = equal("number", "0");
    auto const id = desk.subscribe(detected, where(both(one, other))).text("subscribe_id");
    EXPECT_EQ(desk.subscribe(detected, where(both(literal_first("0", "number"), one))).text("subscribe_id"), id);
    EXPECT_NE(desk.subscribe(detected, where(one)).text("subscribe_id"), id);
}

TEST_P(EventOperations, OnlyEventsThatSatisfyTheConditionAreReceived) {
    desk.subscribe(detected, where(equal("number", "5")));
    auto const right = desk.subscribe(detected, where(equal("number", "0"))).text("subscribe_id");
    detect(desk);
    EXPECT_EQ(desk.hear_event(detected).text("subscribe_id"), right);
    desk.execute({.component = "person_detection", .type = "stop", .id = "stop"});
    desk.status_of("stop");
    EXPECT_THAT(lines(desk.history()),
                testing::UnorderedElementsAre(testing::StartsWith("completed c-"), detected, "completed stop OK"));
}

TEST_P(EventOperations, DetailsAreOnlyForNotifiedSessions) {
    Application other{GetParam(), empty_hall()};
    other.connect();
    desk.subscribe(detected);
    detect(desk);
    auto const id = desk.hear_event(detected).text("event_id");
    EXPECT_THAT(desk.get_event_detail(id), IsOk());
    other.subscribe(detected);
    EXPECT_THAT(other.get_event_detail(id), IsRefused("BAD_PARAMETER", "unknown event_id '" + id + "'"));
}

TEST_P(EventOperations, SubscribeToAnUnknownEventTypeIsUnsupported) {
    EXPECT_THAT(desk.subscribe("dinner_ready"), IsRefused("UNSUPPORTED", "dinner_ready"));
    EXPECT_THAT(desk.subscribe(detected, where(equal("component_ref", "navigation"))), IsRefused("UNSUPPORTED", "match"));
}

TEST_P(EventOperations, SubscribeRefusesAnInvalidCondition) {
    EXPECT_THAT(desk.subscribe(detected, where(undefined_function("number"))), IsRefused("BAD_PARAMETER", "is_free"));
    EXPECT_THAT(desk.subscribe(detected, where(equal("colour", "red"))), IsRefused("BAD_PARAMETER", "colour"));
}

TEST_P(EventOperations, NoEventIsReceivedAfterUnsubscribe) {
    auto const id = desk.subscribe(detected).text("subscribe_id");
    auto const answer = desk.unsubscribe(id);
    EXPECT_THAT(answer, IsOk());
    EXPECT_THAT(answer.children(), IsEmpty());
    Application witness{GetParam(), empty_hall()};
    witness.connect();
    witness.subscribe(detected);
    detect(desk);
    witness.hear_event(detected);
    desk.execute({.component = "person_detection", .type = "stop", .id = "stop"});
    desk.status_of("stop");
    EXPECT_THAT(lines(desk.history()), Not(Contains(detected)));
}

TEST_P(EventOperations, UnsubscribeOfAnUnknownOrEndedSubscriptionIsOk) {
    auto const id = desk.subscribe(detected).text("subscribe_id");
    desk.unsubscribe(id);
    EXPECT_THAT(desk.unsubscribe(id), IsOk());
    EXPECT_THAT(desk.unsubscribe("nobody"), IsOk());
}

}  // namespace
}  // namespace rois::test
