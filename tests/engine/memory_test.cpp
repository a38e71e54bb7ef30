// The memory budget, and what the engine does when little is left.
#include "engine/memory_budget.hpp"

#include "engine/world.hpp"

namespace rois {

using testing::AllOf;
using testing::SizeIs;

namespace {

constexpr std::size_t mib = std::size_t{1} << 20U;

// A process whose use of memory the test sets.
struct Memory {
    std::size_t uses = 10 * mib;
    MemoryBudget budget{100 * mib, [this] { return uses; }};

    void use(std::size_t mibs) {
        uses = mibs * mib;
        budget.look();
    }
};

struct InMemory : testing::Test, Memory {
    World world{navigation, speech, detection};
    Application desk{world.connect()};

    InMemory() { world.engine->keep_within(budget); }
};

}  // namespace

TEST(MemoryBudget, IsTightFrom80PercentOnAndFullFrom100) {
    Memory memory;
    auto& budget = memory.budget;
    memory.use(79);
    EXPECT_FALSE(budget.tight());
    EXPECT_GT(budget.longest_document(), 1'000 * mib);
    memory.use(80);
    EXPECT_TRUE(budget.tight());
    EXPECT_FALSE(budget.full());
    EXPECT_EQ(budget.longest_document(), 64 * 1024U);
    memory.use(100);
    EXPECT_TRUE(budget.full());
    EXPECT_EQ(budget.longest_document(), 4 * 1024U);
    EXPECT_EQ(budget.refuse("no"), "no: the gateway uses 100 of the 100 MiB of its memory_budget; try again later");
    EXPECT_EQ(budget.refusals(), 1U);
}

TEST(MemoryBudget, IsMeasuredWhenMuchWasTaken) {
    Memory memory;
    memory.uses = 90 * mib;
    for (int i = 0; i < 3; ++i) memory.budget.took(64 * 1024);
    EXPECT_FALSE(memory.budget.tight()) << "not yet";
    memory.budget.took(64 * 1024);
    EXPECT_TRUE(memory.budget.tight());
}

TEST(MemoryBudget, GivesRoomUntilItIsUsedUp) {
    Memory memory;
    auto& budget = memory.budget;
    {
        auto const one = budget.reserve(60 * mib);
        EXPECT_TRUE(one);
        EXPECT_TRUE(budget.reserve(30 * mib)) << "and the memory is returned at once";
        auto const other = budget.reserve(30 * mib);
        EXPECT_TRUE(other);
        EXPECT_FALSE(budget.reserve(1));
        budget.look();
        EXPECT_TRUE(budget.full()) << "reserved memory counts";
        EXPECT_TRUE(budget.reserve(0)) << "for a short document";
    }
    budget.look();
    EXPECT_EQ(budget.used(), 10 * mib);
    EXPECT_TRUE(MemoryBudget::none().reserve(1'000'000 * mib));
    EXPECT_FALSE(MemoryBudget::none().tight());
}

TEST_F(InMemory, NewSessionsAreRefusedFrom80PercentOn) {
    use(80);
    EXPECT_EQ(std::get<Refusal>(world.say({}, Connect{})), Refusal::no_memory);
    EXPECT_EQ(desk.ask(Connect{}).return_code, ReturnCode::ok) << "it has one";
    use(79);
    EXPECT_EQ(world.connect().search().size(), 3U);
}

TEST_F(InMemory, NewSubscriptionsAreRefusedFrom80PercentOn) {
    auto const known = desk.subscribe("reached_target");
    use(80);
    auto const refused = desk.subscribe("reached_target", equal("component_ref", "navigation"));
    EXPECT_EQ(refused.return_code, ReturnCode::out_of_resources);
    EXPECT_THAT(refused.reason, AllOf(HasSubstr("new subscription"), HasSubstr("80 of the 100 MiB of its memory_budget")));
    EXPECT_EQ(desk.subscribe("reached_target").subscribe_id, known.subscribe_id) << "it has this one";
    EXPECT_EQ(desk.unsubscribe(known.subscribe_id), ReturnCode::ok);
}

TEST_F(InMemory, StopsWorkAlsoIfTheMemoryBudgetIsExceeded) {
    desk.bind("navigation");
    desk.execute(go("a"));
    use(150);
    EXPECT_EQ(desk.execute(named("s", stop("navigation"))).return_code, ReturnCode::ok);
    EXPECT_EQ(desk.result_of("s"), "OK");
    EXPECT_EQ(desk.execute(go("b")).return_code, ReturnCode::ok) << "a short request works, too";
    EXPECT_EQ(desk.release("navigation"), ReturnCode::ok);
    EXPECT_EQ(desk.result_of("b"), "ABORT");
    EXPECT_EQ(desk.bind("navigation"), ReturnCode::ok);
    EXPECT_EQ(desk.ask(Disconnect{}).return_code, ReturnCode::ok);
}

TEST_F(InMemory, WaitingCommandsAreLimitedTo16AtTheMemoryBudget) {
    desk.bind("navigation");
    use(100);
    for (int i = 0; i < 16; ++i) EXPECT_EQ(desk.execute(after(1h, go(std::to_string(i)))).return_code, ReturnCode::ok) << i;
    auto const refused = desk.execute(after(1h, go("one more")));
    EXPECT_EQ(refused.return_code, ReturnCode::out_of_resources);
    EXPECT_THAT(refused.reason, AllOf(HasSubstr("commands"), HasSubstr("memory_budget")));
    EXPECT_EQ(desk.execute(named("s", stop("navigation"))).return_code, ReturnCode::ok);
}

TEST_F(InMemory, DelayedStopsAreLimitedTo16AtTheMemoryBudget) {
    desk.bind("navigation");
    use(100);
    for (int i = 0; i < 16; ++i) {
        auto const later = after(1h, named(std::to_string(i), stop("navigation")));
        EXPECT_EQ(desk.execute(later).return_code, ReturnCode::ok) << i;
    }
    EXPECT_EQ(desk.execute(after(1h, named("one more", stop("navigation")))).return_code, ReturnCode::out_of_resources);
    EXPECT_EQ(desk.execute(named("s", stop("navigation"))).return_code, ReturnCode::ok);
}

TEST_F(InMemory, OldResultsAreDroppedWhenMemoryIsShort) {
    desk.bind("navigation");
    for (int i = 0; i < 200; ++i) desk.execute(named("s" + std::to_string(i), stop("navigation")));
    desk.received();
    desk.subscribe("reached_target");
    for (int i = 0; i < 200; ++i)
        world["navigation"].fires("reached_target", {text("target", "x"), boolean("is_final_target", true)});
    use(100);
    world.advance(50ms);
    EXPECT_EQ(desk.result_of("s0"), "BAD_PARAMETER") << "expired";
    EXPECT_EQ(desk.result_of("s199"), "OK");
    auto const received = desk.received();
    EXPECT_THAT(received, SizeIs(65));
    EXPECT_EQ(received.front(), "336 lost 136");
    EXPECT_EQ(desk.ask(GetEventDetail{{"e-100"}, {}}).return_code, ReturnCode::bad_parameter);
    EXPECT_EQ(desk.ask(GetEventDetail{{"e-200"}, {}}).return_code, ReturnCode::ok);
}

TEST_F(InMemory, SessionsThatReadNoNotificationsEndAtTheMemoryBudget) {
    auto slow = world.connect();
    slow.bind("navigation");
    for (int i = 0; i < 257; ++i) slow.execute(stop("navigation"));
    use(100);
    world.advance(50ms);
    EXPECT_TRUE(slow.notifications_closed());
    EXPECT_FALSE(desk.notifications_closed());
}

TEST_F(InMemory, StatisticsReportTheUsedMemory) {
    use(85);
    world.say({}, Connect{});
    budget.refuse("");
    auto const numbers = world.engine->statistics();
    EXPECT_EQ(numbers.memory_budget, 100 * mib);
    EXPECT_EQ(numbers.memory_used, 85 * mib);
    EXPECT_EQ(numbers.limits.back().of, "memory_budget");
    EXPECT_EQ(numbers.limits.back().most, 100 * mib);
    EXPECT_EQ(numbers.limits.back().reached, 1U);
}

}  // namespace rois
