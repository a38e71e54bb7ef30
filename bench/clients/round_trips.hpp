// The parts that the compared clients share: arguments, duration, and the printed result.
#pragma once

#include <cstdint>
#include <string>

#include "load/measure.hpp"

namespace rois::bench {

// The arguments PORT DOCUMENT SECONDS [blocking]: the gateway's port, a file with the request, the duration of the measurement
// after a warm-up, and whether the thread blocks until each answer has arrived.
struct Setting {
    std::uint16_t port = 0;
    std::string document;
    double seconds = 0;
    bool blocking = false;
};

// Throws std::runtime_error.
Setting read_setting(int argc, char const* const* argv);

class RoundTrips {
public:
    explicit RoundTrips(double seconds);

    // Ends a round trip and begins the next one. Returns false if it was the last.
    bool next();

    // Returns the CPU time of this process per round trip, round trips per second, and latencies, as JSON.
    std::string json();

private:
    Nanoseconds measured_;  // duration
    Nanoseconds begun_;     // this round trip
    Nanoseconds from_;      // when the warm-up is over
    Nanoseconds cpu_ = 0;   // CPU time at `from_`; at the end, the CPU time used since
    Latencies latencies_;
};

// `main` of a program: `ask` makes round trips until `next` returns false. Prints the JSON and returns the exit code.
int measure_round_trips(int argc, char const* const* argv, void (*ask)(Setting const&, RoundTrips&));

}  // namespace rois::bench
