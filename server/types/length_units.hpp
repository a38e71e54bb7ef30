// The units of lengths in conditions (`uom`).
#pragma once

#include <optional>
#include <string_view>

namespace rois {

// Returns the length of a unit in millimetres: mm, cm, m, km, or their full names (metre, meter); nothing if it is unknown.
std::optional<double> millimetres_in(std::string_view unit);

}  // namespace rois
