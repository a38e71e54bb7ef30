// Decisions 18 to 21: the receivers of events, and the life of their details.
#include "engine/world.hpp"

namespace rois {

namespace {

ParameterList people(int number) { return {integer("number", number)}; }

struct Events : testing::Test {
    World world{detection, named("detection_2", detection), navigation};
    Application desk = world.connect();
};

}  // namespace

TEST_F(Events, MayBeChosenByTheirResults) {
    desk.subscribe("person_detected", both({equal("component_ref", "detection"), equal("number", "2")}));
    world["detection"].fires("person_detected", people(1));
    world["detection"].fires("person_detected");
    world["detection_2"].fires("person_detected", people(2));
    world["detection"].fires("person_detected", people(2));
    EXPECT_THAT(desk.received(), ElementsAre("1 person_detected detection"));
}

TEST_F(Events, MayBeSelectedByTheStatusThatTheSubscriberSees) {
    auto hall = world.connect();
    desk.bind("detection");
    desk.subscribe("person_detected", equal("status", "BUSY"));
    hall.subscribe("person_detected", equal("status", "BUSY"));
    world["detection"].fires("person_detected");
    EXPECT_THAT(desk.received(), IsEmpty());
    EXPECT_THAT(hall.received(), ElementsAre("1 person_detected detection"));
}

TEST_F(Events, ThatNoComponentHasAreUnsupported) {
    EXPECT_EQ(desk.subscribe("earthquake").return_code, ReturnCode::unsupported);
    EXPECT_THAT(desk.subscribe("earthquake").reason, HasSubstr("'earthquake'"));
    EXPECT_EQ(desk.subscribe("person_detected", equal("component_ref", "navigation")).return_code, ReturnCode::unsupported);
    EXPECT_EQ(desk.subscribe("person_detected", equal("is_final_target", "true")).return_code, ReturnCode::bad_parameter)
        << "that is a result of another event";
    EXPECT_EQ(desk.subscribe("person_detected", not_understood("what is this")).reason, "what is this");
}

TEST(ManySubscriptions, HaveTenThousandPredicatesASession) {
    EngineSettings settings;
    settings.max_subscribed_predicates = 3;
    World world{{detection}, settings};
    auto desk = world.connect(), hall = world.connect();
    auto const answer = [](Application& application, std::vector<std::string> const& names) {
        std::vector<Condition> each;
        for (auto const& name : names) each.push_back(equal("name", name));
        return application.subscribe("person_detected", either(std::move(each)));
    };
    auto const one = answer(desk, {"detection"});
    EXPECT_EQ(answer(desk, {"detection", "a"}).return_code, ReturnCode::out_of_resources);
    auto const two = desk.subscribe("person_detected", both({equal("name", "detection"), equal("bound", "false")}));
    EXPECT_EQ(two.return_code, ReturnCode::out_of_resources) << "the And counts, too";
    EXPECT_EQ(two.reason,
              "the conditions of a session's subscriptions may have at most 3 predicates in total: unsubscribe from events that "
              "you do not need");
    EXPECT_EQ(desk.subscribe("person_detected").return_code, ReturnCode::ok) << "without a condition there are no predicates";
    EXPECT_EQ(answer(desk, {"detection"}).subscribe_id, one.subscribe_id) << "an existing subscription costs nothing";
    EXPECT_EQ(answer(hall, {"detection", "a"}).return_code, ReturnCode::ok) << "each session has its own limit";
    desk.unsubscribe(one.subscribe_id);
    EXPECT_EQ(answer(desk, {"detection", "a"}).return_code, ReturnCode::ok);
}

// Deleting very many at once would delay others.
TEST(ManySubscriptions, OfASessionThatEndsAreDeletedInSeveralTicks) {
    World world{{detection}};
    auto desk = world.connect(), hall = world.connect();
    auto const or_detection = [](int i) { return either({equal("name", std::to_string(i)), equal("name", "detection")}); };
    for (int i = 0; i < 3'000; ++i) {
        if (i % 500 == 0) world.advance(std::chrono::milliseconds{100});  // a journal stores only so many at once
        desk.subscribe("person_detected", or_detection(i));
    }
    desk.ask(Disconnect{});
    EXPECT_GT(world.engine->statistics().subscriptions, 1'000U);
    for (int const i : {0, 2'999}) hall.subscribe("person_detected", or_detection(i));
    world["detection"].reports(ErrorType::component_internal_error, "of interest to those that have subscribed");
    world["detection"].fires("person_detected");
    EXPECT_THAT(hall.received(), ElementsAre("1 COMPONENT_INTERNAL_ERROR detection", "2 person_detected detection",
                                             "3 person_detected detection"));
    world.advance(std::chrono::seconds{1});
    EXPECT_EQ(world.engine->statistics().subscriptions, 2U);
    world["detection"].fires("person_detected");
    EXPECT_THAT(hall.received(), ElementsAre("4 person_detected detection", "5 person_detected detection"));
}

TEST_F(Events, OfTwoSubscriptionsAreReceivedForEachWithOneEventId) {
    auto const all = desk.subscribe("person_detected").subscribe_id;
    auto const one = desk.subscribe("person_detected", equal("component_ref", "detection")).subscribe_id;
    world["detection"].fires("person_detected");
    desk.received(1);
    auto const first = desk.last_received<ReceiveEvent>();
    desk.received(1);
    auto const second = desk.last_received<ReceiveEvent>();
    EXPECT_EQ(first.event_id, second.event_id);
    EXPECT_THAT((std::vector{first.subscribe_id, second.subscribe_id}), testing::UnorderedElementsAre(all, one));
}

TEST_F(Events, AreReceivedByTheRemainingSubscribers) {
    std::vector<Application> applications;
    for (int i = 0; i < 7; ++i) applications.push_back(world.connect());
    SubscribeId id;
    for (std::size_t const i : {4U, 1U, 6U, 0U, 3U, 5U, 2U}) id = applications[i].subscribe("person_detected").subscribe_id;
    for (std::size_t const i : {0U, 6U, 3U}) EXPECT_EQ(applications[i].unsubscribe(id), ReturnCode::ok);
    applications[5].ask(Disconnect{});
    applications[3].subscribe("person_detected");
    world["detection"].fires("person_detected");
    for (std::size_t const i : {1U, 2U, 3U, 4U})
        EXPECT_THAT(applications[i].received(), ElementsAre("1 person_detected detection")) << i;
    for (std::size_t const i : {0U, 6U}) EXPECT_THAT(applications[i].received(), IsEmpty()) << i;
}

TEST_F(Events, AreOneNotificationForAllSessionsOfASubscription) {
    auto hall = world.connect();
    desk.subscribe("person_detected");
    hall.subscribe("person_detected");
    world["detection"].fires("person_detected");
    EXPECT_EQ(desk.notifications().read(0, 1).front().notification, hall.notifications().read(0, 1).front().notification);
}

TEST_F(Events, ThatNeverWereHaveNoDetails) {
    desk.subscribe("person_detected");
    world["detection"].fires("person_detected");
    for (auto const* id : {"", "e-", "e-0", "e-2", "e-01", "e-1x", "e-99999999999999999999", "x-1", "1"}) {
        auto const reply = desk.detail_of(EventId{id});
        EXPECT_EQ(reply.return_code, ReturnCode::bad_parameter) << id;
        EXPECT_THAT(reply.reason, HasSubstr("unknown event_id")) << id;
    }
}

TEST_F(Events, HaveDetailsThatAConditionChoosesFrom) {
    desk.subscribe("person_detected");
    world["detection"].fires("person_detected", people(2));
    desk.received();
    auto const id = desk.last_received<ReceiveEvent>().event_id;
    EXPECT_EQ(in_words(desk.detail_of(id, equal("number", "2")).results.parameters), "number=2");
    auto const none = desk.detail_of(id, equal("number", "3"));
    EXPECT_EQ(none.return_code, ReturnCode::ok);
    EXPECT_THAT(none.results.parameters, IsEmpty());
    EXPECT_EQ(desk.detail_of(id, equal("colour", "red")).return_code, ReturnCode::bad_parameter);
    EXPECT_EQ(desk.detail_of(id, equal("timestamp", "2026-11-20T12:00:00Z")).return_code, ReturnCode::ok)
        << "it is an id of the right form";
}

TEST_F(Events, WithoutSubscribersAreNotKept) {
    world["detection"].fires("person_detected", people(1));
    desk.subscribe("person_detected");
    world["detection"].fires("person_detected", people(2));
    desk.received();
    EXPECT_EQ(desk.last_received<ReceiveEvent>().event_id.text, "e-1");
    EXPECT_EQ(world.engine->statistics().events, 2U);
}

}  // namespace rois
