#include "engine/frames/shapes.hpp"

#include <algorithm>
#include <boost/geometry/algorithms/correct.hpp>
#include <boost/geometry/algorithms/covered_by.hpp>
#include <boost/geometry/algorithms/distance.hpp>
#include <boost/geometry/algorithms/intersects.hpp>
#include <boost/geometry/algorithms/is_valid.hpp>
#include <boost/geometry/algorithms/relation.hpp>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/linestring.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/geometries/polygon.hpp>
#include <boost/geometry/strategies/strategies.hpp>
#include <string_view>
#include <variant>

namespace rois {

namespace {

namespace bg = boost::geometry;

using Point = bg::model::d2::point_xy<double>;
using Line = bg::model::linestring<Point>;
using Polygon = bg::model::polygon<Point>;
using Plain = std::variant<Point, Line, Polygon>;  // the index is the dimension

constexpr double farthest = 1e12;  // mm; beyond it, products of coordinates lose precision

bool is_circle(Geometry const& geometry) { return geometry.shape == Geometry::Shape::circle; }

Point at(double x, double y) { return {std::clamp(x, -farthest, farthest), std::clamp(y, -farthest, farthest)}; }

template <class Path>
Path path_of(Geometry::Points const& points) {
    Path path;
    for (auto const& [x, y] : points) path.push_back(at(x, y));
    return path;
}

Polygon polygon_of(std::vector<Geometry::Points> const& paths) {
    Polygon polygon;
    polygon.outer() = path_of<Polygon::ring_type>(paths.front());
    for (std::size_t i = 1; i < paths.size(); ++i) polygon.inners().push_back(path_of<Polygon::ring_type>(paths[i]));
    bg::correct(polygon);  // the direction of each border
    return polygon;
}

Plain box_of(Geometry const& box) {
    auto const low = at(box.low[0], box.low[1]), high = at(box.high[0], box.high[1]);
    bool const is_wide = low.x() < high.x(), is_deep = low.y() < high.y();
    if (!is_wide && !is_deep) return low;
    if (!is_wide || !is_deep) return Line{low, high};
    return Polygon{{low, {low.x(), high.y()}, high, {high.x(), low.y()}, low}};
}

// For all shapes except circles.
Plain plain(Geometry const& geometry) {
    switch (geometry.shape) {
        case Geometry::Shape::line:
            return path_of<Line>(geometry.paths.front());
        case Geometry::Shape::polygon:
            return polygon_of(geometry.paths);
        case Geometry::Shape::box:
        case Geometry::Shape::circle:
            break;
    }
    return box_of(geometry);
}

double distance(Plain const& a, Plain const& b) {
    return std::visit([](auto const& one, auto const& other) -> double { return bg::distance(one, other); }, a, b);
}

// --- Lines, polygons, boxes and points ---

// Compares a matrix of the dimensionally extended nine-intersection model with a pattern: 'T' is any intersection, 'F' none, '*'
// either, a digit an intersection of that dimension.
bool fits(std::string_view matrix, std::string_view pattern) {
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        bool const fit = pattern[i] == '*' || (pattern[i] == 'T' ? matrix[i] != 'F' : matrix[i] == pattern[i]);
        if (!fit) return false;
    }
    return true;
}

bool holds(SpatialRelation relation, Plain const& a, Plain const& b) {
    auto const matrix = std::visit([](auto const& one, auto const& other) { return bg::relation(one, other).str(); }, a, b);
    auto const any_of = [&](auto const... patterns) { return (fits(matrix, patterns) || ...); };
    bool const are_lines = a.index() == 1 && b.index() == 1;
    switch (relation) {
        case SpatialRelation::within:
            return any_of("T*F**F***", "*TF**F***", "**FT*F***", "**F*TF***");
        case SpatialRelation::contains:
            return any_of("T*****FF*", "*T****FF*", "***T**FF*", "****T*FF*");
        case SpatialRelation::intersects:
            return !fits(matrix, "FF*FF****");
        case SpatialRelation::disjoint:
            return fits(matrix, "FF*FF****");
        case SpatialRelation::equals:
            return fits(matrix, "T*F**FFF*");
        case SpatialRelation::touches:
            return any_of("FT*******", "F**T*****", "F***T****");
        case SpatialRelation::overlaps:
            return a.index() == b.index() && fits(matrix, are_lines ? "1*T***T**" : "T*T***T**");
        case SpatialRelation::crosses:
            break;
    }
    if (a.index() == b.index()) return are_lines && fits(matrix, "0********");
    return fits(matrix, a.index() < b.index() ? "T*T******" : "T*****T**");
}

// --- Circles ---

struct Circle {
    explicit Circle(Geometry const& geometry)
        : centre{at(geometry.paths.front().front()[0], geometry.paths.front().front()[1])}, radius{geometry.radius} {}

    Point centre;
    double radius;
};

// All corners lie in the circle; so do the edges between them.
bool lies_in(Plain const& inner, Circle const& circle) {
    auto const is_in = [&](Point const& point) { return bg::distance(point, circle.centre) <= circle.radius + circle_tolerance; };
    if (auto const* point = std::get_if<Point>(&inner)) return is_in(*point);
    if (auto const* line = std::get_if<Line>(&inner)) return std::ranges::all_of(*line, is_in);
    return std::ranges::all_of(std::get<Polygon>(inner).outer(), is_in);
}

// The centre lies in the polygon, and no edge is nearer than the radius.
bool lies_in(Circle const& circle, Plain const& outer) {
    auto const* polygon = std::get_if<Polygon>(&outer);
    if (polygon == nullptr || !bg::covered_by(circle.centre, *polygon)) return false;
    auto const is_clear = [&](auto const& border) {
        return bg::distance(circle.centre, Line{border.begin(), border.end()}) >= circle.radius - circle_tolerance;
    };
    return is_clear(polygon->outer()) && std::ranges::all_of(polygon->inners(), is_clear);
}

bool holds(SpatialRelation relation, Circle const& circle, Plain const& other) {
    double const away = distance(circle.centre, other) - circle.radius;  // distance of the other from the edge; negative inside
    bool const intersects = away <= circle_tolerance;
    bool const inside = away < -circle_tolerance;  // a part of the other is inside the edge
    switch (relation) {
        case SpatialRelation::within:
            return lies_in(circle, other);
        case SpatialRelation::contains:
            return lies_in(other, circle);
        case SpatialRelation::intersects:
            return intersects;
        case SpatialRelation::disjoint:
            return !intersects;
        case SpatialRelation::equals:
            return false;
        case SpatialRelation::touches:
            return intersects && !inside;
        case SpatialRelation::overlaps:
            return inside && other.index() == 2 && !lies_in(circle, other) && !lies_in(other, circle);
        case SpatialRelation::crosses:
            break;
    }
    return inside && other.index() == 1 && !lies_in(other, circle);
}

bool holds(SpatialRelation relation, Circle const& a, Circle const& b) {
    double const apart = bg::distance(a.centre, b.centre);
    bool const a_in_b = apart + a.radius <= b.radius + circle_tolerance;
    bool const b_in_a = apart + b.radius <= a.radius + circle_tolerance;
    bool const intersect = apart <= a.radius + b.radius + circle_tolerance;
    bool const inside = apart < a.radius + b.radius - circle_tolerance;
    switch (relation) {
        case SpatialRelation::within:
            return a_in_b;
        case SpatialRelation::contains:
            return b_in_a;
        case SpatialRelation::intersects:
            return intersect;
        case SpatialRelation::disjoint:
            return !intersect;
        case SpatialRelation::equals:
            return a_in_b && b_in_a;
        case SpatialRelation::touches:
            return intersect && !inside;
        case SpatialRelation::overlaps:
            return inside && !a_in_b && !b_in_a;
        case SpatialRelation::crosses:
            break;
    }
    return false;
}

SpatialRelation the_other_way_round(SpatialRelation relation) {
    if (relation == SpatialRelation::within) return SpatialRelation::contains;
    return relation == SpatialRelation::contains ? SpatialRelation::within : relation;
}

// A cheap check that settles most comparisons.
bool boxes_are_apart(Geometry const& a, Geometry const& b) {
    for (std::size_t axis = 0; axis < 2; ++axis)
        if (a.high[axis] + circle_tolerance < b.low[axis] || b.high[axis] + circle_tolerance < a.low[axis]) return true;
    return false;
}

std::string_view what_is_wrong(bg::validity_failure_type failure) {
    switch (failure) {
        case bg::failure_few_points:
        case bg::failure_wrong_topological_dimension:
        case bg::failure_spikes:
            return "whose points enclose no area, or run back along an edge";
        case bg::failure_self_intersections:
        case bg::failure_wrong_orientation:  // after `correct`: its parts cancel each other out
            return "whose edges cross or touch one another";
        case bg::failure_interior_rings_outside:
        case bg::failure_nested_interior_rings:
        case bg::failure_disconnected_interior:
            return "whose holes are not inside it, are inside one another, or cut it in two";
        default:
            return "that is invalid";
    }
}

}  // namespace

bool holds_in_plane(SpatialRelation relation, Geometry const& a, Geometry const& b) {
    if (boxes_are_apart(a, b)) return relation == SpatialRelation::disjoint;
    if (is_circle(a)) return is_circle(b) ? holds(relation, Circle{a}, Circle{b}) : holds(relation, Circle{a}, plain(b));
    return is_circle(b) ? holds(the_other_way_round(relation), Circle{b}, plain(a)) : holds(relation, plain(a), plain(b));
}

double distance_in_plane(Geometry const& a, Geometry const& b) {
    auto const without_radius = [](Geometry const& geometry) {
        return is_circle(geometry) ? Plain{Circle{geometry}.centre} : plain(geometry);
    };
    return std::max(0.0, distance(without_radius(a), without_radius(b)) - a.radius - b.radius);
}

namespace {

using Box = bg::model::box<Point>;

// The bounding boxes of its edges; four times the same one for a box.
std::vector<Box> edges_of(Geometry const& geometry) {
    auto const around = [](double x, double y, double to_x, double to_y) {
        return Box{at(std::min(x, to_x), std::min(y, to_y)), at(std::max(x, to_x), std::max(y, to_y))};
    };
    auto const whole = around(geometry.low[0], geometry.low[1], geometry.high[0], geometry.high[1]);
    if (geometry.shape == Geometry::Shape::box) return std::vector<Box>(4, whole);
    if (is_circle(geometry)) return {whole};
    std::vector<Box> edges;
    for (auto const& path : geometry.paths)
        for (std::size_t i = 1; i < path.size(); ++i)
            edges.push_back(around(path[i - 1][0], path[i - 1][1], path[i][0], path[i][1]));
    return edges;
}

}  // namespace

std::optional<std::string> why_invalid(Geometry const& geometry) {
    for (std::size_t axis = 0; axis < 2; ++axis)
        if (!(geometry.low[axis] >= -farthest) || !(geometry.high[axis] <= farthest))
            return "geometry with a coordinate beyond 1e12 mm";
    if (is_circle(geometry)) {
        if (geometry.radius > 0) return {};
        return "circle whose radius is not above 0";
    }
    auto failure = bg::no_failure;
    if (geometry.shape == Geometry::Shape::line) {
        if (bg::is_valid(path_of<Line>(geometry.paths.front()), failure)) return {};
        return "line whose points are all the same";
    }
    if (bg::is_valid(polygon_of(geometry.paths), failure)) return {};
    return "polygon " + std::string{what_is_wrong(failure)};
}

std::size_t meeting_edges(Geometry const& a, Geometry const& b) {
    auto const ones = edges_of(a), others = edges_of(b);
    std::size_t pairs = 0;
    for (auto const& one : ones)
        for (auto const& other : others)
            if (bg::intersects(one, other)) ++pairs;
    return pairs;
}

}  // namespace rois
