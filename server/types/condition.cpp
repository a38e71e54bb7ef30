#include "types/condition.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "types/text/texts.hpp"

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

namespace {

struct Unit {
    std::string_view name;
    double mm;
};
constexpr std::array<Unit, 12> units{{{"mm", 1},
                                      {"cm", 10},
                                      {"m", 1'000},
                                      {"km", 1'000'000},
                                      {"millimetre", 1},
                                      {"centimetre", 10},
                                      {"metre", 1'000},
                                      {"kilometre", 1'000'000},
                                      {"millimeter", 1},
                                      {"centimeter", 10},
                                      {"meter", 1'000},
                                      {"kilometer", 1'000'000}}};

}  // namespace

std::optional<double> millimetres_in(std::string_view unit) {
    auto const* const found = std::ranges::find(units, trimmed(unit), &Unit::name);
    if (found == units.end()) return {};
    return found->mm;
}

}  // namespace rois
