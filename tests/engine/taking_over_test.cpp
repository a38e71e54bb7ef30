// An administrator takes a component from the session that has bound it (docs/trust.md).
#include "engine/world.hpp"

namespace rois {

namespace {

Bind take_over(std::string const& ref) { return {Application::identifier(ref), Switching::none, true}; }

struct TakingOver : testing::Test {
    World world{navigation, speech};
    Application desk = world.connect();
    std::shared_ptr<Rights const> rights =
        std::make_shared<Rights const>("chief", std::vector<std::string>{"*"}, std::vector<std::string>{"*"});
    Application chief = world.connect_as(rights);
};

}  // namespace

TEST_F(TakingOver, HaltsTheComponentAndTellsItsOwnerWhy) {
    desk.bind("navigation");
    desk.bind("speech");
    desk.execute(in_sequence({go("go-1"), go("go-2")}));
    desk.execute(say("say-1"));
    EXPECT_EQ(chief.ask(Bind{Application::identifier("navigation")}).return_code, ReturnCode::out_of_resources)
        << "without take_over";
    world["navigation"].calls.clear();
    EXPECT_EQ(chief.ask(take_over("navigation")).return_code, ReturnCode::ok);
    EXPECT_THAT(world["navigation"].calls, testing::Contains("halt"));
    EXPECT_THAT(desk.received(),
                ElementsAre("1 completed go-1 ABORT", "2 completed go-2 ABORT", "3 USER_DEFINED_ERROR navigation"));
    auto const error = desk.last_received<ReceiveError>();
    EXPECT_THAT(in_words(desk.detail_of(error.error_id).results.parameters),
                HasSubstr("text=the component 'navigation' was taken over by 'chief'"));
    EXPECT_EQ(desk.reason_of("go-1"), "its component was taken over by 'chief'");
    EXPECT_EQ(desk.execute(go("go-3")).return_code, ReturnCode::error) << "it has no binding any more";
    EXPECT_EQ(chief.execute(go("go-4")).return_code, ReturnCode::ok);
    EXPECT_EQ(desk.status_of("speech"), "READY") << "its other binding stays";
}

TEST_F(TakingOver, WaitsUntilTheComponentStandsStill) {
    desk.bind("navigation");
    desk.execute(go("go-1"));
    world["navigation"].halts_later = true;
    auto const asked = world.engine->begin_to_handle(chief.session, take_over("navigation"), world.now, rights);
    EXPECT_FALSE(asked->said);
    world["navigation"].stands_still();
    world.advance(50ms);
    ASSERT_TRUE(asked->said);
    EXPECT_EQ(std::get<Bind::Reply>(std::get<Reply>(*asked->said)).return_code, ReturnCode::ok);
}

TEST_F(TakingOver, LeavesAComponentThatDoesNotHaltUnbound) {
    desk.bind("navigation");
    desk.execute(go("go-1"));
    world["navigation"].halts_later = true;
    auto const asked = world.engine->begin_to_handle(chief.session, take_over("navigation"), world.now, rights);
    world.advance(10s);
    ASSERT_TRUE(asked->said);
    EXPECT_EQ(std::get<Bind::Reply>(std::get<Reply>(*asked->said)).return_code, ReturnCode::error);
    EXPECT_EQ(desk.execute(go("go-2")).return_code, ReturnCode::error);
    EXPECT_EQ(chief.execute(go("go-3")).return_code, ReturnCode::error);
    world["navigation"].stands_still();
    world.advance(50ms);
    EXPECT_EQ(chief.ask(take_over("navigation")).return_code, ReturnCode::ok);
}

TEST_F(TakingOver, OfAFreeComponentIsABind) {
    EXPECT_EQ(chief.ask(take_over("navigation")).return_code, ReturnCode::ok);
    EXPECT_EQ(chief.ask(take_over("navigation")).return_code, ReturnCode::ok) << "its own";
    EXPECT_EQ(chief.ask(take_over("nothing")).return_code, ReturnCode::bad_parameter);
    EXPECT_THAT(chief.received(), IsEmpty());
}

}  // namespace rois
