
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "types/condition.hpp"
#include "types/text/texts.hpp"
#include "xml/codec/decoding.hpp"
#include "xml/codec/writer.hpp"

namespace rois::xml {

namespace {

using Node = MessageTree::Node;

// Returns whether every word of a text is `word`, as in "mm mm".
bool all_words_are(std::string_view text, std::string_view word) {
    for (text = trimmed(text); !text.empty();) {
        auto const item = text.substr(0, text.find_first_of(" \t\r\n"));
        if (item != word) return false;
        text = trimmed(text.substr(item.size()));
    }
    return true;
}

// The frame of coordinates. Attributes of an inner element override those of the element around it.
struct Frame {
    std::string crs;
    std::size_t dimensions = 0;  // 0: not given
    std::optional<NotUnderstood> problem;

    void read(Node node) {
        if (auto const name = node.attribute("srsName")) crs = trimmed(*name);
        if (!all_words_are(node.attribute_text("uomLabels"), "mm")) problem = not_understood("uomLabels other than mm");
        auto const axes = node.attribute_text("axisLabels");
        if (!axes.empty() && axes != "x y" && axes != "x y z") problem = not_understood("axisLabels other than x y z");
        auto const dimension = node.attribute("srsDimension");
        if (!dimension) return;
        dimensions = trimmed(*dimension) == "2" ? 2 : 3;
        if (dimensions == 3 && trimmed(*dimension) != "3") problem = not_understood("srsDimension other than 2 and 3");
    }
};

using Points = std::vector<std::vector<double>>;

// Appends the points of these elements (pos, posList and corners). Returns why they cannot be used, or nothing.
std::optional<NotUnderstood> read_points(Frame& frame, MessageTree::Children elements, Points& points) {
    for (auto const each : elements) {
        auto const crs = frame.crs;
        frame.read(each);
        if (!crs.empty() && frame.crs != crs) return not_understood("points of one geometry in two frames");
        auto numbers = to_doubles(each.text());
        if (std::ranges::any_of(numbers, [](double number) { return std::isnan(number); }))
            return NotUnderstood{"a coordinate of the condition is NaN or too large for a double"};
        if (each.name() != "posList") {
            points.push_back(std::move(numbers));
            continue;
        }
        auto const each_has = frame.dimensions == 0 ? 2 : frame.dimensions;
        if (numbers.size() % each_has != 0)
            return NotUnderstood{"a posList of the condition has " + std::to_string(numbers.size()) + " numbers: expected " +
                                 std::to_string(each_has) + " for each point"};
        for (auto from = numbers.begin(); from != numbers.end(); from += static_cast<std::ptrdiff_t>(each_has))
            points.emplace_back(from, from + static_cast<std::ptrdiff_t>(each_has));
    }
    return frame.problem;
}

std::optional<NotUnderstood> wrong_dimensions(Frame const& frame, Points const& points) {
    auto const dimensions = points.front().size();
    for (auto const& point : points) {
        if (point.size() != dimensions || dimensions < 2 || dimensions > 3)
            return NotUnderstood{"a position of the condition has " + std::to_string(point.size()) +
                                 " coordinates: expected two or three, the same number in all points"};
        if (frame.dimensions != 0 && frame.dimensions != dimensions)
            return NotUnderstood{"a position of the condition has " + std::to_string(dimensions) +
                                 " coordinates, but its srsDimension is " + std::to_string(frame.dimensions)};
    }
    return {};
}

// A point is a box with two equal corners. Two positions may be any opposite corners, but a lowerCorner must not be above the
// upperCorner.
Expression decode_corners(Frame frame, MessageTree::Children corners) {
    Points points;
    if (auto problem = read_points(frame, corners, points)) return {std::move(*problem)};
    if (auto problem = wrong_dimensions(frame, points)) return {std::move(*problem)};
    auto const dimensions = points.front().size();
    bool const ordered = (*corners.begin()).name() == "lowerCorner";
    Geometry geometry;
    geometry.crs = frame.crs;
    geometry.dimensions = static_cast<std::uint8_t>(dimensions);
    for (std::size_t axis = 0; axis < dimensions; ++axis) {
        auto const first = points.front()[axis], last = points.back()[axis];
        if (ordered && first > last)
            return {NotUnderstood{"the condition has an Envelope whose lowerCorner is above its upperCorner (" +
                                  number_text(first) + " and " + number_text(last) + ")"}};
        geometry.low[axis] = std::min(first, last);
        geometry.high[axis] = std::max(first, last);
    }
    return {geometry};
}

// Adds a line or the border of an area to the geometry. Returns why it cannot be used, or nothing.
std::optional<NotUnderstood> add_path(Geometry& geometry, Frame& frame, MessageTree::Children elements) {
    Points points;
    if (auto problem = read_points(frame, elements, points)) return problem;
    if (auto problem = wrong_dimensions(frame, points)) return problem;
    if (points.front().size() != 2)
        return NotUnderstood{"the condition has a line, circle or polygon of points with three coordinates: expected two"};
    auto& path = geometry.paths.emplace_back();
    for (auto const& point : points) path.push_back({point[0], point[1]});
    return {};
}

Expression finished(Geometry geometry, Frame const& frame) {
    geometry.crs = frame.crs;
    geometry.fit_corners();
    return {std::move(geometry)};
}

Expression decode_line(Frame frame, Node node) {
    Geometry line;
    line.shape = Geometry::Shape::line;
    if (auto problem = add_path(line, frame, node.children())) return {std::move(*problem)};
    if (line.paths.front().size() < 2) return {NotUnderstood{"the condition has a line of one point: expected two or more"}};
    return finished(std::move(line), frame);
}

Expression decode_polygon(Frame frame, Node node) {
    Geometry polygon;
    polygon.shape = Geometry::Shape::polygon;
    for (auto const border : node.children()) {
        auto const ring = border.first_child();
        frame.read(ring);
        if (auto problem = add_path(polygon, frame, ring.children())) return {std::move(*problem)};
        auto const& path = polygon.paths.back();
        if (path.size() < 4 || path.front() != path.back())
            return {NotUnderstood{"the condition has a LinearRing of " + std::to_string(path.size()) +
                                  " points: expected four or more, the last one equal to the first"}};
    }
    return finished(std::move(polygon), frame);
}

Expression decode_circle(Frame frame, Node node) {
    Geometry circle;
    circle.shape = Geometry::Shape::circle;
    auto const centre = node.first_child();
    auto const radius = node.child("radius");
    frame.read(centre);
    auto const numbers = to_doubles(centre.text());
    if (frame.problem) return {*frame.problem};
    if (numbers.size() != 2 || std::isnan(numbers[0]) || std::isnan(numbers[1]))
        return {
            NotUnderstood{"the centre of a circle of the condition is " + quoted(centre.text()) + ": expected two coordinates"}};
    auto const unit = millimetres_in(radius.attribute_text("uom"));
    if (!unit)
        return {NotUnderstood{"the condition has the unit " + quoted(radius.attribute_text("uom")) +
                              ", which is not known here; expected one of mm, cm, m, km"}};
    circle.paths = {{{numbers[0], numbers[1]}}};
    circle.radius = to_double(radius.text()).value_or(0) * *unit;
    return finished(std::move(circle), frame);
}

Expression decode_geometry(Node node) {
    Frame frame;
    frame.read(node);
    auto const name = node.name();
    if (name == "LineString") return decode_line(std::move(frame), node);
    if (name == "Polygon") return decode_polygon(std::move(frame), node);
    if (name == "CircleByCenterPoint") return decode_circle(std::move(frame), node);
    return decode_corners(std::move(frame), node.children());
}

// Decodes a time position: beginPosition, or begin with a TimeInstant inside.
Expression decode_position(Node node) {
    if (node.name() == "begin" || node.name() == "end") node = node.first_child();
    if (node.name() == "TimeInstant") node = node.first_child();
    if (node.attribute("indeterminatePosition")) return {not_understood("indeterminatePosition")};
    auto const text = node.text();
    if (auto const period = to_period(text)) return {*period};
    return {NotUnderstood{"the condition has the time " + quoted(text) +
                          ": expected a time such as 2026-11-20T12:00:00Z, a day, a month or a year"}};
}

Expression decode_period(Node node) {
    auto const written = node.first_child();
    auto const begin = decode_position(written);
    auto const end = decode_position(written.next());
    for (auto const* side : {&begin, &end}) {
        if (!std::holds_alternative<Period>(side->value)) return *side;
    }
    auto const& first = std::get<Period>(begin.value);
    auto const& last = std::get<Period>(end.value);
    if (last.begin < first.begin) return {NotUnderstood{"the condition has a period that ends before it begins"}};
    return {Period{first.begin, last.end}};
}

}  // namespace

NotUnderstood not_understood(std::string_view name) { return {"the condition has " + quoted(name) + ", which is not supported"}; }

Expression decode_expression(Node node) {
    auto const name = node.name();
    auto const inside = node.children();
    if (name == "ValueReference") return {ValueReference{std::string{trimmed(node.text())}}};
    if (name == "Literal")
        return inside.empty() ? Expression{Literal{std::string{node.text()}}} : decode_expression(inside.front());
    if (name == "TimeInstant") return decode_position(node);
    if (name == "TimePeriod") return decode_period(node);
    if (name != "Function") return decode_geometry(node);
    Function function{node.attribute_text("name"), {}};
    for (auto const argument : inside) function.arguments.push_back(decode_expression(argument));
    return {std::move(function)};
}

}  // namespace rois::xml
