// Encodes pictures as JPEG.
#pragma once

#include <string>

#include "media/media.hpp"

namespace rois::media {

// Throws std::invalid_argument if the number of bytes does not fit the picture's size, std::runtime_error if encoding fails.
std::string jpeg_of(Picture const&);

}  // namespace rois::media
