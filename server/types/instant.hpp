// Times: readings of the clocks, and texts with times.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace rois {

using Steady = std::chrono::steady_clock::time_point;
using Utc = std::chrono::system_clock::time_point;

// One moment on two clocks: `steady`, which never jumps, for deadlines; `utc` for documents. The network layer passes it to the
// layers below.
struct Instant {
    Steady steady;
    Utc utc;

    Instant operator+(std::chrono::nanoseconds d) const {
        return {steady + d, utc + std::chrono::duration_cast<Utc::duration>(d)};
    }
};

// Returns "2026-11-20T12:00:00.123Z" (W3C-DT, UTC, milliseconds).
std::string to_text(Utc);

// Parses "2026-11-20T12:00:00.123Z". An offset ("+09:00") is allowed; without Z and offset the time is UTC (decision 28). Allows
// white space at the ends. Drops digits below a nanosecond. Clamps years to 1678 to 2261, the range of the clock. Returns nothing
// for any other text.
std::optional<Utc> to_utc(std::string_view);

// Converts a time to UTC and keeps all digits of the second: "2026-11-20T12:00:00.5+01:00" gives "2026-11-20T11:00:00.5Z".
// Returns a text unchanged if `to_utc` rejects it or its year in UTC does not have four digits.
std::string in_utc(std::string_view);

// Returns a time in seconds, with at most three decimals: "0.5 s", "30 s".
std::string in_seconds(std::chrono::nanoseconds);

// The time from `begin` to `end`; a moment if they are equal.
struct Period {
    Utc begin;
    Utc end;
    bool operator==(Period const&) const = default;
};

// Parses a moment as `to_utc` does, or a day, month or year in UTC ("2026-11-20", "2026-11", "2026"), which ends at the first
// moment of the next one. Returns nothing for any other text.
std::optional<Period> to_period(std::string_view);

}  // namespace rois
