#include "xml/decoding_expression.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "types/texts.hpp"
#include "xml/decoding.hpp"
#include "xml/numbers.hpp"

namespace rois::xml {

namespace {

using Node = MessageTree::Node;

// "mm mm" for "mm": whether every word of a text is that one.
bool all_words_are(std::string_view text, std::string_view word) {
    for (text = trimmed(text); !text.empty();) {
        auto const item = text.substr(0, text.find_first_of(" \t\r\n"));
        if (item != word) return false;
        text = trimmed(text.substr(item.size()));
    }
    return true;
}

// What an element says of the frame of its coordinates, taken over what the one around it says.
struct Frame {
    std::string crs;
    std::size_t dimensions = 0;  // 0: not said
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

// Two points of the same frame are the opposite corners of a box; one point is its own.
Expression decode_corners(Frame frame, MessageTree::Children corners) {
    Geometry geometry;
    std::vector<std::vector<double>> points;
    for (auto const corner : corners) {
        auto const crs = frame.crs;
        frame.read(corner);
        if (!crs.empty() && frame.crs != crs) return {not_understood("corners in two frames")};
        points.push_back(decode_numbers(corner.text()));
    }
    if (frame.problem) return {*frame.problem};
    auto const dimensions = points.front().size();
    for (auto const& point : points) {
        if (point.size() != dimensions || dimensions < 2 || dimensions > 3)
            return {NotUnderstood{"a position of the condition has neither two nor three coordinates"}};
        if (frame.dimensions != 0 && frame.dimensions != dimensions)
            return {NotUnderstood{"a position of the condition has other than the " + std::to_string(frame.dimensions) +
                                  " coordinates of its srsDimension"}};
        if (std::ranges::any_of(point, [](double number) { return std::isnan(number); }))
            return {NotUnderstood{"a coordinate of the condition is NaN or beyond what a double can hold"}};
    }
    geometry.crs = frame.crs;
    geometry.dimensions = static_cast<std::uint8_t>(dimensions);
    for (std::size_t axis = 0; axis < dimensions; ++axis) {
        geometry.low[axis] = std::min(points.front()[axis], points.back()[axis]);
        geometry.high[axis] = std::max(points.front()[axis], points.back()[axis]);
    }
    return {geometry};
}

Expression decode_geometry(Node node) {
    if (node.name() != "Envelope" && node.name() != "Point") return {not_understood(node.name())};
    Frame frame;
    frame.read(node);
    return decode_corners(std::move(frame), node.children());
}

// beginPosition, or begin with a TimeInstant inside.
Expression decode_position(Node node) {
    if (node.name() == "begin" || node.name() == "end") node = node.first_child();
    if (node.name() == "TimeInstant") node = node.first_child();
    if (node.attribute("indeterminatePosition")) return {not_understood("indeterminatePosition")};
    auto const text = node.text();
    if (auto const period = to_period(text)) return {*period};
    return {NotUnderstood{"the condition has the time " + quoted(text) + ", which is no moment, day, month or year"}};
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

NotUnderstood not_understood(std::string_view what) {
    return {"the condition has " + quoted(what) + ", which is not understood"};
}

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
