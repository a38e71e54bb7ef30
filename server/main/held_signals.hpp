// SIGTERM, SIGINT and SIGHUP before the gateway can handle them, and after it has.
#pragma once

#include <signal.h>

namespace rois {

// SIG_BLOCK: from now on they wait, for this thread and those that it starts. SIG_UNBLOCK: they arrive, also those that have
// waited. A gateway that is the first process of a container would otherwise never get those that arrive early.
inline void hold_signals(int how) {
    sigset_t set;
    sigemptyset(&set);
    for (int const number : {SIGTERM, SIGINT, SIGHUP}) sigaddset(&set, number);
    pthread_sigmask(how, &set, nullptr);
}

}  // namespace rois
