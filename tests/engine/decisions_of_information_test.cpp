// Decisions 18 to 28 by number, as far as they concern the engine: queries, events, notifications, errors, values.
#include "engine/conditions/conditions.hpp"
#include "engine/world.hpp"

namespace rois {

namespace {

ParameterList people(int number) { return {integer("number", number)}; }

}  // namespace

TEST(Decision18, TheConditionSelectsTheComponentThatAnswers) {
    World world{named("robot_b", navigation), named("robot_a", navigation), in_engine("sub1", named("robot_c", navigation)),
                speech};
    auto desk = world.connect(), hall = world.connect();
    EXPECT_EQ(desk.query("route").component_ref.code, "robot_a") << "READY, then the lowest code within its engine";
    hall.bind("robot_a");
    EXPECT_EQ(desk.query("route").component_ref.code, "robot_b");
    desk.bind("sub1.robot_c");
    EXPECT_EQ(desk.query("route").component_ref.code, "sub1.robot_c") << "the robot that the session works with";
    desk.release("sub1.robot_c");
    EXPECT_EQ(desk.query("route", equal("engine", "sub1")).component_ref.code, "sub1.robot_c");
    EXPECT_EQ(desk.query("weather").return_code, ReturnCode::unsupported);
    EXPECT_EQ(desk.query("route", equal("component_ref", "speech")).return_code, ReturnCode::unsupported);
    EXPECT_EQ(in_words(desk.query("get_parameter", equal("name", "speech")).results.parameters),
              "synthesizable_languages=en|ja volume=50 language=en")
        << "parameters are read without a binding";
    desk.subscribe("reached_target");
    for (auto const* ref : {"robot_a", "sub1.robot_c"}) world[ref].fires("reached_target");
    EXPECT_THAT(desk.received(), ElementsAre("1 reached_target robot_a", "2 reached_target sub1.robot_c"))
        << "without a condition, all are received";
    EXPECT_EQ(desk.subscribe("earthquake").return_code, ReturnCode::unsupported);
}

TEST(Decision19, OnlyMatchingEventsAndResultsAreReported) {
    World world{detection, localization, navigation};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.subscribe("person_detected", greater("number", "0"), true);
    for (int number : {0, 2, 0}) world["detection"].fires("person_detected", people(number));
    EXPECT_THAT(desk.received(), ElementsAre("1 person_detected detection number=2"));
    auto const event = desk.last_received<ReceiveEvent>().event_id;
    EXPECT_EQ(in_words(desk.detail_of(event, greater("number", "1")).results.parameters), "number=2");
    EXPECT_THAT(desk.detail_of(event, greater("number", "2")).results.parameters, IsEmpty());
    desk.subscribe("person_localized", within("position_data", {box(0, 0, 1'000, 1'000)}));
    for (auto const* point : {"5000, 0, 0", "500, 500, 90"})
        world["localization"].fires("person_localized", {texts("position_data", {point})});
    EXPECT_THAT(desk.received(), ElementsAre("2 person_localized localization"));
    desk.execute(named("stop", stop("navigation")));
    EXPECT_EQ(desk.result_of("stop", equal("status", "OK")), "OK");
    EXPECT_EQ(desk.result_of("stop", equal("status", "ERROR")), "");
    world["navigation"].reports(ErrorType::user_defined_error, "a wheel is stuck");
    desk.received();
    auto const error = desk.last_received<ReceiveError>().error_id;
    EXPECT_THAT(desk.detail_of(error, like("text", "*wheel*")).results.parameters, testing::SizeIs(3));
    EXPECT_THAT(desk.detail_of(error, like("text", "*voice*")).results.parameters, IsEmpty());
}

TEST(Decision20, EqualSubscriptionsAreOne) {
    World world{detection};
    auto desk = world.connect(), hall = world.connect();
    auto const a = equal("component_ref", "detection"), b = greater("number", "0");
    auto const id = desk.subscribe("person_detected", both({a, b})).subscribe_id;
    EXPECT_EQ(desk.subscribe("person_detected", both({b, a}), true).subscribe_id, id) << "the same after canonicalisation";
    world["detection"].fires("person_detected", people(1));
    EXPECT_THAT(desk.received(), ElementsAre("1 person_detected detection number=1"))
        << "received once, and the last inline_results wins";
    EXPECT_EQ(hall.subscribe("person_detected", both({a, b})).subscribe_id, id) << "an id names type and condition";
    EXPECT_EQ(desk.unsubscribe(id), ReturnCode::ok);
    world["detection"].fires("person_detected", people(1));
    EXPECT_THAT(desk.received(), IsEmpty());
    EXPECT_THAT(hall.received(), ElementsAre("1 person_detected detection"));
    EXPECT_EQ(desk.unsubscribe(id), ReturnCode::ok);
    EXPECT_EQ(desk.unsubscribe({"made-up"}), ReturnCode::ok);
}

TEST(Decision21, DetailsAreKeptUntilTheyExpire) {
    World world{detection};
    auto desk = world.connect(), hall = world.connect();
    desk.subscribe("person_detected");
    hall.subscribe("person_detected", {}, true);
    world["detection"].fires("person_detected", people(2));
    EXPECT_THAT(hall.received(), ElementsAre("1 person_detected detection number=2")) << "this saves the round trip";
    EXPECT_THAT(desk.received(), ElementsAre("1 person_detected detection"));
    auto const event = desk.last_received<ReceiveEvent>();
    EXPECT_EQ(event.expire, world.now.utc + 60s);
    world.advance(59'950ms);
    EXPECT_EQ(in_words(desk.detail_of(event.event_id).results.parameters), "number=2");
    world.advance(50ms);
    EXPECT_EQ(desk.detail_of(event.event_id).return_code, ReturnCode::bad_parameter);
    EXPECT_THAT(desk.detail_of(event.event_id).reason, HasSubstr("expired"));
}

// Also for the details that are kept already.
TEST(Decision21, TheTimeOfDetailsCanChange) {
    World world{detection, navigation};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.subscribe("person_detected");
    world["detection"].fires("person_detected", people(2));
    desk.received();
    auto const event = desk.last_received<ReceiveEvent>().event_id;
    world["navigation"].reports(ErrorType::component_internal_error, "no way");
    desk.received();
    auto const error = desk.last_received<ReceiveError>().error_id;
    world.engine->use({.event_details = 20s, .error_details = 30s});
    world.advance(19'950ms);
    EXPECT_EQ(desk.detail_of(event).return_code, ReturnCode::ok);
    world.advance(50ms);
    EXPECT_THAT(desk.detail_of(event).reason, HasSubstr("expired"));
    EXPECT_EQ(desk.detail_of(error).return_code, ReturnCode::ok);
    world.engine->use({.event_details = 20s, .error_details = 40s});
    world.advance(15s);
    EXPECT_EQ(desk.detail_of(error).return_code, ReturnCode::ok);
    world.advance(5s);
    EXPECT_THAT(desk.detail_of(error).reason, HasSubstr("expired"));
}

TEST(Decision22, NotificationsAreNumberedAsThingsHappen) {
    World world{detection, navigation};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.subscribe("person_detected");
    auto const answer = desk.notifications().hold();
    desk.execute(named("a", stop("navigation")), go("b"));
    EXPECT_THAT(desk.received(), IsEmpty()) << "the answer comes before the notifications that it causes";
    desk.answered(answer);
    world["detection"].fires("person_detected");
    world["navigation"].finishes();
    world["navigation"].reports(ErrorType::user_defined_error, "tired");
    EXPECT_THAT(desk.received(), ElementsAre("1 completed a OK", "2 person_detected detection", "3 completed b OK",
                                             "4 USER_DEFINED_ERROR navigation"));
}

TEST(Decision22, WhatAComponentReportsComesAfterTheAnswerToItsCommand) {
    World world{detection, navigation};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.subscribe("reached_target");
    desk.subscribe("person_detected");
    auto const answer = desk.notifications().hold();
    desk.execute(named("a", stop("navigation")));
    desk.notifications().leave(answer);
    desk.answer_is_late(answer);
    world["navigation"].fires("reached_target");
    world["navigation"].reports(ErrorType::user_defined_error, "tired");
    world["detection"].fires("person_detected");
    EXPECT_THAT(desk.received(), ElementsAre("1 person_detected detection")) << "other components do not wait for it";
    desk.answered(answer);
    EXPECT_THAT(desk.received(),
                ElementsAre("2 completed a OK", "3 reached_target navigation", "4 USER_DEFINED_ERROR navigation"));
    world["navigation"].fires("reached_target");
    EXPECT_THAT(desk.received(), ElementsAre("5 reached_target navigation"));
}

TEST(Decision23, EventsAreDroppedAndOtherNotificationsAreNot) {
    EngineSettings settings;
    settings.max_waiting_notifications = 4;
    settings.max_sent_notifications = 4;
    World world{{detection, navigation}, settings};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.subscribe("person_detected");
    desk.execute(named("a", stop("navigation")));
    for (int i = 0; i < 6; ++i) world["detection"].fires("person_detected");
    EXPECT_THAT(desk.received(), ElementsAre("1 completed a OK", "4 lost 3", "5 person_detected detection",
                                             "6 person_detected detection", "7 person_detected detection"));
    EXPECT_EQ(desk.notifications().read(4, 100).size(), 3U) << "reading discards nothing";
    EXPECT_EQ(world.engine->statistics().notifications_lost, 3U);
    for (auto const* id : {"1", "2", "3", "4"}) desk.execute(named(id, stop("navigation")));
    EXPECT_FALSE(desk.notifications_closed());
    desk.execute(named("5", stop("navigation")));
    EXPECT_TRUE(desk.notifications_closed()) << "other notifications fill the queue";
    EXPECT_EQ(desk.received().size(), 5U) << "and all are received";
}

TEST(Decision24, ErrorsGoToTheSessionsThatTheyConcern) {
    struct Floor : Device {
        void advance(Instant) override { throw std::runtime_error("the floor is gone"); }
    };
    World world{navigation, speech};
    auto bound = world.connect(), subscribed = world.connect(), other = world.connect();
    bound.bind("navigation");
    subscribed.subscribe("reached_target");
    other.bind("speech");
    world["navigation"].reports(ErrorType::user_defined_error, "a wheel is stuck");
    EXPECT_THAT(bound.received(), ElementsAre("1 USER_DEFINED_ERROR navigation"));
    EXPECT_THAT(subscribed.received(), ElementsAre("1 USER_DEFINED_ERROR navigation"));
    EXPECT_THAT(other.received(), IsEmpty());
    auto const id = bound.last_received<ReceiveError>().error_id;
    EXPECT_EQ(in_words(bound.detail_of(id).results.parameters),
              "component_ref=navigation time=" + to_text(world.now.utc) + " text=a wheel is stuck");
    world.advance(10min - 50ms);
    EXPECT_EQ(bound.detail_of(id).return_code, ReturnCode::ok);
    world.advance(50ms);
    EXPECT_EQ(bound.detail_of(id).return_code, ReturnCode::bad_parameter);
    world.engine->add(std::make_shared<Floor>());
    world.advance(50ms);
    for (auto* each : {&bound, &subscribed, &other}) EXPECT_THAT(each->received().back(), HasSubstr("ENGINE_INTERNAL_ERROR"));
}

TEST(Decision24, DetailsOfAnEventAreForSessionsThatWereNotifiedOfIt) {
    World world{detection};
    auto desk = world.connect(), other = world.connect(), choosy = world.connect();
    desk.subscribe("person_detected");
    choosy.subscribe("person_detected", greater("number", "5"));
    world["detection"].fires("person_detected", people(2));
    EXPECT_THAT(desk.received(), ElementsAre("1 person_detected detection"));
    auto const id = desk.last_received<ReceiveEvent>().event_id;
    other.subscribe("person_detected");
    auto later = world.connect();
    EXPECT_EQ(desk.detail_of(id).return_code, ReturnCode::ok);
    auto const expect_unknown = [&](Application& asker) {
        EXPECT_EQ(asker.detail_of(id).return_code, ReturnCode::bad_parameter);
        EXPECT_EQ(asker.detail_of(id).reason, "unknown event_id '" + id.text + "'");
    };
    for (auto* each : {&other, &choosy, &later}) expect_unknown(*each);
    world.advance(60s);
    EXPECT_THAT(desk.detail_of(id).reason, HasSubstr("expired"));
    for (auto* each : {&other, &choosy, &later}) expect_unknown(*each);
    world.advance(10min);
    EXPECT_THAT(desk.detail_of(id).reason, HasSubstr("expired"));
    expect_unknown(later);
}

TEST(Decision24, DetailsOfAnErrorAreForSessionsThatWereNotifiedOfIt) {
    World world{navigation};
    auto desk = world.connect(), other = world.connect();
    desk.bind("navigation");
    world["navigation"].reports(ErrorType::user_defined_error, "a wheel is stuck");
    EXPECT_THAT(desk.received(), ElementsAre("1 USER_DEFINED_ERROR navigation"));
    auto const id = desk.last_received<ReceiveError>().error_id;
    EXPECT_EQ(desk.detail_of(id).return_code, ReturnCode::ok);
    EXPECT_EQ(other.detail_of(id).return_code, ReturnCode::bad_parameter);
    EXPECT_EQ(other.detail_of(id).reason, "unknown error_id '" + id.text + "'");
}

TEST(Decision24, DetailsDoNotPassToTheNextSession) {
    World world{detection};
    auto desk = world.connect();
    desk.subscribe("person_detected");
    world["detection"].fires("person_detected", people(2));
    desk.received();
    auto const id = desk.last_received<ReceiveEvent>().event_id;
    desk.leave();
    auto next = world.connect();
    EXPECT_EQ(next.detail_of(id).return_code, ReturnCode::bad_parameter) << "although it has the slot of the session that ended";
    next.subscribe("person_detected");
    world["detection"].fires("person_detected", people(3));
    next.received();
    EXPECT_EQ(next.detail_of(next.last_received<ReceiveEvent>().event_id).return_code, ReturnCode::ok);
}

TEST(Decision25, ComponentsHaveNamesAndTypes) {
    World world{navigation, in_engine("sub1", navigation)};
    auto desk = world.connect();
    auto const found = desk.ask(Search{equal("component_type", "URN:X-ROIS:DEF:COMPONENT:omg::navigation")}).component_ref_list;
    ASSERT_EQ(found.size(), 2U) << "types are not case-sensitive";
    EXPECT_EQ(found[0], (Identifier{"navigation", "OMG", {}, {}}));
    EXPECT_EQ(found[1].code, "sub1.navigation") << "with the name of its sub engine";
    EXPECT_THROW((World{navigation, navigation}), std::runtime_error) << "refs are unique";
}

TEST(Decision26, ValuesAreOfTheirDeclaredTypes) {
    World world{desk_lamp};
    auto desk = world.connect();
    desk.bind("lamp");
    auto const set = [&](Parameter parameter) {
        auto const reply = desk.set_parameter("lamp", {std::move(parameter)});
        return reply.return_code == ReturnCode::ok ? std::string{"OK"} : reply.reason;
    };
    EXPECT_EQ(in_words(desk.get_parameter("lamp").parameters), "counts=1 2 labels=red|green") << "unset ones are left out";
    for (auto const& good :
         {value("count", "int", {"7"}), value("Count", "URN:x-rois:def:DataType:ATR::Integer", {"8"}),
          value("ratio", "double", {"0.5"}), value("lit", "bool", {"true"}), value("since", "DateTime", {"2026-11-20T12:00:00Z"}),
          value("owner", "RoISIdentifier", {"tanaka"}), value("counts", "int[]", {"1 2 3"}),
          value("labels", "String[]", {"one", "two words"}), value("owners", "RoISIdentifier[]", {}),
          value("grammer", "string", {"yes | no"}), value("shade", "shade", {"anything"})})
        EXPECT_EQ(set(good), "OK") << good.name;
    EXPECT_NE(find(desk.get_parameter("lamp").parameters, "grammar"), nullptr) << "in the correct spelling";
    EXPECT_EQ(set(value("count", "int", {"2147483648"})), "parameter 'count': '2147483648' is not of the type int");
    EXPECT_THAT(set(value("count", "string", {"7"})), HasSubstr("'count' is declared as 'string', its type is int"));
    EXPECT_THAT(set(value("count", "int", {"1", "2"})), HasSubstr("'count': the type int needs exactly one value, got 2"));
    EXPECT_THAT(set(value("colour", "string", {"red"})), HasSubstr("unknown parameter 'colour'"));
}

TEST(Decision26, PublishedSpellingsAreAcceptedAndReturnedInTheEnginesSpelling) {
    World world{navigation, speech};
    auto desk = world.connect();
    desk.bind("navigation");
    desk.bind("speech");
    EXPECT_EQ(desk.set_parameter("navigation", {texts("target_positions", {"1, 2, 3"})}).return_code, ReturnCode::ok);
    EXPECT_EQ(find(desk.get_parameter("navigation").parameters, "target_positions"), nullptr);
    auto const stored = desk.get_parameter("navigation").parameters;
    ASSERT_NE(find(stored, "target_position"), nullptr);
    EXPECT_THAT(find(stored, "target_position")->values, ElementsAre("1, 2, 3"));
    EXPECT_EQ(desk.set_parameter("speech", {text("ssml_text", "<speak/>")}).return_code, ReturnCode::ok);
    EXPECT_NE(find(desk.get_parameter("speech").parameters, "SSML_text"), nullptr);
}

TEST(Decision28, TimesAreUtc) {
    World world{detection, navigation};
    auto desk = world.connect();
    desk.bind("navigation");
    world["navigation"].reports(ErrorType::user_defined_error, "tired");
    desk.received();
    auto const detail = desk.detail_of(desk.last_received<ReceiveError>().error_id);
    EXPECT_THAT(find(detail.results.parameters, "time")->values, ElementsAre("2026-11-20T12:00:00.000Z"));
}

TEST(Decision30, ParametersBelongToTheBinding) {
    World world{speech};
    auto desk = world.connect(), hall = world.connect();
    auto const read = [&](Application& who) { return in_words(who.query("get_parameter").results.parameters); };
    std::string const defaults = "synthesizable_languages=en|ja volume=50 language=en";
    desk.bind("speech");
    desk.set_parameter("speech", {text("speech_text", "hello"), integer("volume", 10)});
    EXPECT_EQ(read(desk), "synthesizable_languages=en|ja speech_text=hello volume=10 language=en");
    EXPECT_EQ(read(hall), defaults) << "read-only parameters, and the defaults";
    EXPECT_THAT(hall.search(equal("Property/speech_text", "hello")), IsEmpty());
    desk.leave();
    hall.bind("speech");
    EXPECT_EQ(read(hall), defaults);
    EXPECT_EQ(in_words(world["speech"].changed_to), "volume=50 language=en") << "the component has the defaults, too";
    EXPECT_EQ(hall.execute(start("speech")).return_code, ReturnCode::bad_parameter) << "the text is gone";
}

TEST(Decision32, EachRobotIsAnEngineAndTheMainEngineIsTheWhole) {
    World world{in_engine("robot1", navigation), in_engine("robot2", navigation), in_engine("robot2", speech), detection};
    auto desk = world.connect();
    EXPECT_THAT(desk.search(equal("engine", "robot1")), ElementsAre("robot1.navigation"));
    EXPECT_THAT(desk.search(equal("engine", "robot2")), ElementsAre("robot2.navigation", "robot2.speech"));
    EXPECT_EQ(desk.search(like("engine", "*")).size(), 4U);
    for (auto const& whole : {equal("engine", ""), equal("engine", "main"), equal_reversed("main", "engine")}) {
        EXPECT_EQ(desk.search(whole).size(), 4U);
        EXPECT_EQ(desk.ask(GetProfile{whole}).profile->object.name, "main");
        EXPECT_EQ(desk.bind_any(both({whole, equal("component_type", speech.profile.object.identifier)})), "robot2.speech");
        desk.release("robot2.speech");
        EXPECT_EQ(desk.subscribe("reached_target", whole).subscribe_id.text, desk.subscribe("reached_target").subscribe_id.text);
    }
    EXPECT_THAT(desk.search(not_equal("engine", "main")), IsEmpty()) << "all components belong to the main engine";
    EXPECT_THAT(desk.search(not_equal("engine", "robot2")), ElementsAre("detection", "robot1.navigation"));
    auto const profile = [&](QueryExpression condition) { return desk.ask(GetProfile{std::move(condition)}).profile; };
    EXPECT_EQ(profile(equal("engine", "robot1"))->components, std::vector<std::string>{"robot1.navigation"});
    EXPECT_EQ(profile({})->components, std::vector<std::string>{"detection"}) << "components without a robot";
    EXPECT_EQ(profile({})->sub_profiles.size(), 2U);
}

}  // namespace rois
