#include "simulation/world/simulation.hpp"

#include "simulation/world_stage.hpp"

#include <gtest/gtest.h>

namespace rois::simulation {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

Instant const beginning{Steady{seconds{1'000}}, Utc{seconds{1'800'000'000}}};

TEST(SimulatedTime, RunsAtTheGivenSpeed) {
    SimulatedTime time{20, WorldTime{20}};
    EXPECT_EQ(time.steps_due(beginning.steady), 0) << "the first call starts the clock";
    EXPECT_EQ(time.steps_due(beginning.steady + milliseconds{100}), 100);
    EXPECT_EQ(time.steps_due(beginning.steady + milliseconds{1'100}), 1'000);
}

TEST(SimulatedTime, LosesNothingBetweenCalls) {
    for (double speed : {0.1, 0.7, 1.0, 3.0, 19.9}) {
        SimulatedTime time{speed, WorldTime{20}};
        Steady now = beginning.steady;
        std::int64_t steps = time.steps_due(now);
        for (int i = 0; i < 10'000; ++i) steps += time.steps_due(now += nanoseconds{7'000'001});
        EXPECT_NEAR(static_cast<double>(steps), 70.00001 * speed / 0.02, 1) << speed;
    }
}

TEST(SimulatedTime, AMachineThatSleptDoesNotCatchUp) {
    SimulatedTime slow{1, WorldTime{20}}, fast{1'000, WorldTime{20}};
    slow.steps_due(beginning.steady);
    fast.steps_due(beginning.steady);
    Steady const next_day = beginning.steady + std::chrono::hours{24};
    EXPECT_EQ(slow.steps_due(next_day), 150) << "three seconds";
    EXPECT_EQ(fast.steps_due(next_day), SimulatedTime::most_steps);
    EXPECT_EQ(slow.steps_due(next_day + milliseconds{20}), 1) << "then normal again";
}

TEST(SimulatedTime, ATimeInThePastCountsAsNoSteps) {
    SimulatedTime time{1, WorldTime{20}};
    time.steps_due(beginning.steady);
    EXPECT_EQ(time.steps_due(beginning.steady - seconds{5}), 0);
    EXPECT_EQ(time.steps_due(beginning.steady + milliseconds{20}), 1);
}

TEST(SimulatedTime, RefusesInvalidSpeeds) {
    for (double speed : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")})
        EXPECT_THROW((SimulatedTime{speed, WorldTime{20}}), std::invalid_argument);
}

// Records the times of notified steps.
class Witness : public Observer {
public:
    explicit Witness(Hall const& hall) : hall_(hall) {}
    void observe(Instant when) override { seen.emplace_back(hall_.now(), when); }
    void time_passed(Instant now) override { times.push_back(now.steady); }
    std::vector<std::pair<WorldTime, Instant>> seen;
    std::vector<Steady> times;

private:
    Hall const& hall_;
};

TEST(Simulation, NotifiesItsObserversOfEveryStepAndItsTime) {
    Simulation simulation{plain_hall(), nobody(), 1, 2.0};
    Witness witness{simulation.hall()};
    simulation.join(witness);
    simulation.advance(beginning);
    simulation.advance(beginning + milliseconds{35});
    ASSERT_EQ(witness.seen.size(), 4u) << "the first call makes the first step";
    for (int i = 0; i < 4; ++i) {
        auto const& [world, when] = witness.seen[static_cast<std::size_t>(i)];
        EXPECT_EQ(world, WorldTime{20 * (i + 1)});
        EXPECT_EQ(when.steady, (beginning + milliseconds{10 * i}).steady);
        EXPECT_EQ(when.utc, (beginning + milliseconds{10 * i}).utc);
    }
    simulation.part(witness);
    simulation.step(beginning);
    EXPECT_EQ(witness.seen.size(), 4u);
    EXPECT_EQ(simulation.hall().now(), WorldTime{100});
}

TEST(Simulation, NotifiesOfRealTimeAtEverySpeed) {
    for (double speed : {0.01, 1.0, 20.0}) {
        Simulation simulation{plain_hall(), nobody(), 1, speed};
        Witness witness{simulation.hall()};
        simulation.join(witness);
        std::vector<Steady> passed;
        for (int i = 0; i < 3; ++i) {
            passed.push_back((beginning + milliseconds{50 * i}).steady);
            simulation.advance(beginning + milliseconds{50 * i});
        }
        EXPECT_EQ(witness.times, passed) << speed;
    }
}

TEST(Simulation, AdvancesOnlyByLetPassAtSpeedZero) {
    Simulation simulation{plain_hall(), nobody(), 1, 0};
    Witness witness{simulation.hall()};
    simulation.join(witness);
    EXPECT_FALSE(simulation.runs_by_itself());
    for (int i = 0; i < 3; ++i) simulation.advance(beginning + seconds{i});
    EXPECT_EQ(simulation.hall().now(), WorldTime{20}) << "the first step";
    EXPECT_FALSE(simulation.goes_on());
    EXPECT_EQ(simulation.let_pass(WorldTime{40}), WorldTime{60});
    EXPECT_EQ(simulation.let_pass(WorldTime{20}), WorldTime{80});
    int steps = 0;
    for (; simulation.goes_on(); ++steps) simulation.advance(beginning + seconds{9});
    EXPECT_EQ(steps, 3) << "one step for each call";
    EXPECT_EQ(simulation.hall().now(), WorldTime{80});
    EXPECT_EQ(witness.seen.back().second.utc, (beginning + seconds{9}).utc);
    simulation.let_pass(WorldTime{60});
    simulation.advance(beginning + seconds{9});
    simulation.stand_still();
    simulation.advance(beginning + seconds{9});
    EXPECT_EQ(simulation.hall().now(), WorldTime{100});
    EXPECT_EQ(simulation.let_pass(WorldTime{20}), WorldTime{120}) << "cancelled time does not count";
}

TEST(Simulation, RefusesInvalidSpeeds) { EXPECT_THROW((Simulation{plain_hall(), nobody(), 1, -1}), std::invalid_argument); }

TEST(Simulation, GivesTheSameHistoryAtEveryFrameRate) {
    FloorPlan const plan = shipped_plan("reception-hall.xml");
    Simulation smooth{plan, reception_day(plan), 9, 10}, jerky{plan, reception_day(plan), 9, 10};
    smooth.advance(beginning);
    jerky.advance(beginning);
    for (int i = 1; i <= 1'000; ++i) smooth.advance(beginning + milliseconds{10 * i});
    for (int i = 1; i <= 5; ++i) jerky.advance(beginning + seconds{2 * i});
    EXPECT_EQ(smooth.hall().now(), WorldTime{100'020});
    EXPECT_EQ(observed(smooth.hall()), observed(jerky.hall()));
}

}  // namespace
}  // namespace rois::simulation
