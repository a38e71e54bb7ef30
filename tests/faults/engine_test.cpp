// A scripted history of the engine in which each call in turn has no memory: the clock goes on, and moving components halt.

#include <algorithm>
#include <random>

#include "engine/slow_component.hpp"
#include "engine/world.hpp"
#include "faults/driving_component.hpp"
#include "faults/faults.hpp"

namespace rois {

namespace {

// Calls a function of the test once.
class Hand final : public Device {
public:
    std::function<void()> next;
    void advance(Instant) override {
        if (auto const what = std::exchange(next, nullptr)) what();
    }
};

struct Hall {
    MemoryBudget budget;
    World world{speech};
    DrivingComponent* base = nullptr;
    DrivingComponent* arm = nullptr;
    std::shared_ptr<Hand> hand = std::make_shared<Hand>();
    std::optional<Application> desk, guest;
    SubscribeId subscription;

    Hall() {
        auto first = std::make_unique<DrivingComponent>("base", navigation),
             second = std::make_unique<DrivingComponent>("arm", navigation);
        base = first.get();
        arm = second.get();
        arm->confirms_late = true;
        world.engine->add(std::move(first));
        world.engine->add(std::move(second));
        world.engine->add(hand);
        world.engine->keep_within(budget);
        for (int i = 1; i <= most_secrets; ++i) world.notified[SessionId{"secret-" + std::to_string(i)}] = 0;
    }
    static constexpr int most_secrets = 400;  // of sessions and stops

    void tick(std::function<void()> what = {}) {
        hand->next = std::move(what);
        world.advance(50ms);
    }

    // All operations of the engine, step by step.
    std::vector<std::function<void()>> history() {
        return {
            [this] { desk.emplace(world.connect()); },
            [this] { guest.emplace(world.connect_without_link()); },
            [this] { desk.value().bind("base"); },
            [this] { desk.value().bind_any(equal("component_ref", "arm")); },
            [this] { desk.value().bind("speech"); },
            [this] { subscription = desk.value().subscribe("reached_target", {}, true).subscribe_id; },
            [this] { guest.value().subscribe("reached_target", equal("component_ref", "base")); },
            [this] { desk.value().set_parameter("speech", {value("volume", "int", {"7"})}); },
            [this] {
                desk.value().execute(go("go", "base"), after(100ms, say("say")), in_parallel({go("reach", "arm"), pause(50ms)}),
                                     named("last", command("dock", "base")));
            },
            [this] { tick([this] { base->pass("door"); }); },
            [this] { desk.value().execute(go("again", "base")); },
            [this] { desk.value().execute(named("hold", suspend("base")), named("on", resume("base"))); },
            [this] { tick([this] { base->arrive({}); }); },
            [this] { world["speech"].finishes(); },
            [this] { tick(); },
            [this] { desk.value().query("component_status", equal("component_ref", "base")); },
            [this] { desk.value().execute(named("stop", stop("arm"))); },
            [this] { tick([this] { arm->stand_still(); }); },
            [this] { desk.value().execute(go("third", "arm"), go("fourth", "arm")); },
            [this] { tick([this] { arm->stand_still(); }); },
            [this] { world["speech"].reports(ErrorType::component_internal_error, "hoarse"); },
            [this] { desk.value().received(); },
            [this] { desk.value().release("base"); },
            [this] { guest.value().bind("base"); },
            [this] { guest.value().execute(go("mine", "base")); },
            [this] { world.advance(300ms); },
            [this] { guest.value().ask(Disconnect{}); },
            [this] { world.engine->link_closed(desk.value().session, LinkKind::websocket, Closing::lost, world.now); },
            [this] { world.advance(400ms); },
            [this] { world.engine->link_opened(desk.value().session, LinkKind::websocket, world.now); },
            [this] { desk.value().execute(go("fifth", "arm"), after(200ms, go("sixth", "base"))); },
            [this] { desk.value().unsubscribe(subscription); },
            [this] { use_up_memory(); },
            [this] { world.engine->stop_everything(world.now); },
            [this] { world.engine->clear(); },
            [this] { desk.value().ask(Disconnect{}); },
        };
    }

    void use_up_memory() {
        struct Shortage {
            MemoryBudget& of;
            ~Shortage() { of.set_exhausted(false); }
        } const shortage{budget};
        budget.set_exhausted(true);
        world.advance(100ms);
    }

    std::vector<std::function<void()>> end_of_a_round() {
        return {[this] { end(); }, [this] { arm->stand_still(); }, [this] { world.advance(100ms); }};
    }

    // Repeats the steps, each time in another order and with other sessions.
    static void play_rounds(std::vector<std::function<void()>>& steps, std::vector<std::function<void()>> const& last,
                            int rounds) {
        for (int round = 0; round < rounds; ++round) {
            play(steps);
            play(last);
            std::mt19937 random{static_cast<unsigned>(round)};
            std::ranges::shuffle(steps, random);
        }
    }

    // Returns the number of failed steps; the steps after a failed one still run.
    static int play(std::vector<std::function<void()>> const& steps) {
        int failed = 0;
        for (auto const& step : steps) {
            try {
                step();
            } catch (std::exception const&) {
                ++failed;  // a request: its application receives the error
            }
        }
        return failed;
    }

    // Drops the applications.
    void end() {
        for (auto* application : {&desk, &guest})
            if (*application) lose_links((*application)->session);
    }
    // Drops the applications of all rounds.
    void end_all() {
        for (int i = 1; i <= most_secrets; ++i) lose_links({"secret-" + std::to_string(i)});
    }
    void lose_links(SessionId const& session) {
        constexpr int most_links = 3;
        for (int i = 0; i < most_links; ++i) world.engine->link_closed(session, LinkKind::websocket, Closing::lost, world.now);
    }

    void tick_quietly(std::chrono::milliseconds duration) {
        for (; duration.count() > 0; duration -= 50ms) {
            arm->stand_still();
            try {
                world.advance(50ms);
            } catch (std::exception const&) {
                // Reports what an earlier failure left, once.
            }
        }
    }
};

// A delay ends, and a silent component misses its deadline.
void expect_time_to_pass(World& world, std::uint64_t n) {
    auto late = world.connect();
    ASSERT_EQ(late.bind("speech"), ReturnCode::ok) << n;
    world["speech"].on_start = OnStart::stays_silent;
    late.execute(after(100ms, say("say")));
    world.advance(100ms);
    ASSERT_EQ(late.result_of("say"), "RUNNING") << n;
    world.advance(2s);
    ASSERT_EQ(late.result_of("say"), "TIMEOUT") << n;
    late.leave();
}

void expect_all_to_stand_still(Hall& hall, std::uint64_t n) {
    ASSERT_FALSE(hall.base->drives) << n;
    ASSERT_FALSE(hall.arm->drives) << n;
    ASSERT_THAT(hall.world.engine->not_halted(), testing::IsEmpty()) << n;
}

// Each command of the history completes at most once.
void expect_no_double_answers(Hall& hall, std::uint64_t n) {
    std::map<std::string, int> completed;
    if (!hall.desk) return;
    for (auto const& words : hall.desk->received()) {
        auto const at = words.find("completed ");
        if (at == std::string::npos) continue;
        ASSERT_EQ(++completed[words.substr(at, words.rfind(' ') - at)], 1) << n << ": " << words;
    }
}

// Returns false if the history ended before its n-th call.
bool survives(std::uint64_t n, std::uint64_t how_many, int rounds = 1) {
    Hall hall;
    auto history = hall.history();
    auto const last = hall.end_of_a_round();
    faults::fail_at(faults::Of::memory, n, how_many);
    Hall::play_rounds(history, last, rounds);
    bool const failed = faults::stop();
    hall.tick_quietly(100ms);
    hall.end_all();
    hall.world.engine->clear();  // the last `stop_everything` may have been later
    hall.tick_quietly(1s);
    expect_all_to_stand_still(hall, n);
    hall.tick_quietly(100s);
    expect_all_to_stand_still(hall, n);
    expect_no_double_answers(hall, n);
    auto const left = hall.world.engine->statistics();
    EXPECT_EQ(left.sessions, 0) << n;
    EXPECT_EQ(left.subscriptions, 0) << n;
    expect_time_to_pass(hall.world, n);
    return failed;
}

}  // namespace

TEST(History, IsPlayedWholeWithoutFaults) {
    Hall hall;
    EXPECT_EQ(Hall::play(hall.history()), 0);
}

class MemoryThatRunsOut : public testing::TestWithParam<std::uint64_t> {};

TEST_P(MemoryThatRunsOut, AtAnyCallStopsNoClockAndHaltsMovingComponents) {
    std::uint64_t n = 1;
    while (survives(n, GetParam()) && !HasFailure() && n < 20'000) n += faults::step;
    EXPECT_GT(n, 500) << "the history needs memory that often";
}

// Every 41st call up to the 20,000th, with another offset for each parameter.
TEST_P(MemoryThatRunsOut, LateInALongHistoryStopsNoClockAndHaltsMovingComponents) {
    constexpr int rounds = 80;
    std::uint64_t n = 1 + GetParam() % 41;
    while (n < 20'000 && !HasFailure() && survives(n, GetParam(), rounds)) n += 41 * faults::step;
    EXPECT_GE(n, 20'000) << "the rounds need memory that often";
}

// An open stream keeps the lease alive, so only the pause of the engine can hold the motion.
TEST(MotionAfterAPauseOfTheEngine, IsHeldByTheNextTickIfMemoryIsMissing) {
    bool failed = true;
    for (std::uint64_t n = 1; failed && !testing::Test::HasFailure(); ++n) {
        Hall hall;
        auto desk = hall.world.connect_without_link();
        hall.world.engine->link_opened(desk.session, LinkKind::stream, hall.world.now);
        desk.bind("base");
        desk.execute(go("go", "base"));
        hall.tick();
        ASSERT_TRUE(hall.base->drives);
        hall.world.now = hall.world.now + 10s;
        std::vector<std::function<void()>> const steps{[&] { hall.world.engine->tick(hall.world.now); }};
        faults::fail_at(faults::Of::memory, n);
        Hall::play(steps);
        failed = faults::stop();
        hall.tick_quietly(50ms);
        EXPECT_FALSE(hall.base->drives) << n;
    }
}

// Three rounds end in the same tick: each operation has an answer, whichever of the allocations fails.
TEST(QuestionsThatAreNotAnswered, EndAlsoIfMemoryIsMissing) {
    bool failed = true;
    for (std::uint64_t n = 1; failed && !testing::Test::HasFailure(); ++n) {
        World world{speech};
        world.engine->add(std::make_unique<SlowComponent>(navigation));
        auto desk = world.connect();
        std::vector<std::shared_ptr<TestedOperation>> asked;
        for (int i = 0; i < 3; ++i) asked.push_back(world.begin_to_say(desk.session, Query{"route", {}}));
        world.advance(950ms);
        std::vector<std::function<void()>> const tick{[&] { world.advance(50ms); }};
        faults::fail_at(faults::Of::memory, n);
        Hall::play(tick);
        failed = faults::stop();
        for (int i = 0; i < 4; ++i) Hall::play(tick);
        for (auto const& each : asked) EXPECT_TRUE(each->said) << n;
    }
}

INSTANTIATE_TEST_SUITE_P(ForCalls, MemoryThatRunsOut, testing::Values(1, 2, 7, 60, 600),
                         [](auto const& calls) { return std::to_string(calls.param); });

}  // namespace rois
