#include "types/condition.hpp"

#include <algorithm>
#include <limits>

namespace rois {

void Geometry::fit_corners() {
    constexpr double most = std::numeric_limits<double>::max();
    low = {most, most, 0};
    high = {-most, -most, 0};
    for (auto const& path : paths) {
        for (auto const& point : path) {
            for (std::size_t axis = 0; axis < point.size(); ++axis) {
                low[axis] = std::min(low[axis], point[axis] - radius);
                high[axis] = std::max(high[axis], point[axis] + radius);
            }
        }
    }
}

}  // namespace rois
