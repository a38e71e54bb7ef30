// The log on standard error, one line per event.
#pragma once

#include <memory>

#include "gateway/process/log_queue.hpp"
#include "main/settings.hpp"

namespace rois {

// Ignores SIGPIPE and SIGXFSZ, and opens standard input, output and error if they are closed, so that no socket takes their
// place. Writing to a standard output that was closed still fails. Call this before anything else is opened.
void protect_standard_files();

// Makes spdlog's default logger write to the queue that is returned. At the end of the process, it writes remaining lines for at
// most half a second.
std::shared_ptr<LogQueue const> set_up_logging(LogFormat, LogLevel);

// Its destructor waits until all lines are written, for at most half a second.
struct LogFlush {
    ~LogFlush();
};

}  // namespace rois
