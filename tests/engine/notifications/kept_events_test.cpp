// Events that no session has received, in an engine that keeps them for a later subscription.
#include "engine/world.hpp"

namespace rois {

namespace {

struct KeptEventsOfAnEngine : testing::Test {
    static EngineSettings keeping(std::size_t most) {
        EngineSettings settings;
        settings.max_kept_events = most;
        return settings;
    }

    void detect(int number) { world["detection"].fires("person_detected", {integer("number", number)}); }

    // Subscribes with results in the events.
    static void subscribe(Application& application, QueryExpression condition = {}) {
        EXPECT_EQ(application.subscribe("person_detected", std::move(condition), true).return_code, ReturnCode::ok);
    }

    // The results of all events that the session has received.
    static std::vector<std::string> received(Application& application) {
        std::vector<std::string> all;
        for (auto const& entry : application.notifications().read(0, 100))
            if (auto const* event = std::get_if<ReceiveEvent>(&entry.notification->body))
                all.push_back(in_words(event->results->parameters));
        return all;
    }

    void lose_link_of(Application const& application) {
        world.engine->link_closed(application.session, LinkKind::websocket, Closing::lost, world.now);
    }

    World world{{detection, navigation}, keeping(3)};
};

}  // namespace

TEST_F(KeptEventsOfAnEngine, AreReceivedByTheNextSubscriptionThatMatches) {
    for (int const number : {1, 2, 3, 4}) detect(number);
    auto desk = world.connect(), hall = world.connect();
    subscribe(desk, equal("number", "3"));
    EXPECT_THAT(received(desk), ElementsAre("number=3"));
    subscribe(hall);
    EXPECT_THAT(received(hall), ElementsAre("number=2", "number=4")) << "of the last three";
    EXPECT_EQ(world.engine->statistics().events, 4U);
    subscribe(desk);
    EXPECT_THAT(received(desk), ElementsAre("number=3")) << "each is received once";
}

TEST_F(KeptEventsOfAnEngine, AreDroppedWhenTheyExpire) {
    detect(1);
    world.advance(40s);
    detect(2);
    world.advance(40s);
    auto desk = world.connect();
    subscribe(desk);
    EXPECT_THAT(received(desk), ElementsAre("number=2"));
}

TEST_F(KeptEventsOfAnEngine, IncludeThoseThatALostSessionHasNotRead) {
    auto lost = world.connect();
    subscribe(lost);
    detect(1);
    EXPECT_THAT(received(lost), ElementsAre("number=1"));
    lose_link_of(lost);
    detect(2);
    world.advance(31s);
    ASSERT_TRUE(lost.notifications_closed());
    detect(3);
    auto desk = world.connect();
    subscribe(desk);
    EXPECT_THAT(received(desk), ElementsAre("number=2", "number=3"));
}

// It has asked how its commands have ended, and then ends the earlier session.
TEST_F(KeptEventsOfAnEngine, IncludeThoseThatARestartedEngineHasReadButNotPassedOn) {
    for (bool const goes_on : {false, true}) {
        auto engine = world.connect({.motion_lease = {}, .motion_lease_http = {}, .motion_proof = {}, .is_engine = true});
        subscribe(engine);
        detect(1);
        auto const last = received(engine);
        EXPECT_THAT(last, ElementsAre("number=1"));
        lose_link_of(engine);
        detect(2);
        engine.ask(Resume{engine.session, 0});
        EXPECT_THAT(received(engine), ElementsAre("number=1", "number=2"));
        if (goes_on) {
            detect(3);
            EXPECT_THAT(received(engine), ElementsAre("number=1", "number=2", "number=3"));
        }
        engine.ask(Disconnect{});
        auto desk = world.connect();
        subscribe(desk);
        if (goes_on)
            EXPECT_THAT(received(desk), IsEmpty());
        else
            EXPECT_THAT(received(desk), ElementsAre("number=2"));
        desk.ask(Disconnect{});
    }
}

TEST_F(KeptEventsOfAnEngine, AreReceivedOnceIfTheNextSessionBeginsBeforeTheLostOneEnds) {
    auto lost = world.connect();
    subscribe(lost);
    subscribe(lost, equal("component_ref", "detection"));
    lose_link_of(lost);
    detect(1);
    auto desk = world.connect();
    subscribe(desk);
    detect(2);
    EXPECT_THAT(received(desk), ElementsAre("number=2"));
    world.advance(31s);
    EXPECT_THAT(received(desk), ElementsAre("number=2", "number=1"));
}

TEST_F(KeptEventsOfAnEngine, DoNotIncludeThoseOfASessionWithALink) {
    auto desk = world.connect(), hall = world.connect();
    subscribe(desk);
    detect(1);
    desk.leave();
    subscribe(hall);
    EXPECT_THAT(received(desk), ElementsAre("number=1"));
    EXPECT_THAT(received(hall), IsEmpty());
}

}  // namespace rois
