// The units of lengths in conditions (`uom`).
#pragma once

#include <optional>
#include <string_view>

namespace rois {

// How many millimetres the unit is long: mm, cm, m, km, or their names in full (metre, meter). Nothing when it is unknown.
std::optional<double> millimetres_in(std::string_view unit);

}  // namespace rois
