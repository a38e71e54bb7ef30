// The floor map as a document (schemas/map.xsd).
#pragma once

#include <string>

#include "types/floor_map.hpp"

namespace rois::xml {

std::string encode(FloorMap const&);

}  // namespace rois::xml
