// An addition to the published headers: why an operation of the C++ PSM failed.
#pragma once

#include <string>

namespace rois::psm {

// Returns why the last operation that the calling thread called has failed; empty if it returned OK.
std::string reason();

}  // namespace rois::psm
