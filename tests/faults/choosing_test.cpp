// A logical component whose engine runs out of memory at each call in turn: its members stand still in the end, and are free.
#include "choosing/choosing.hpp"
#include "engine/world.hpp"
#include "faults/driving_component.hpp"
#include "faults/faults.hpp"

namespace rois {

namespace {

class TwoRobots {
public:
    TwoRobots() {
        ComponentChange change{.going = {}, .coming = {}, .belongings = {.profiles = {common}, .frames = {}, .places = {}}};
        for (auto** robot : {&first_, &second_}) {
            auto const name = robot == &first_ ? "robot1" : "robot2";
            auto component = std::make_unique<DrivingComponent>(std::string{name} + ".navigation", in_engine(name, navigation));
            *robot = component.get();
            change.coming.push_back(std::move(component));
        }
        choosing_.change(std::move(change),
                         [this](ComponentChange all) { return world.engine->change(std::move(all), world.now); });
        world.engine->add(hand_);
        world.engine->Engine::add(choosing_.device(), choosing::Choosing::provider);
        for (int i = 1; i <= 20; ++i) world.notified[SessionId{"secret-" + std::to_string(i)}] = 0;
        world.advance(100ms);
    }

    std::vector<std::function<void()>> history() {
        return {
            [this] { desk.emplace(world.connect()); },
            [this] {
                desk.value().ask(Bind{Application::identifier("navigation"), Switching::restart});
            },
            [this] { desk.value().execute(go("go", "navigation")); },
            [this] { happen([this] { first_->pass("door"); }); },
            [this] { happen([this] { first_->end(CompletedStatus::error); }); },
            [this] { world.advance(5s); },
            [this] { happen([this] { second_->end(CompletedStatus::error); }); },
            [this] { desk.value().execute(named("hold", suspend("navigation")), named("on", resume("navigation"))); },
            [this] { desk.value().execute(named("stop", stop("navigation"))); },
            [this] { desk.value().execute(go("again", "navigation")); },
            [this] { desk.value().release("navigation"); },
            [this] {
                desk.value().ask(Bind{Application::identifier("navigation"), Switching::abort});
            },
            [this] { desk.value().execute(go("third", "navigation")); },
        };
    }

    void expect_all_free(std::uint64_t n) {
        if (desk) desk->ask(Disconnect{});
        tick_quietly();
        ASSERT_FALSE(first_->drives) << n;
        ASSERT_FALSE(second_->drives) << n;
        ASSERT_THAT(world.engine->not_halted(), IsEmpty()) << n;
        for (auto const& session : world.engine->statistics().each_session) ASSERT_THAT(session.bound, IsEmpty()) << n;
    }
    // Each acknowledged command completes once.
    void expect_no_double_answers(std::uint64_t n) {
        if (!desk) return;
        std::map<std::string, int> completed;
        for (auto const& words : desk->received()) {
            auto const at = words.find("completed ");
            if (at == words.npos) continue;
            ASSERT_EQ(++completed[words.substr(at, words.rfind(' ') - at)], 1) << n << ": " << words;
        }
    }
    void expect_to_work_again(std::uint64_t n) {
        auto later = world.connect();
        ASSERT_EQ(later.bind("navigation"), ReturnCode::ok) << n;
        later.execute(go("later", "navigation"));
        ASSERT_EQ(later.result_of("later"), "RUNNING") << n;
        ASSERT_NE(first_->drives, second_->drives) << n;
    }
    void tick_quietly() {
        for (int i = 0; i < 60; ++i) {
            try {
                world.advance(50ms);
            } catch (std::exception const&) {
                // Reports what an earlier failure left, once.
            }
        }
    }

    World world{};
    std::optional<Application> desk;

private:
    class Hand final : public Device {
    public:
        std::function<void()> next;
        void advance(Instant) override {
            if (auto const what = std::exchange(next, nullptr)) what();
        }
    };
    void happen(std::function<void()> what) {
        hand_->next = std::move(what);
        world.advance(50ms);
    }

    std::shared_ptr<Hand> hand_ = std::make_shared<Hand>();
    choosing::Choosing choosing_{{.logical = {"navigation"}, .sensing = {}, .engines = {"robot1", "robot2"}, .areas = {}},
                                 [](std::string const&) {}};
    DrivingComponent* first_ = nullptr;
    DrivingComponent* second_ = nullptr;
};

// Returns false if the history ended before its n-th call.
bool survives(std::uint64_t n, std::uint64_t how_many) {
    TwoRobots robots;
    auto const history = robots.history();
    faults::fail_at(faults::Of::memory, n, how_many);
    for (auto const& step : history) {
        try {
            step();
        } catch (std::exception const&) {
            // A request: its application receives the error.
        }
    }
    bool const failed = faults::stop();
    robots.tick_quietly();
    robots.expect_all_free(n);
    robots.expect_no_double_answers(n);
    robots.expect_to_work_again(n);
    return failed;
}

}  // namespace

class ALogicalComponentWithoutMemory : public testing::TestWithParam<std::uint64_t> {};

TEST_P(ALogicalComponentWithoutMemory, StopsItsMembersAndWorksAgain) {
    std::uint64_t n = 1;
    while (survives(n, GetParam()) && !HasFailure() && n < 20'000) n += faults::step;
    EXPECT_GT(n, 500) << "the history needs memory that often";
}

INSTANTIATE_TEST_SUITE_P(ForCalls, ALogicalComponentWithoutMemory, testing::Values(1, 7, 100));

}  // namespace rois
