// The environment variables of the `rois` command.
#pragma once

namespace rois::command {

// Warns on standard error of each ROIS_ variable that no program of the project reads.
void warn_of_unknown_variables();

}  // namespace rois::command
