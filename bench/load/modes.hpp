// What the load generator can do. Each prints one line of JSON about it.
#pragma once

#include "load/options.hpp"

namespace rois::bench {

// Every connection sends a request, waits for its answer, and sends the next.
void make_requests(Options const&);

// Holds connections that say nothing until the standard input ends.
void hold(Options const&);

// Every connection hears of events that one more connection fires.
void hear_events(Options const&);

}  // namespace rois::bench
