// What the clients that are compared have in common: how long they ask, and what they say in the end.
#pragma once

#include <cstdint>
#include <string>

#include "load/measure.hpp"

namespace rois::bench {

// PORT DOCUMENT SECONDS [blocking]: where the gateway is, a file with the request, how long is measured after a warm-up; whether
// the thread waits for each answer, or goes on when it comes.
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

    // One has come to its end, and the next one begins. False when it was the last.
    bool next();

    // As JSON: the CPU time of this process a round trip, round trips a second, latencies.
    std::string json();

private:
    Nanoseconds measured_;  // how long
    Nanoseconds begun_;     // this round trip
    Nanoseconds from_;      // when the warm-up is over
    Nanoseconds cpu_ = 0;   // then; at the end, what was used since
    Latencies latencies_;
};

// main of a program: `ask` does round trips until there is no `next`. Writes the JSON, and returns the exit code.
int measure_round_trips(int argc, char const* const* argv, void (*ask)(Setting const&, RoundTrips&));

}  // namespace rois::bench
