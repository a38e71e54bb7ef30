// Random histories of three service applications: the engine behaves like the reference. A reference with a flaw is detected, and
// a few steps show it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "model/difference.hpp"

namespace rois::model {
namespace {

constexpr std::size_t steps_a_history = 200;

TEST(Model, HistoriesMatchTheReference) {
    for (std::uint64_t seed = 1; seed <= 1'000; ++seed) {
        auto const found = difference(random_steps(seed, steps_a_history));
        ASSERT_FALSE(found.has_value()) << "seed " << seed << ": " << shrunk(*found).in_words();
    }
}

TEST(Model, HistoriesAreTheSameForTheSameSeed) {
    EXPECT_EQ(in_lines(random_steps(7, steps_a_history)), in_lines(random_steps(7, steps_a_history)));
    EXPECT_NE(in_lines(random_steps(7, steps_a_history)), in_lines(random_steps(8, steps_a_history)));
}

// A flaw, and the maximum number of steps that show it.
struct Shown {
    char const* name;
    Flaw flaw;
    std::size_t most_steps;
};

std::ostream& operator<<(std::ostream& out, Shown const& shown) { return out << shown.name; }

struct Flawed : testing::TestWithParam<Shown> {};

TEST_P(Flawed, ReferenceIsDetected) {
    auto const [name, flaw, most_steps] = GetParam();
    std::optional<Difference> found;
    for (std::uint64_t seed = 1; !found && seed <= 300; ++seed) found = difference(random_steps(seed, steps_a_history), flaw);
    ASSERT_TRUE(found.has_value());
    auto const shortest = shrunk(*found, flaw);
    EXPECT_LE(shortest.steps.size(), most_steps) << shortest.in_words();
    EXPECT_FALSE(difference(shortest.steps).has_value()) << "the flaw causes the difference";
}

INSTANTIATE_TEST_SUITE_P(WhoBelievesThat, Flawed,
                         testing::Values(Shown{"ABindingIsShared", Flaw::binding_is_shared, 4},
                                         Shown{"ReleaseLetsRunOn", Flaw::release_lets_run_on, 5},
                                         Shown{"ANameMayComeAgain", Flaw::a_name_may_come_again, 5},
                                         Shown{"AFailureEndsNothing", Flaw::a_failure_ends_nothing, 5},
                                         Shown{"BranchesRunInSequence", Flaw::branches_run_in_sequence, 5},
                                         Shown{"ADelayIsATickLonger", Flaw::a_delay_is_a_tick_longer, 5},
                                         Shown{"StopCompletesStartWithOk", Flaw::stop_completes_start_with_ok, 5},
                                         Shown{"ResultsAreKeptForEver", Flaw::results_are_kept_for_ever, 10},
                                         Shown{"SubscribingTwiceNotifiesTwice", Flaw::subscribing_twice_notifies_twice, 5},
                                         Shown{"BadValuesAreStored", Flaw::bad_values_are_stored, 4},
                                         Shown{"ValuesOutliveTheBinding", Flaw::values_outlive_the_binding, 7},
                                         Shown{"AnybodyReadsStoredValues", Flaw::anybody_reads_stored_values, 6}),
                         testing::PrintToStringParamName());

// A counterexample is printed in a few lines.
TEST(Model, PrintsTheShortestHistoryThatDiffers) {
    std::optional<Difference> found;
    for (std::uint64_t seed = 1; !found; ++seed) found = difference(random_steps(seed, steps_a_history), Flaw::binding_is_shared);
    EXPECT_THAT(shrunk(*found, Flaw::binding_is_shared).in_words(),
                testing::MatchesRegex("after\n"
                                      "(  application [0-2]: (connect|bind [a-z]+)\n)+"
                                      "expected: OK\n"
                                      "found:    OUT_OF_RESOURCES"));
}

}  // namespace
}  // namespace rois::model
