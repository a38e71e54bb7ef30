// After a restart: notifications that were not read, components that come later, and those that have changed (docs/journal.md).
#include "engine/journaled.hpp"
#include "engine/slow_component.hpp"

namespace rois {

namespace {

TEST_F(Journaled, EventsThatWereReplacedAreNotKept) {
    EngineSettings const settings{.max_waiting_notifications = 16, .max_sent_notifications = 3};
    World small{{navigation}, settings};
    small.keep_journal();
    auto desk = small.connect();
    desk.bind("navigation");
    desk.set_parameter("navigation", {integer("time_limit", 7)});
    desk.subscribe("reached_target");
    for (int i = 0; i < 1'000; ++i) small["navigation"].fires("reached_target");
    EXPECT_LE(small.journal->take_state().notifications.size(), 20U);
    small.restart({navigation}, settings);
    small.engine->begin(small.now);
    Application resumed{small, desk.session};
    auto const received = resumed.received();
    ASSERT_GE(received.size(), 3U);
    EXPECT_THAT(received[0], HasSubstr("completed"));
    EXPECT_THAT(received[1], HasSubstr("lost 9"));
    EXPECT_THAT(received.back(), HasSubstr("1001 reached_target"));
    small["navigation"].fires("reached_target");
    EXPECT_THAT(resumed.received(), ElementsAre("1002 reached_target navigation"));
}

TEST_F(Journaled, NotificationsThatWereNotReadReturnAlsoIfFewAreKeptForReadingAgain) {
    EngineSettings const settings{.max_sent_notifications = 3};
    World small{{navigation}, settings};
    small.keep_journal();
    auto desk = small.connect();
    desk.subscribe("reached_target");
    for (int i = 0; i < 10; ++i) small["navigation"].fires("reached_target");
    for (int restarts = 0; restarts < 2; ++restarts) {
        small.restart({navigation}, settings);
        small.engine->begin(small.now);
    }
    Application resumed{small, desk.session};
    EXPECT_THAT(resumed.received(), testing::AllOf(testing::SizeIs(10), testing::Contains("1 reached_target navigation")));
}

struct AReturningComponent : Journaled {
    AReturningComponent() {
        auto desk = world.connect();
        desk.bind("navigation");
        resumed.emplace(die_and_resume(desk, {speech}));
        auto part = navigation;
        part.confirms_binding = true;
        auto component = std::make_unique<SlowComponent>(part);
        slow = component.get();
        ComponentChange change{{}, {}, {.profiles = {common}, .frames = {}, .places = {}}, {}};
        change.coming.push_back(std::move(component));
        world.engine->change(std::move(change), world.now);
        work();
    }
    void work() {
        world.engine->and_work([] {}, world.now);
    }
    void answer(ComponentAnswer answer) {
        slow->answer("bind", std::move(answer));
        work();
    }
    std::size_t asked() const {
        return static_cast<std::size_t>(std::ranges::count(slow->questions, "bind", &SlowComponent::Question::what));
    }
    ReturnCode bind_by(Application& desk) {
        auto const asking = world.begin_to_say(desk.session, Bind{Application::identifier("navigation")});
        if (!asking->said) answer(Done{});
        return std::get<Bind::Reply>(std::get<Reply>(*asking->said)).return_code;
    }

    std::optional<Application> resumed;
    SlowComponent* slow = nullptr;
};

TEST_F(AReturningComponent, IsAskedAgainUntilItConfirmsItsBinding) {
    answer(Failed{"not now"});
    auto other = world.connect();
    for (int seconds = 0; seconds < 3; ++seconds) {
        EXPECT_EQ(journal().take_state().sessions.front().bindings.size(), 1U);
        world.advance(std::chrono::seconds{1});
        ASSERT_EQ(asked(), 1U);
        answer(Failed{"not now"});
    }
    world.advance(std::chrono::seconds{1});
    answer(Done{});
    EXPECT_EQ(bind_by(other), ReturnCode::out_of_resources);
}

TEST_F(AReturningComponent, IsNotAskedAgainOnceItIsBoundOrReleased) {
    answer(Failed{"not now"});
    auto other = world.connect();
    EXPECT_EQ(bind_by(other), ReturnCode::ok);
    world.advance(std::chrono::seconds{3});
    EXPECT_EQ(asked(), 0U);
    EXPECT_EQ(bind_by(*resumed), ReturnCode::out_of_resources);
}

TEST_F(AReturningComponent, BelongsToItsSessionAlsoIfThatBindsItFirst) {
    answer(Failed{"not now"});
    EXPECT_EQ(bind_by(*resumed), ReturnCode::ok);
    world.advance(std::chrono::seconds{3});
    EXPECT_EQ(asked(), 0U);
    EXPECT_EQ(resumed->release("navigation"), ReturnCode::ok);
    world.advance(std::chrono::seconds{3});
    EXPECT_EQ(asked(), 0U);
}

TEST_F(AReturningComponent, IsNotAskedAgainAfterARelease) {
    answer(Failed{"not now"});
    EXPECT_EQ(resumed->release("navigation"), ReturnCode::ok);
    world.advance(std::chrono::seconds{3});
    EXPECT_EQ(asked(), 0U);
}

TEST_F(Journaled, ResultsOfACommandThatTheComponentDoesNotHaveAnyMoreStay) {
    auto desk = world.connect();
    desk.bind("navigation");
    desk.execute(go("go", "navigation"));
    auto other = navigation;
    std::erase_if(other.profile.messages, [](auto const& message) { return message.name == "start"; });
    auto resumed = die_and_resume(desk, {other, speech});
    EXPECT_EQ(resumed.result_of("go"), "ABORT");
}

TEST_F(Journaled, SubscriptionsWhoseConditionsDoNotMeanTheSameAnyMorePart) {
    auto desk = world.connect(), other = world.connect();
    auto const condition = [](std::string const& literal) { return equal("Property/time_limit", literal); };
    auto const of_desk = desk.subscribe("reached_target", condition("7")).subscribe_id;
    EXPECT_EQ(other.subscribe("reached_target", condition("7.0")).subscribe_id, of_desk) << "the same for an int";
    auto text = navigation;
    for (auto& message : text.profile.messages)
        for (auto* list : {&message.arguments, &message.results})
            for (auto& each : *list)
                if (each.name == "time_limit") each.data_type_ref.code = "string";
    auto resumed = die_and_resume(desk, {text, speech});
    Application const second{world, other.session};
    world["navigation"].fires("reached_target");
    resumed.leave();
    world.engine->begin(world.now);
    world["navigation"].fires("reached_target");
}

}  // namespace

}  // namespace rois
