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

TEST(Seconds, HaveAtMostThreeDecimals) {
    using namespace std::chrono_literals;
    EXPECT_EQ(in_seconds(30s), "30 s");
    EXPECT_EQ(in_seconds(500ms), "0.5 s");
    EXPECT_EQ(in_seconds(10'050ms), "10.05 s");
    EXPECT_EQ(in_seconds(1'234'567us), "1.235 s");
    EXPECT_EQ(in_seconds(0s), "0 s");
}

TEST(Instant, IsNeverRoundedUp) {
    EXPECT_EQ(to_text(at(2026, 12, 31, 24h - 1us)), "2026-12-31T23:59:59.999Z");
    EXPECT_EQ(to_text(at(1970, 1, 1, -1us)), "1969-12-31T23:59:59.999Z") << "also before the epoch";
}

TEST(Instant, AdditionMovesBothClocks) {
    Instant const noon{Steady{5s}, at(2026, 11, 20, 12h)};
    auto const later = noon + 250ms;
    EXPECT_EQ(later.steady, Steady{5250ms});
    EXPECT_EQ(to_text(later.utc), "2026-11-20T12:00:00.250Z");
}

TEST(Instant, IsReadInUtcOrWithAnOffset) {
    EXPECT_EQ(to_utc("2026-11-20T12:00:00.123Z"), at(2026, 11, 20, 12h + 123ms));
    EXPECT_EQ(to_utc(" 2026-11-20T12:00:00\n"), at(2026, 11, 20, 12h)) << "without an offset it is UTC";
    EXPECT_EQ(to_utc("2026-11-20T12:00:00+09:00"), at(2026, 11, 20, 3h));
    EXPECT_EQ(to_utc("2026-11-20T23:30:00.5-00:45"), at(2026, 11, 21, 15min + 500ms));
    EXPECT_EQ(to_utc("2026-11-20T12:00:00.1234567891Z"), at(2026, 11, 20, 12h + 123'456'789ns));
}

TEST(Instant, ConversionToUtcKeepsAllDigits) {
    EXPECT_EQ(in_utc("2026-11-20T12:00:00+01:00"), "2026-11-20T11:00:00Z");
    EXPECT_EQ(in_utc(" 2026-12-31T23:30:07.1234567891-00:45 "), "2027-01-01T00:15:07.1234567891Z");
    EXPECT_EQ(in_utc(" 2026-11-20T12:00:00.50Z\n"), "2026-11-20T12:00:00.50Z");
    EXPECT_EQ(in_utc("2400-02-29T00:00:00+14:00"), "2400-02-28T10:00:00Z") << "also beyond the range of the clock";
    EXPECT_EQ(in_utc("0001-01-01T00:00:00+01:00"), "0001-01-01T00:00:00+01:00") << "there is no year 0";
    EXPECT_EQ(in_utc("soon"), "soon");
}

TEST(Instant, YearsBeyondTheClockAreClamped) {
    EXPECT_EQ(to_utc("9999-12-31T23:59:59Z"), Utc::max());
    EXPECT_EQ(to_utc("0001-01-01T00:00:00Z"), Utc::min());
}

TEST(Instant, IsNotReadFromOtherTexts) {
    for (auto const* text :
         {"", "now", "2026-11-20", "2026-11-20T12:00", "2026-11-20T24:00:00Z", "2026-02-30T12:00:00Z", "2026-11-20 12:00:00Z",
          "2026-11-20T12:00:00.Z", "2026-11-20T12:00:00+15:00", "2026-11-20T12:00:00Zx", "-026-11-20T12:00:00Z",
          "2026-11-20T12:00:00+14:01", "2026-13-20T12:00:00Z"})
        EXPECT_EQ(to_utc(text), std::nullopt) << text;
}

TEST(Period, IsAMomentADayAMonthOrAYear) {
    EXPECT_EQ(to_period("2026-11-20T12:00:00Z"), (Period{at(2026, 11, 20, 12h), at(2026, 11, 20, 12h)}));
    EXPECT_EQ(to_period("2026-12-31"), (Period{at(2026, 12, 31), at(2027, 1, 1)}));
    EXPECT_EQ(to_period("2026-12"), (Period{at(2026, 12, 1), at(2027, 1, 1)}));
    EXPECT_EQ(to_period(" 2026 "), (Period{at(2026, 1, 1), at(2027, 1, 1)}));
    for (auto const* text : {"", "12:00:00", "2026-00", "2026-02-29", "2026-1", "20261120"})
        EXPECT_EQ(to_period(text), std::nullopt) << text;
}

}  // namespace rois
