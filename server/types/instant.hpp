// The time at which something happens, as it is passed to everything below the network layer.
#pragma once

#include <chrono>
#include <string>

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

}  // namespace rois
