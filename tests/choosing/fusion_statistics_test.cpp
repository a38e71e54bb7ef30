// How good the fused positions and names are, over long simulated runs with many seeds.
#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

#include "choosing/record.hpp"

namespace rois::choosing::stage {
namespace {

using std::chrono::milliseconds;

// Two units that sense everybody in the hall.
struct Pair {
    std::string title;
    double period_a, noise_a;  // seconds, metres
    double period_b, noise_b;
    double reports_from = 0;  // metres
    double jitter = 0;        // of the periods, as a part of them
};
std::ostream& operator<<(std::ostream& out, Pair const& pair) { return out << pair.title; }

std::vector<Pair> const pairs{
    {"EquallyGood", 0.1, 0.05, 0.1, 0.05},
    {"OneTwiceAsGood", 0.1, 0.05, 0.1, 0.1},
    {"BothPoor", 0.1, 0.2, 0.1, 0.3},
    {"FourPerSecond", 0.24, 0.05, 0.24, 0.05},
    {"SlowAndGoodFastAndPoor", 0.3, 0.05, 0.1, 0.1},
    {"OnePerSecondAndTwentyPerSecond", 1, 0.05, 0.06, 0.1},
    {"OnePerSecond", 1, 0.1, 1, 0.1},
    {"OnePerSecondIrregularly", 1, 0.1, 1, 0.1, 0, 0.2},
    {"OnChange", 0.24, 0.05, 0.24, 0.05, 0.2},
};

SimulatedUnit unit(std::string name, double period, double noise) {
    SimulatedUnit made;
    made.name = std::move(name);
    made.period = period;
    made.noise = made.claimed = noise;
    return made;
}

std::function<bool(Vector const&)> between(double from, double to) {
    return [=](Vector const& p) { return p.x() >= from && p.x() <= to; };
}

// Runs two minutes with each of eight seeds.
Record recorded(std::function<void(Simulator&, unsigned seed)> const& prepare, int walkers) {
    Record record;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        Simulator world{seed};
        prepare(world, seed);
        world.add_walkers(walkers);
        world.run(120, [&] { record.note(world); });
    }
    return record;
}

class TwoUnits : public testing::TestWithParam<Pair> {
protected:
    // The first and the second unit of a pair.
    static std::pair<SimulatedUnit, SimulatedUnit> units(Pair const& pair) {
        SimulatedUnit a = unit("a", pair.period_a, pair.noise_a);
        SimulatedUnit b = unit("b", pair.period_b, pair.noise_b);
        a.reports_from = b.reports_from = pair.reports_from;
        a.jitter = b.jitter = pair.jitter;
        if (pair.reports_from > 0) a.settings.period = b.settings.period = milliseconds{400};
        b.delay = pair.period_b / 3;
        b.prefix = "visitor-";
        return {a, b};
    }

    static Record run(Pair const& pair) {
        return recorded(
            [&](Simulator& world, unsigned) {
                world.add(units(pair).first);
                world.add(units(pair).second);
            },
            4);
    }

    // The reported standard deviation if there is only this unit.
    static double deviation_alone(SimulatedUnit const& unit) {
        Rms deviation;
        for (unsigned seed = 1; seed <= 4; ++seed) {
            Simulator world{seed};
            world.add(unit);
            world.add_walkers(4);
            world.run(60, [&] {
                for (auto const& person : world.fusion.persons(world.when())) deviation.add(deviation_of(person));
            });
        }
        return deviation.value();
    }
};

TEST_P(TwoUnits, GiveAPositionThatIsBetterThanTheBetterUnits) {
    Record const record = run(GetParam());
    ASSERT_GT(record.fused.count(), 30000);
    EXPECT_LE(record.fused.value(), record.better_unit_held());
    // At the very moment of a list, nothing older can improve the position of a unit with one list per second.
    std::size_t const better = record.better_unit();
    double const period = better == 0 ? GetParam().period_a : GetParam().period_b;
    EXPECT_LE(record.fused_at_lists[better].value(), record.listed[better].value() * (period < 1 ? 1 : 1.02));
}

TEST_P(TwoUnits, ReportAnHonestCovarianceThatIsNotLargerThanTheBetterUnits) {
    Record const record = run(GetParam());
    EXPECT_GE(record.coverage(), 0.93);
    auto const [a, b] = units(GetParam());
    EXPECT_LE(record.deviation.value(), 1.05 * std::min(deviation_alone(a), deviation_alone(b)));
}

TEST_P(TwoUnits, KeepTheNames) {
    Record const record = run(GetParam());
    EXPECT_LT(record.changes_in_ten_minutes(), 0.1);
    EXPECT_EQ(record.shared_names, 0);
}

INSTANTIATE_TEST_SUITE_P(Each, TwoUnits, testing::ValuesIn(pairs), [](auto const& each) { return each.param.title; });

TEST(ThreeUnits, GiveAPositionThatIsBetterThanTheBestUnits) {
    Record const record = recorded(
        [](Simulator& world, unsigned) {
            world.add(unit("a", 0.1, 0.06));
            world.add(unit("b", 0.2, 0.05));
            world.add(unit("c", 0.3, 0.1));
        },
        4);
    EXPECT_LE(record.fused_at_lists[1].value(), record.listed[1].value());
    EXPECT_LE(record.fused.value(), record.better_unit_held());
    EXPECT_GE(record.coverage(), 0.93);
    EXPECT_LE(record.deviation.value(), 0.07);
    EXPECT_EQ(record.name_changes, 0);
}

// Calibration errors: constant, and part of the covariance that the units give.
struct Calibration {
    std::string title;
    double part;  // of the deviation
    bool shared;
};
std::ostream& operator<<(std::ostream& out, Calibration const& c) { return out << c.title; }

class CalibrationErrors : public testing::TestWithParam<Calibration> {};

TEST_P(CalibrationErrors, StayWithinTheReportedEllipse) {
    auto const [title, part, shared] = GetParam();
    Record record;
    for (unsigned seed = 1; seed <= 80; ++seed) {
        Simulator world{seed};
        std::mt19937 random{seed};
        std::normal_distribution<double> normal{0, 0.1 * part};
        SimulatedUnit a = unit("a", 0.2, 0.1 * std::sqrt(1 - part * part));
        a.claimed = 0.1;
        a.bias = {normal(random), normal(random)};
        SimulatedUnit b = a;
        b.name = "b";
        b.delay = 0.08;
        if (!shared) b.bias = {normal(random), normal(random)};
        world.add(a);
        world.add(b);
        world.add_walkers(2);
        world.run(20, [&] { record.note(world); });
    }
    EXPECT_GE(record.coverage(), 0.93);
    EXPECT_LE(record.fused.value(), record.better_unit_held());
    EXPECT_LE(record.deviation.value(), 0.13);
}

INSTANTIATE_TEST_SUITE_P(Each, CalibrationErrors,
                         testing::Values(Calibration{"SharedByBothUnits", 0.7, true},
                                         Calibration{"NearlyAllOfTheError", 0.95, true}, Calibration{"OfEachUnit", 0.7, false}),
                         [](auto const& each) { return each.param.title; });

// Twelve persons in a hall that each of the units sees a part of.
Record crowd(double noise, double drops) {
    return recorded(
        [=](Simulator& world, unsigned) {
            SimulatedUnit a = unit("a", 0.1, noise);
            a.sees = between(0, 7);
            a.drops = drops;
            SimulatedUnit b = a;
            b.name = "b";
            b.sees = between(5, 12);
            b.delay = 0.04;
            world.add(a);
            world.add(b);
        },
        12);
}

TEST(ACrowd, KeepsItsNamesWhileItWalksFromOneViewIntoTheOther) {
    Record const record = crowd(0.05, 0);
    EXPECT_GT(record.presence, 10000);
    EXPECT_LT(record.changes_in_ten_minutes(), 0.1);
    EXPECT_EQ(record.shared_names, 0);
    EXPECT_GE(record.coverage(), 0.93);
}

TEST(ACrowd, KeepsItsNamesWhenUnitsMissPersonsNowAndThen) {
    Record const record = crowd(0.05, 0.05);
    EXPECT_LT(record.changes_in_ten_minutes(), 0.1);
    EXPECT_EQ(record.shared_names, 0);
}

TEST(ACrowd, RarelyChangesNamesEvenWithPoorSensors) {
    Record const record = crowd(0.3, 0);
    EXPECT_LT(record.changes_in_ten_minutes(), 1);
    EXPECT_GE(record.coverage(), 0.93);
}

}  // namespace
}  // namespace rois::choosing::stage
