// The limit of files, and so of sockets, that the process may have open.
#pragma once

#include <cstddef>

namespace rois {

// Raises the limit to `wanted` if it is lower, as far as the system lets it. Returns the limit that holds then.
std::size_t raise_open_files(std::size_t wanted);

}  // namespace rois
