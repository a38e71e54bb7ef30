// The engine's clock: a thread of its own, so that no request and no connection can keep it from ticking.
#pragma once

#include <pthread.h>

#include <chrono>
#include <functional>
#include <thread>

#include "gateway/process/troubles.hpp"

namespace rois {

// Calls `tick` periodically on a thread named "clock" while it lives. An exception of a tick is reported, and does not delay
// the next tick.
class Clock {
public:
    Clock(std::chrono::milliseconds between_ticks, std::function<void()> tick, Troubles& troubles)
        : thread_{[between_ticks, tick = std::move(tick), &troubles](std::stop_token const& stop) {
              ::pthread_setname_np(::pthread_self(), "clock");
              while (!stop.stop_requested()) {
                  std::this_thread::sleep_for(between_ticks);
                  try {
                      tick();
                  } catch (...) {
                      troubles.report(Troubles::Where::tick);
                  }
              }
          }} {}

private:
    std::jthread thread_;
};

}  // namespace rois
