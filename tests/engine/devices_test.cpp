// Devices: advanced by time, in turns.

#include <optional>

#include "engine/world.hpp"

namespace rois {

namespace {

// Ends its command when the test says so.
class Machine final : public LocalComponent {
public:
    explicit Machine(Part const& part) {
        description_.ref = Application::identifier(part.ref);
        description_.profile = std::make_shared<ComponentProfile const>(part.profile);
        description_.provider = "stage";
        description_.returns_at_once = true;
    }
    void finish() {
        if (running_) port().completed(*std::exchange(running_, {}), CompletedStatus::ok);
    }

    ComponentDescription const& description() const override { return description_; }
    ComponentStatus status() const override { return ComponentStatus::ready; }
    Prepared prepare(std::string_view, ParameterList const&) override {
        return [this](CommandHandle command, Instant) { running_ = command; };
    }
    Halted halt(Instant) override {
        running_.reset();
        return Halted::confirmed;
    }
    void suspend(Instant) override {}
    void resume(Instant) override {}

private:
    ComponentDescription description_;
    std::optional<CommandHandle> running_;
};

// Lets the machine finish in each of its turns.
class Motor final : public Device {
public:
    explicit Motor(Machine& machine) : machine_{machine} {}
    void advance(Instant) override {
        ++turns;
        machine_.finish();
    }
    bool goes_on() const override { return turns % goes_on_until != 0; }

    int turns = 0;
    int goes_on_until = 1;  // turns, a multiple of this

private:
    Machine& machine_;
};

struct Devices : testing::Test {
    World world{navigation};
    std::shared_ptr<Motor> motor;
    Application desk = connect();

    Application connect() {
        auto machine = std::make_unique<Machine>(named("machine", detection));
        motor = std::make_shared<Motor>(*machine);
        world.engine->add(std::move(machine));
        world.engine->add(motor);
        auto application = world.connect();
        application.bind("machine");
        return application;
    }
};

}  // namespace

TEST_F(Devices, HaveATurnInATick) {
    desk.execute(named("one", start("machine")), named("two", start("machine")));
    world.advance(50ms);
    EXPECT_EQ(motor->turns, 1);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed one OK"));
}

TEST_F(Devices, MayHaveAnotherTurnAfterTheirReportsAreHandled) {
    motor->goes_on_until = 3;
    desk.execute(named("one", start("machine")), named("two", start("machine")), named("three", start("machine")));
    world.advance(50ms);
    EXPECT_EQ(motor->turns, 3);
    EXPECT_THAT(desk.received(), ElementsAre("1 completed one OK", "2 completed two OK", "3 completed three OK"));
}

TEST_F(Devices, HaveALimitedNumberOfTurnsInATick) {
    motor->goes_on_until = 1'000'000;
    world.advance(50ms);
    EXPECT_EQ(motor->turns, 100);
    world.advance(50ms);
    EXPECT_EQ(motor->turns, 200) << "the rest is for the next ticks";
}

TEST_F(Devices, AreAdvancedByTheClockAndNotByClients) {
    std::mutex mutex;
    std::unique_lock lock{mutex};
    world.engine->Engine::tick(world.now);
    world.engine->work(lock, world.now, Provider::Runner::client);
    EXPECT_EQ(motor->turns, 0) << "clients do not advance devices";
    world.engine->Engine::tick(world.now);
    world.engine->work(lock, world.now, Provider::Runner::clock);
    EXPECT_EQ(motor->turns, 1);
}

}  // namespace rois
