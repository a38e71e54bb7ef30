// The log: one line an event, on standard error.
#pragma once

#include "main/settings.hpp"

namespace rois {

void set_up_logging(LogFormat, LogLevel);

}  // namespace rois
