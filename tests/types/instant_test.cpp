// Decision 28: times are UTC, with milliseconds.
#include "types/instant.hpp"

#include <gtest/gtest.h>

namespace rois {

using namespace std::chrono_literals;

namespace {

Utc at(int year, unsigned month, unsigned day, std::chrono::nanoseconds time = 0ns) {
    using namespace std::chrono;
    return Utc{sys_days{std::chrono::year{year} / month / day}} + duration_cast<Utc::duration>(time);
}

}  // namespace

TEST(Instant, IsWrittenInUtcWithMilliseconds) {
    EXPECT_EQ(to_text(at(2026, 11, 20, 12h + 123ms)), "2026-11-20T12:00:00.123Z");
    EXPECT_EQ(to_text(at(2024, 2, 29, 23h + 59min + 59s + 999ms)), "2024-02-29T23:59:59.999Z");
    EXPECT_EQ(to_text(at(1970, 1, 1)), "1970-01-01T00:00:00.000Z");
}

TEST(Instant, IsNeverRoundedUp) {
    EXPECT_EQ(to_text(at(2026, 12, 31, 24h - 1us)), "2026-12-31T23:59:59.999Z");
    EXPECT_EQ(to_text(at(1970, 1, 1, -1us)), "1969-12-31T23:59:59.999Z") << "before the epoch, too";
}

TEST(Instant, MovesBothItsReadings) {
    Instant const noon{Steady{5s}, at(2026, 11, 20, 12h)};
    auto const later = noon + 250ms;
    EXPECT_EQ(later.steady, Steady{5250ms});
    EXPECT_EQ(to_text(later.utc), "2026-11-20T12:00:00.250Z");
}

}  // namespace rois
