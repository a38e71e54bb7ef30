// ROIS_SCHEDULES: how many schedules; ROIS_FIRST_SCHEDULE: the seed of the first one. A failure names its seed.
#include <gtest/gtest.h>

#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>

#include "schedules/schedule.hpp"

namespace rois::schedules {

namespace {

constexpr std::uint64_t with_hall = 20;  // every twentieth schedule is one with a sub engine: it takes ten times as long

std::uint64_t number_in(char const* variable, std::uint64_t otherwise) {
    auto const* const text = std::getenv(variable);
    return text == nullptr ? otherwise : std::stoull(text);
}

}  // namespace

TEST(Schedules, BreakNoPromise) {
    auto const first = number_in("ROIS_FIRST_SCHEDULE", 1), many = number_in("ROIS_SCHEDULES", 2'000);
    for (auto seed = first; seed < first + many; ++seed) {
        auto const over = seed % with_hall == 0 ? Over::sub_engine : Over::one_engine;
        auto const broken = Schedule{seed, over}.run();
        if (broken.empty()) continue;
        std::ostringstream story;
        Schedule{seed, over, &story}.run();
        for (auto const& promise : broken) ADD_FAILURE() << "ROIS_FIRST_SCHEDULE=" << seed << ": " << promise;
        std::cout << story.str();
        return;
    }
}

}  // namespace rois::schedules
