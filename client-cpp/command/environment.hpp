// The environment of the `rois` command.
#pragma once

namespace rois::command {

// Reports each ROIS_ variable that no program of the project reads on standard error.
void warn_of_unknown_variables();

}  // namespace rois::command
