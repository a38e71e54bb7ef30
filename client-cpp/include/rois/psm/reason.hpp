// Beside the published headers: why an operation of the C++ PSM failed.
#pragma once

#include <string>

namespace rois::psm {

// The reason of the last operation of the C++ PSM that the calling thread has called; empty if that returned OK.
std::string reason();

}  // namespace rois::psm
