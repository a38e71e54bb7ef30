// The time at which something happens, as it is passed to everything below the network layer.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace rois {

using Steady = std::chrono::steady_clock::time_point;
using Utc = std::chrono::system_clock::time_point;

// Two readings of one moment: deadlines are counted on `steady`, which nobody can set; `utc` is what documents show.
struct Instant {
    Steady steady;
    Utc utc;

    Instant operator+(std::chrono::nanoseconds d) const {
        return {steady + d, utc + std::chrono::duration_cast<Utc::duration>(d)};
    }
};

// "2026-11-20T12:00:00.123Z" (W3C-DT, UTC, milliseconds).
std::string to_text(Utc);

// "2026-11-20T12:00:00.123Z", also with an offset ("+09:00"), or without any, which is UTC (decision 28). White space at the ends
// is allowed; digits below a nanosecond are dropped, and years that no clock here can show (before 1678, after 2261) are taken as
// the nearest that it can. Nothing when it is no such text.
std::optional<Utc> to_utc(std::string_view);

// The same moment with Z instead of an offset, every digit of the second kept: "2026-11-20T11:00:00.5Z" of
// "2026-11-20T12:00:00.5+01:00". A text that is not as `to_utc` reads it, or whose year in UTC has not four digits, as it is.
std::string in_utc(std::string_view);

// The time from `begin` to `end`; a moment when they are the same.
struct Period {
    Utc begin;
    Utc end;
    bool operator==(Period const&) const = default;
};

// A moment as `to_utc` reads it; or "2026-11-20", "2026-11", "2026": the day, month or year from its first moment to that of the
// next one, in UTC. Nothing when it is none of them.
std::optional<Period> to_period(std::string_view);

}  // namespace rois
