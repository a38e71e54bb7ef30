#include "engine/space.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "types/texts.hpp"

namespace rois {

namespace {

std::size_t shared_dimensions(Geometry const& a, Geometry const& b) { return std::min(a.dimensions, b.dimensions); }

}  // namespace

bool share_a_frame(Geometry const& a, Geometry const& b) {
    return a.crs.empty() || b.crs.empty() || equal_ignoring_case(a.crs, b.crs);
}

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

double distance(Geometry const& a, Geometry const& b) {
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
    return text;
}

}  // namespace rois
