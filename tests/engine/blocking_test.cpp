// Components that block, on threads of their own (decision 36).
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "engine/asynchronous.hpp"
#include "engine/local_component.hpp"

namespace rois {

namespace {

// A driver whose queries block until the test lets them go on.
class Blocking final : public LocalComponent {
public:
    struct Gate {
        std::mutex mutex;
        std::condition_variable opened;
        bool open = false;
        std::atomic<int> waiting = 0;
        std::atomic<int> destroyed = 0;

        void pass() {
            std::unique_lock lock{mutex};
            ++waiting;
            opened.wait(lock, [this] { return open; });
            --waiting;
        }
        void let_pass() {
            {
                std::lock_guard const lock{mutex};
                open = true;
            }
            opened.notify_all();
        }
    };

    Blocking(Part const& part, std::shared_ptr<Gate> gate) : gate_{std::move(gate)} {
        description_.ref = Application::identifier(part.ref);
        description_.profile = std::make_shared<ComponentProfile const>(part.profile);
    }
    ~Blocking() override { ++gate_->destroyed; }
    Blocking(Blocking const&) = delete;
    Blocking& operator=(Blocking const&) = delete;

    ComponentDescription const& description() const override { return description_; }
    ComponentStatus status() const override { return ComponentStatus::ready; }
    Prepared prepare(std::string_view, ParameterList const&) override {
        return [this](CommandHandle command, Instant) {
            gate_->pass();
            port().completed(command, CompletedStatus::ok);
        };
    }
    Halted halt(Instant) override { return Halted::confirmed; }
    void suspend(Instant) override {}
    void resume(Instant) override {}
    std::vector<Results> query(std::string_view, Instant) override {
        gate_->pass();
        return {{{Parameter{"length", {"double", {}, {}, {}}, {"2.5"}}}, {}}};
    }

private:
    std::shared_ptr<Gate> gate_;
    ComponentDescription description_;
};

template <class What>
bool comes(What const& what) {
    for (auto const end = std::chrono::steady_clock::now() + 5s; std::chrono::steady_clock::now() < end;) {
        if (what()) return true;
        std::this_thread::yield();
    }
    return false;
}

struct Blocked : Asynchronous {
    std::shared_ptr<Blocking::Gate> gate = std::make_shared<Blocking::Gate>();
    std::atomic<int> rings = 0;

    Blocked() {
        world.engine->on_report([this] { ++rings; });
        world.engine->add(std::make_unique<Blocking>(named("driver", navigation), gate));
        EXPECT_TRUE(comes([&] { return rings > 0; })) << "it has reported its status";
        work();
    }
    ~Blocked() override { gate->let_pass(); }
};

}  // namespace

TEST_F(Blocked, ADriverDelaysOnlyItsOwnComponents) {
    auto desk = world.connect();
    desk.bind("speech");
    auto const asked = query(desk);
    ASSERT_TRUE(comes([&] { return gate->waiting > 0; }));
    EXPECT_FALSE(asked->said);
    EXPECT_EQ(code_of(*execute(desk, say("say"))), ReturnCode::ok);
    EXPECT_EQ(code_of(*execute(desk, named("stop", rois::stop("speech")))), ReturnCode::ok);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed say ABORT", "2 completed stop OK"));
    world.advance(1s);
    EXPECT_EQ(code_of(*asked), ReturnCode::timeout);
    EXPECT_EQ(world.engine->statistics().errors, 1U);
}

TEST_F(Blocked, AnAnswerOfAnotherThreadWakesTheEngineAtOnce) {
    auto desk = world.connect();
    auto const asked = query(desk);
    ASSERT_TRUE(comes([&] { return gate->waiting > 0; }));
    int const before = rings;
    gate->let_pass();
    ASSERT_TRUE(comes([&] { return rings > before; }));
    work();
    EXPECT_EQ(code_of(*asked), ReturnCode::ok);
}

TEST_F(Blocked, AHaltBehindABlockedCallIsNotConfirmed) {
    auto desk = world.connect();
    desk.bind("driver");
    auto const started = execute(desk, go("go", "driver"));
    ASSERT_TRUE(comes([&] {
        work();
        return gate->waiting > 0;
    }));
    EXPECT_EQ(code_of(*started), ReturnCode::ok);
    desk.execute(named("stop", rois::stop("driver")));
    world.advance(500ms);
    EXPECT_THAT(desk.received(), testing::Contains(HasSubstr("completed stop TIMEOUT")));
    EXPECT_THAT(world.engine->not_halted(), ElementsAre("driver"));
    gate->let_pass();
    EXPECT_TRUE(comes([&] {
        work();
        return world.engine->not_halted().empty();
    }));
}

TEST_F(Blocked, TheEngineCanEndWhileADriverBlocks) {
    auto desk = world.connect();
    query(desk);
    ASSERT_TRUE(comes([&] { return gate->waiting > 0; }));
    world.engine.reset();
    EXPECT_EQ(gate->destroyed, 0);
    gate->let_pass();
    EXPECT_TRUE(comes([&] { return gate->destroyed == 1; })) << "its thread ends alone";
}

TEST_F(Blocked, ADriverThatLeavesIsDestroyedWhenItsCallReturns) {
    auto desk = world.connect();
    query(desk);
    ASSERT_TRUE(comes([&] { return gate->waiting > 0; }));
    world.engine->change(leaving("driver"), world.now);
    EXPECT_THAT(desk.search(), ElementsAre("speech"));
    EXPECT_EQ(gate->destroyed, 0);
    gate->let_pass();
    EXPECT_TRUE(comes([&] { return gate->destroyed == 1; }));
}

}  // namespace rois
