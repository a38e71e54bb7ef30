// The modes of the load generator. Each prints its results as one line of JSON.
#pragma once

#include "load/options.hpp"

namespace rois::bench {

// Every connection sends a request, waits for its answer, and sends the next.
void make_requests(Options const&);

// Holds silent connections until the standard input ends.
void hold(Options const&);

// Every connection receives events. One additional connection fires them.
void receive_events(Options const&);

}  // namespace rois::bench
