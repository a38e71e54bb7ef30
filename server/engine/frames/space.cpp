#include "engine/frames/space.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "engine/frames/shapes.hpp"
#include "types/text/texts.hpp"

namespace rois {

namespace {

std::size_t shared_dimensions(Geometry const& a, Geometry const& b) { return std::min(a.dimensions, b.dimensions); }

bool is_within(Geometry const& inner, Geometry const& outer) {
    for (std::size_t axis = 0; axis < shared_dimensions(inner, outer); ++axis)
        if (inner.low[axis] < outer.low[axis] || inner.high[axis] > outer.high[axis]) return false;
    return true;
}

bool intersect(Geometry const& a, Geometry const& b) {
    for (std::size_t axis = 0; axis < shared_dimensions(a, b); ++axis)
        if (a.high[axis] < b.low[axis] || b.high[axis] < a.low[axis]) return false;
    return true;
}

// The number of axes along which a box extends: 0 for a point, 1 for a line, 2 for an area.
std::size_t extent(Geometry const& box, std::size_t axes) {
    std::size_t count = 0;
    for (std::size_t axis = 0; axis < axes; ++axis) count += box.low[axis] < box.high[axis] ? 1 : 0;
    return count;
}

// The number of axes along which the two overlap in more than one coordinate.
std::size_t extent_in_common(Geometry const& a, Geometry const& b) {
    std::size_t count = 0;
    for (std::size_t axis = 0; axis < shared_dimensions(a, b); ++axis)
        count += std::max(a.low[axis], b.low[axis]) < std::min(a.high[axis], b.high[axis]) ? 1 : 0;
    return count;
}

// The interior of a point is the point. The interior of a box has no edges.
bool interiors_intersect(Geometry const& a, Geometry const& b) {
    auto const is_inside = [](double at, double low, double high) { return low == high ? at == low : low < at && at < high; };
    for (std::size_t axis = 0; axis < shared_dimensions(a, b); ++axis) {
        bool const a_is_thin = a.low[axis] == a.high[axis], b_is_thin = b.low[axis] == b.high[axis];
        bool const meet = a_is_thin   ? is_inside(a.low[axis], b.low[axis], b.high[axis])
                          : b_is_thin ? is_inside(b.low[axis], a.low[axis], a.high[axis])
                                      : a.low[axis] < b.high[axis] && b.low[axis] < a.high[axis];
        if (!meet) return false;
    }
    return true;
}

bool overlap(Geometry const& a, Geometry const& b) {
    auto const axes = shared_dimensions(a, b);
    auto const size = extent(a, axes);
    return size == extent(b, axes) && interiors_intersect(a, b) && extent_in_common(a, b) == size && !is_within(a, b) &&
           !is_within(b, a);
}

bool cross(Geometry const& a, Geometry const& b) {
    if (!interiors_intersect(a, b)) return false;
    auto const axes = shared_dimensions(a, b);
    auto const size_of_a = extent(a, axes), size_of_b = extent(b, axes);
    if (size_of_a == size_of_b) return size_of_a == 1 && extent_in_common(a, b) == 0;
    return size_of_a < size_of_b ? !is_within(a, b) : !is_within(b, a);
}

}  // namespace

bool share_a_frame(Geometry const& a, Geometry const& b) {
    return a.crs.empty() || b.crs.empty() || equal_ignoring_case(a.crs, b.crs);
}

bool holds(SpatialRelation relation, Geometry const& a, Geometry const& b) {
    if (a.shape != Geometry::Shape::box || b.shape != Geometry::Shape::box) return holds_in_plane(relation, a, b);
    switch (relation) {
        case SpatialRelation::within:
            return is_within(a, b);
        case SpatialRelation::contains:
            return is_within(b, a);
        case SpatialRelation::intersects:
            return intersect(a, b);
        case SpatialRelation::disjoint:
            return !intersect(a, b);
        case SpatialRelation::equals:
            return is_within(a, b) && is_within(b, a);
        case SpatialRelation::touches:
            return intersect(a, b) && !interiors_intersect(a, b);
        case SpatialRelation::overlaps:
            return overlap(a, b);
        case SpatialRelation::crosses:
            break;
    }
    return cross(a, b);
}

double distance(Geometry const& a, Geometry const& b) {
    if (a.shape != Geometry::Shape::box || b.shape != Geometry::Shape::box) return distance_in_plane(a, b);
    double sum = 0;
    for (std::size_t axis = 0; axis < shared_dimensions(a, b); ++axis) {
        double const gap = std::max({0.0, a.low[axis] - b.high[axis], b.low[axis] - a.high[axis]});
        sum += gap * gap;
    }
    return std::sqrt(sum);
}

Geometry point(Located const& located) {
    return {.crs = located.crs, .low = located.position, .high = located.position, .dimensions = 3};
}

std::optional<Geometry> point(std::string_view text, std::string crs) {
    std::array<double, 3> read{};
    std::size_t count = 0;
    for (bool more = true; more; ++count) {
        auto const comma = text.find(',');
        auto const number = to_double(text.substr(0, comma));
        if (!number || !std::isfinite(*number) || count == read.size()) return {};
        read[count] = *number;
        more = comma != std::string_view::npos;
        text.remove_prefix(more ? comma + 1 : text.size());
    }
    if (count < 2) return {};
    std::array<double, 3> const position{read[0], read[1], 0};
    return Geometry{.crs = std::move(crs), .low = position, .high = position, .dimensions = 2};
}

std::string canonical(double number) {
    std::array<char, 32> text{};
    auto const [end, problem] = std::to_chars(text.data(), text.data() + text.size(), number == 0 ? 0.0 : number);
    return {text.data(), end};
}

std::string canonical(Geometry const& geometry) {
    std::string text = "G" + lower_case(geometry.crs);
    for (std::size_t axis = 0; axis < geometry.dimensions; ++axis)
        text += ";" + canonical(geometry.low[axis]) + ":" + canonical(geometry.high[axis]);
    if (geometry.shape == Geometry::Shape::box) return text;
    text += ";" + std::to_string(static_cast<int>(geometry.shape)) + ";" + canonical(geometry.radius);
    for (auto const& path : geometry.paths) {
        text += ";";
        for (auto const& [x, y] : path) text += canonical(x) + ":" + canonical(y) + ",";
    }
    return text;
}

}  // namespace rois
