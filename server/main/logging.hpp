// The log: one line an event, on standard error.
#pragma once

#include <memory>

#include "main/settings.hpp"
#include "net/log_queue.hpp"

namespace rois {

// Before anything else is opened: SIGPIPE is ignored, and standard input, output and error are open from then on, so that no
// socket takes their place.
void protect_standard_files();

// From then on spdlog's default logger writes there. What it still has is written at the end of the process, or for half a
// second.
std::shared_ptr<net::LogQueue const> set_up_logging(LogFormat, LogLevel);

// Waits for what was said so far, for half a second at most, when it goes.
struct LogFlush {
    ~LogFlush();
};

}  // namespace rois
