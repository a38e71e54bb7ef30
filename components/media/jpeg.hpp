// Pictures as JPEG.
#pragma once

#include <string>

#include "media/media.hpp"

namespace rois::media {

// Throws std::runtime_error when there is no memory for it, std::invalid_argument when the picture has not as many bytes as its
// size says.
std::string jpeg_of(Picture const&);

}  // namespace rois::media
