// The engine's clock: a thread of its own, so that no request and no connection can keep it from ticking.
#pragma once

#include <pthread.h>

#include <chrono>
#include <thread>

#include "gateway/gateway.hpp"
#include "gateway/process/troubles.hpp"

namespace rois {

// Calls Gateway::tick periodically on a thread named "clock" while it lives, and Gateway::handle_reports when components have
// reported something. An exception is reported, and does not delay the next tick.
class Clock {
public:
    Clock(std::chrono::milliseconds between_ticks, Gateway& gateway, Troubles& troubles)
        : thread_{[between_ticks, &gateway, &troubles](std::stop_token const& stop) {
              ::pthread_setname_np(::pthread_self(), "clock");
              auto next = std::chrono::steady_clock::now() + between_ticks;
              while (!stop.stop_requested()) {
                  bool const reported = gateway.await_reports(next) && std::chrono::steady_clock::now() < next;
                  try {
                      reported ? gateway.handle_reports() : gateway.tick();
                  } catch (...) {
                      troubles.report(Troubles::Where::tick);
                  }
                  if (!reported) next = std::chrono::steady_clock::now() + between_ticks;
              }
          }} {}

private:
    std::jthread thread_;
};

}  // namespace rois
