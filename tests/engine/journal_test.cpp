// What the engine stores, and how it continues after the process has died (docs/journal.md).
#include "engine/journaled.hpp"
#include "types/asking.hpp"

namespace rois {

namespace {

TEST_F(Journaled, ASessionReturnsWithItsBindingsSubscriptionsAndNotifications) {
    auto desk = world.connect();
    desk.bind("navigation");
    desk.subscribe("reached_target");
    world["navigation"].fires("reached_target");
    auto resumed = die_and_resume(desk);
    EXPECT_THAT(resumed.received(), ElementsAre("1 reached_target navigation"));
    EXPECT_EQ(resumed.bind("navigation"), ReturnCode::ok);
    EXPECT_EQ(world.connect().bind("navigation"), ReturnCode::out_of_resources);
    world["navigation"].stands_still();
    world["navigation"].fires("reached_target");
    EXPECT_THAT(resumed.received(), ElementsAre("2 reached_target navigation"));
}

TEST_F(Journaled, ParametersThatWereSetStaySet) {
    auto desk = world.connect();
    desk.bind("navigation");
    desk.set_parameter("navigation", {integer("time_limit", 7)});
    desk.execute(named("go", command("start", "navigation", {texts("target_position", {"1, 2, 3"})})));
    auto const set = in_words(desk.get_parameter("navigation").parameters);
    EXPECT_THAT(set, AllOf(HasSubstr("time_limit=7"), HasSubstr("target_position=1, 2, 3")));
    auto resumed = die_and_resume(desk);
    EXPECT_EQ(in_words(resumed.get_parameter("navigation").parameters), set);
    EXPECT_THAT(in_words(world["navigation"].changed_to), HasSubstr("time_limit=7")) << "the component must know them";
    resumed.release("navigation");
    EXPECT_THAT(in_words(world["navigation"].changed_to), HasSubstr("time_limit=0"));
    auto again = die_and_resume(resumed);
    again.bind("navigation");
    EXPECT_THAT(in_words(again.get_parameter("navigation").parameters), HasSubstr("time_limit=0"));
}

// The component has another profile now.
TEST_F(Journaled, ParametersThatTheComponentDoesNotAcceptAnyMoreAreDropped) {
    auto desk = world.connect();
    desk.bind("navigation");
    desk.set_parameter("navigation", {integer("time_limit", 7)});
    auto other = navigation;
    auto const is_limit = [](ParameterProfile const& each) { return each.name == "time_limit"; };
    for (auto& message : other.profile.messages) std::erase_if(message.arguments, is_limit);
    std::erase_if(other.profile.parameters, is_limit);
    auto resumed = die_and_resume(desk, {other, speech});
    EXPECT_EQ(in_words(resumed.get_parameter("navigation").parameters), "routing_policy=time");
}

TEST_F(Journaled, ACommandThatRanHasExactlyOneCompletionAndDoesNotRunAgain) {
    auto desk = world.connect();
    desk.bind("navigation");
    desk.execute(go("go"));
    auto resumed = die_and_resume(desk);
    EXPECT_THAT(resumed.received(), ElementsAre("1 completed go ABORT"));
    EXPECT_EQ(resumed.result_of("go"), "ABORT");
    EXPECT_EQ(resumed.reason_of("go"), "the gateway was restarted before the command ended");
    EXPECT_EQ(resumed.execute(go("go")).return_code, ReturnCode::bad_parameter) << "its id is in use";
    EXPECT_THAT(world["navigation"].calls, testing::Not(testing::Contains("start")));
    auto again = die_and_resume(resumed);
    EXPECT_THAT(again.received(), ElementsAre("1 completed go ABORT"));
}

TEST_F(Journaled, TheResultOfACommandThatHasEndedStays) {
    auto desk = world.connect();
    desk.bind("navigation");
    desk.execute(named("d", command("dock", "navigation")));
    world["navigation"].begins();
    world["navigation"].finishes(CompletedStatus::ok, {.parameters = {value("charge", "integer", {"80"})}, .located = {}});
    ASSERT_EQ(desk.result_of("d"), "OK charge=80");
    auto resumed = die_and_resume(desk);
    EXPECT_EQ(resumed.result_of("d"), "OK charge=80");
    EXPECT_THAT(resumed.received(), ElementsAre("1 completed d OK"));
    auto without = die_and_resume(resumed, {speech});
    EXPECT_EQ(without.result_of("d"), "OK charge=80") << "its component has not returned";
    EXPECT_THAT(without.execute(go("d")).reason, HasSubstr("'d' is in use"));
}

TEST_F(Journaled, TheIdOfACommandStaysInUseAlsoIfTheCalendarJumpsMeanwhile) {
    auto desk = world.connect();
    desk.bind("navigation");
    desk.execute(named("d", command("dock", "navigation")));
    world["navigation"].begins();
    world["navigation"].finishes(CompletedStatus::ok);
    for (auto const jump : {std::chrono::hours{24}, std::chrono::hours{-48}}) {
        world.now.utc += jump;
        auto resumed = die_and_resume(desk);
        EXPECT_EQ(resumed.result_of("d"), "OK") << jump.count();
        EXPECT_EQ(resumed.execute(go("d")).return_code, ReturnCode::bad_parameter) << jump.count();
    }
}

TEST_F(Journaled, ACommandBeginsWhenItIsStored) {
    auto desk = world.connect();
    desk.bind("navigation");
    journal().then = MemoryJournal::Then::later;
    auto const asked = world.begin_to_say(desk.session, Execute{{{go("go")}}});
    EXPECT_FALSE(asked->said);
    EXPECT_THAT(world["navigation"].calls, testing::Not(testing::Contains("start")));
    store();
    EXPECT_TRUE(asked->said);
    EXPECT_THAT(world["navigation"].calls, testing::Contains("start"));
}

TEST_F(Journaled, ACommandThatIsRefusedBecauseEverythingWasStoppedLeavesNoTrace) {
    auto desk = world.connect();
    desk.bind("navigation");
    journal().then = MemoryJournal::Then::later;
    auto const asked = world.begin_to_say(desk.session, Execute{{{named("stop", stop("navigation")), go("go")}}});
    world.engine->stop_everything(world.now);
    journal().then = MemoryJournal::Then::stored;
    store();
    world.advance(1s);
    EXPECT_EQ(std::get<Execute::Reply>(std::get<Reply>(asked->said.value())).return_code, ReturnCode::error);
    EXPECT_EQ(desk.ask(GetCommandResult{{"go"}, {}}).return_code, ReturnCode::bad_parameter);
    EXPECT_THAT(desk.received(), testing::Not(testing::Contains(HasSubstr("completed"))));
    world.engine->and_work([&] { world.engine->clear(); }, world.now);
    EXPECT_EQ(desk.execute(go("go")).return_code, ReturnCode::ok) << "the id is free";
}

TEST_F(Journaled, ACommandThatIsNotStoredYetEndsWithItsSession) {
    World goes_on{{navigation}, {.on_session_end = OnSessionEnd::continue_}};
    goes_on.keep_journal();
    auto desk = goes_on.connect();
    desk.bind("navigation");
    goes_on.journal->then = MemoryJournal::Then::later;
    goes_on.begin_to_say(desk.session, Execute{{{go("go")}}});
    goes_on.begin_to_say(desk.session, Disconnect{});
    goes_on.journal->settle(true);
    goes_on.engine->and_work([&] { goes_on.engine->stored(goes_on.now); }, goes_on.now);
    goes_on.engine->stop_everything(goes_on.now);
    EXPECT_THAT(goes_on.engine->statistics().commands_completed, testing::Each(0U)) << "nothing was left to be stopped";
    EXPECT_THAT(goes_on["navigation"].calls, testing::Not(testing::Contains("start")));
}

TEST_F(Journaled, ASessionThatWaitsForAComponentIsNotIdle) {
    auto bound = world.connect(), subscribed = world.connect();
    bound.bind("navigation");
    subscribed.subscribe("reached_target");
    EngineSettings settings;
    settings.max_sessions = 2;
    world.restart({speech}, settings);
    world.engine->begin(world.now);
    EXPECT_EQ(std::get<Refusal>(world.say({}, Connect{})), Refusal::too_many_sessions);
}

TEST_F(Journaled, AStopStaysAlsoIfTheTokenOfAnOwnerIsRevoked) {
    auto const one = std::make_shared<Rights const>("one", std::vector<std::string>{"*"}, std::vector<std::string>{"*"}, "1");
    auto const two = std::make_shared<Rights const>("two", std::vector<std::string>{"*"}, std::vector<std::string>{"*"}, "2");
    auto first = world.connect_as(one), second = world.connect_as(two);
    first.ask(StopEverything{});
    second.ask(StopEverything{});
    world.rights_of = [&](std::string const& id) { return id == "2" ? two : nullptr; };
    world.restart({navigation, speech, detection});
    world.engine->begin(world.now);
    Application resumed{world, second.session, two.get()};
    resumed.ask(ClearStop{});
    EXPECT_TRUE(world.engine->everything_is_stopped()) << "the other owner has not cleared it";
}

TEST_F(Journaled, ACommandThatWasNotStoredLeavesNoTrace) {
    auto desk = world.connect();
    desk.bind("navigation");
    journal().then = MemoryJournal::Then::later;
    world.begin_to_say(desk.session, Execute{{{go("go")}}});
    auto resumed = die_and_resume(desk);
    EXPECT_THAT(resumed.received(), IsEmpty());
    journal().then = MemoryJournal::Then::stored;
    EXPECT_EQ(resumed.execute(go("go")).return_code, ReturnCode::ok);
}

TEST_F(Journaled, ACompletionIsNotSeenBeforeItIsStored) {
    auto desk = world.connect();
    desk.bind("navigation");
    desk.execute(go("go"));
    journal().then = MemoryJournal::Then::later;
    world["navigation"].finishes();
    EXPECT_THAT(desk.received(), IsEmpty());
    auto const result = world.begin_to_say(desk.session, GetCommandResult{{"go"}, {}});
    EXPECT_FALSE(result->said) << "it would tell the same";
    store();
    EXPECT_TRUE(result->said);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go OK"));
}

TEST_F(Journaled, ARefusalAboutACommandWaitsUntilThatIsStored) {
    auto desk = world.connect();
    desk.bind("navigation");
    journal().then = MemoryJournal::Then::later;
    world.begin_to_say(desk.session, Execute{{{go("go")}}});
    auto const again = world.begin_to_say(desk.session, Execute{{{go("go")}}});
    EXPECT_FALSE(again->said);
    store();
    EXPECT_EQ(std::get<Execute::Reply>(std::get<Reply>(again->said.value())).reason,
              "command_unit_list[1]: the command_id 'go' is in use in this session");
}

TEST_F(Journaled, ARefusalSaysWhenTheCommandThatHadTheIdCannotBeStored) {
    auto desk = world.connect();
    desk.bind("navigation");
    journal().then = MemoryJournal::Then::later;
    world.begin_to_say(desk.session, Execute{{{go("go")}}});
    auto const again = world.begin_to_say(desk.session, Execute{{{go("go")}}});
    auto const unknown = world.begin_to_say(desk.session, Execute{{{command("fly", "navigation")}}});
    fail_to_store();
    world.advance(50ms);
    auto const code_of = [](auto const& asked) { return outcome_of(std::get<Reply>(asked->said.value())).return_code; };
    EXPECT_EQ(code_of(again), ReturnCode::out_of_resources) << "no command has this id";
    EXPECT_EQ(code_of(unknown), ReturnCode::bad_parameter);
}

TEST_F(Journaled, QueriesDoNotWait) {
    auto desk = world.connect();
    desk.bind("navigation");
    journal().then = MemoryJournal::Then::later;
    world.begin_to_say(desk.session, Bind{Application::identifier("speech")});
    EXPECT_EQ(desk.status_of("navigation"), "READY");
}

TEST_F(Journaled, StopsDoNotWait) {
    auto desk = world.connect();
    desk.bind("navigation");
    desk.execute(go("go"));
    journal().then = MemoryJournal::Then::later;
    auto const asked = world.begin_to_say(desk.session, Execute{{{named("s", stop("navigation"))}}});
    EXPECT_THAT(world["navigation"].calls, testing::Contains("halt"));
    EXPECT_FALSE(asked->said);
    store();
    EXPECT_TRUE(asked->said);
}

TEST_F(Journaled, WhatMovesAgainOrLaterWaits) {
    auto desk = world.connect();
    desk.bind("navigation");
    desk.execute(go("go"));
    desk.execute(suspend("navigation"));
    journal().then = MemoryJournal::Then::later;
    auto const resumed = world.begin_to_say(desk.session, Execute{{{named("r", resume("navigation"))}}});
    EXPECT_THAT(world["navigation"].calls, testing::Not(testing::Contains("resume")));
    auto const stopped = world.begin_to_say(desk.session, Execute{{{pause(1s), named("s", stop("navigation"))}}});
    fail_to_store();
    world.advance(50ms);
    for (auto const& asked : {resumed, stopped})
        EXPECT_EQ(std::get<Execute::Reply>(std::get<Reply>(asked->said.value())).return_code, ReturnCode::out_of_resources);
}

TEST_F(Journaled, ACommandDoesNotBeginAfterAStopThatCameWhileItWasStored) {
    auto desk = world.connect();
    desk.bind("navigation");
    journal().then = MemoryJournal::Then::later;
    auto const asked = world.begin_to_say(desk.session, Execute{{{go("go")}}});
    world.begin_to_say(desk.session, Execute{{{named("s", stop("navigation"))}}});
    store();
    store();
    EXPECT_EQ(std::get<Execute::Reply>(std::get<Reply>(asked->said.value())).return_code, ReturnCode::error);
    EXPECT_THAT(world["navigation"].calls, testing::Not(testing::Contains("start")));
}

TEST_F(Journaled, ACommandThatCannotBeStoredIsRefusedAndStopStillWorks) {
    auto desk = world.connect();
    desk.bind("navigation");
    desk.execute(go("go"));
    journal().then = MemoryJournal::Then::not_stored;
    EXPECT_EQ(desk.execute(go("next")).return_code, ReturnCode::out_of_resources);
    EXPECT_EQ(desk.execute(go("third")).return_code, ReturnCode::out_of_resources) << "at once, while the journal fails";
    EXPECT_EQ(desk.set_parameter("navigation", {value("speed", "double", {"1"})}).return_code != ReturnCode::ok, true);
    EXPECT_THAT(world["navigation"].calls, testing::Not(testing::Contains("halt")));
    EXPECT_EQ(desk.execute(named("s", stop("navigation"))).return_code, ReturnCode::ok);
    EXPECT_THAT(world["navigation"].calls, testing::Contains("halt"));
    EXPECT_THAT(desk.received(), IsEmpty()) << "they are not stored";
    journal().then = MemoryJournal::Then::stored;
    world.advance(300ms);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed go ABORT", "2 completed s OK"));
    EXPECT_EQ(desk.execute(go("last")).return_code, ReturnCode::ok);
    auto resumed = die_and_resume(desk);
    EXPECT_THAT(resumed.received(), ElementsAre("1 completed go ABORT", "2 completed s OK", "3 completed last ABORT"));
}

TEST_F(Journaled, WhatBeginsAndEndsWhileTheDiskIsFullLeavesNoTrace) {
    auto desk = world.connect();
    desk.bind("speech");
    journal().then = MemoryJournal::Then::not_stored;
    for (int i = 0; i < 3; ++i) {
        auto other = world.connect();
        auto const at_once = desk.subscribe("reached_target"), later = desk.subscribe("reached_target");
        EXPECT_EQ(desk.unsubscribe(at_once.subscribe_id), ReturnCode::ok);
        world.advance(300ms);
        other.ask(Disconnect{});
        EXPECT_EQ(desk.unsubscribe(later.subscribe_id), ReturnCode::ok);
        world.advance(300ms);
    }
    journal().then = MemoryJournal::Then::stored;
    world.advance(300ms);
    EXPECT_EQ(journal().gone, 0u);
    auto const known = desk.subscribe("reached_target");
    journal().then = MemoryJournal::Then::not_stored;
    desk.unsubscribe(known.subscribe_id);
    EXPECT_EQ(journal().gone, 1u) << "that one is in the journal";
}

TEST_F(Journaled, CommandsBeginAgainAlsoIfNothingIsLeftToStore) {
    auto desk = world.connect();
    desk.bind("navigation");
    journal().then = MemoryJournal::Then::not_stored;
    auto const subscribed = desk.subscribe("reached_target");
    world.advance(300ms);
    EXPECT_EQ(desk.execute(go("refused")).return_code, ReturnCode::out_of_resources);
    EXPECT_EQ(desk.unsubscribe(subscribed.subscribe_id), ReturnCode::ok);
    journal().then = MemoryJournal::Then::stored;
    world.advance(300ms);
    EXPECT_EQ(desk.execute(go("go")).return_code, ReturnCode::ok);
}

TEST_F(Journaled, AJournalThatTakesTooLongCountsAsFull) {
    auto desk = world.connect();
    desk.bind("navigation");
    journal().then = MemoryJournal::Then::later;
    auto const asked = world.begin_to_say(desk.session, Execute{{{go("go")}}});
    world.advance(1100ms);
    EXPECT_EQ(std::get<Execute::Reply>(std::get<Reply>(asked->said.value())).return_code, ReturnCode::out_of_resources);
    store();
    world.advance(100ms);
    EXPECT_THAT(world["navigation"].calls, testing::Not(testing::Contains("start"))) << "it was refused";
}

TEST_F(Journaled, WithoutRoomNoCommandBegins) {
    auto desk = world.connect();
    desk.bind("navigation");
    journal().full = "the disk is full";
    EXPECT_EQ(desk.execute(go("go")).return_code, ReturnCode::out_of_resources);
    EXPECT_EQ(desk.execute(named("s", stop("navigation"))).return_code, ReturnCode::ok);
    EXPECT_EQ(desk.bind("speech"), ReturnCode::ok);
    EXPECT_EQ(desk.subscribe("reached_target").return_code, ReturnCode::out_of_resources) << "conditions may be long";
    EXPECT_EQ(desk.bind_any(), "OUT_OF_RESOURCES");
}

TEST_F(Journaled, AStopOfEverythingStays) {
    auto desk = world.connect();
    desk.bind("navigation");
    world.engine->stop_everything(world.now);
    auto resumed = die_and_resume(desk);
    EXPECT_TRUE(world.engine->everything_is_stopped());
    EXPECT_EQ(resumed.execute(go("go")).return_code, ReturnCode::error);
    world.engine->and_work([&] { world.engine->clear(); }, world.now);
    world.restart({navigation});
    EXPECT_FALSE(world.engine->everything_is_stopped());
}

TEST_F(Journaled, TheStopOfASessionIsClearedByTheSessionThatReturns) {
    auto desk = world.connect();
    auto const stop = desk.ask(StopEverything{}).stop;
    ASSERT_TRUE(stop);
    auto resumed = die_and_resume(desk);
    ASSERT_TRUE(world.engine->everything_is_stopped());
    resumed.ask(ClearStop{*stop});
    EXPECT_FALSE(world.engine->everything_is_stopped());
}

TEST_F(Journaled, IdsAreNotGivenTwice) {
    auto desk = world.connect();
    desk.bind("navigation");
    auto const subscribed = desk.subscribe("reached_target");
    world["navigation"].fires("reached_target");
    desk.received();
    auto const event = desk.last_received<ReceiveEvent>().event_id;
    auto const first = ids_of(desk.execute(named("", go(""))).command_unit_list.command_unit_list);
    auto resumed = die_and_resume(desk);
    world["navigation"].stands_still();
    EXPECT_EQ(resumed.detail_of(event).return_code, ReturnCode::bad_parameter) << "it has expired";
    world["navigation"].fires("reached_target");
    resumed.received();
    EXPECT_NE(resumed.last_received<ReceiveEvent>().event_id, event);
    EXPECT_NE(ids_of(resumed.execute(named("", go(""))).command_unit_list.command_unit_list), first);
    EXPECT_NE(resumed.subscribe("person_detected").subscribe_id, subscribed.subscribe_id);
}

TEST_F(Journaled, WhatHasEndedDoesNotReturn) {
    auto desk = world.connect();
    auto other = world.connect();
    desk.bind("navigation");
    desk.bind("speech");
    desk.release("speech");
    auto const id = desk.subscribe("reached_target").subscribe_id;
    desk.unsubscribe(id);
    other.leave();
    auto resumed = die_and_resume(desk);
    EXPECT_EQ(world.engine->statistics().sessions, 1U);
    EXPECT_EQ(world.connect().bind("speech"), ReturnCode::ok);
    world["navigation"].stands_still();
    world["navigation"].fires("reached_target");
    EXPECT_THAT(resumed.received(), IsEmpty());
}

TEST_F(Journaled, BindingsAndSubscriptionsWaitForComponentsThatReturnLater) {
    auto desk = world.connect();
    desk.bind("navigation");
    desk.subscribe("reached_target", equal("component_ref", "navigation"));
    auto resumed = die_and_resume(desk, {speech});
    auto other = world.connect();
    world.change({}, {navigation});
    EXPECT_EQ(other.bind("navigation"), ReturnCode::out_of_resources);
    world["navigation"].fires("reached_target");
    EXPECT_THAT(resumed.received(), testing::Contains(HasSubstr("reached_target navigation")));
}

TEST_F(Journaled, ASessionReturnsOnlyWithItsRights) {
    auto const rights =
        std::make_shared<Rights const>("desk", std::vector<std::string>{"*"}, std::vector<std::string>{"*"}, "42");
    auto desk = world.connect_as(rights);
    world.rights_of = [&](std::string const& id) { return id == "42" ? rights : nullptr; };
    world.restart({navigation});
    EXPECT_NE(world.engine->notifications(desk.session, rights.get()), nullptr);
    EXPECT_EQ(world.engine->notifications(desk.session), nullptr);
    world.rights_of = [](std::string const&) { return nullptr; };
    world.restart({navigation});
    EXPECT_EQ(world.engine->statistics().sessions, 0U) << "the token was revoked";
}

TEST_F(Journaled, ManyChangesAreStoredInOneStep) {
    auto desk = world.connect();
    desk.bind("navigation");
    desk.subscribe("reached_target");
    journal().then = MemoryJournal::Then::later;
    auto const before = journal().steps;
    for (int i = 0; i < 100; ++i) world["navigation"].fires("reached_target");
    store();
    store();
    EXPECT_EQ(journal().steps, before + 2);
    EXPECT_EQ(desk.received().size(), 100U);
}

TEST_F(Journaled, SignsOfLifeAreNotStored) {
    auto desk = world.connect();
    auto const before = journal().steps;
    desk.ask(Connect{});
    EXPECT_EQ(journal().steps, before);
    Connect shorter;
    shorter.window = 5s;
    desk.ask(shorter);
    EXPECT_EQ(journal().steps, before + 1);
}

TEST_F(Journaled, NotificationsThatNobodyCanReadAnyMoreAreNotKept) {
    World small{{navigation}, {.max_sent_notifications = 3}};
    small.keep_journal();
    auto desk = small.connect();
    desk.subscribe("reached_target");
    for (int i = 0; i < 100; ++i) {
        small["navigation"].fires("reached_target");
        desk.received();
    }
    EXPECT_LE(small.journal->take_state().notifications.size(), 5U);
}

}  // namespace

}  // namespace rois
