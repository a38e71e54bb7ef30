#include "xml/decoding_expression.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "types/texts.hpp"
#include "xml/decoding.hpp"
#include "xml/tree.hpp"

namespace rois::xml {

namespace {

// The numbers of a list that is valid: separated by white space.
std::vector<double> numbers_in(std::string_view text) {
    std::vector<double> numbers;
    for (text = trimmed(text); !text.empty();) {
        auto const item = text.substr(0, text.find_first_of(" \t\r\n"));
        numbers.push_back(to_double(item).value_or(std::nan("")));
        text = trimmed(text.substr(item.size()));
    }
    return numbers;
}

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

    void read(pugi::xml_node node) {
        if (auto const name = attribute(node, "srsName")) crs = trimmed(name.value());
        if (!all_words_are(attribute_text(node, "uomLabels"), "mm")) problem = not_understood("uomLabels other than mm");
        auto const axes = attribute_text(node, "axisLabels");
        if (!axes.empty() && axes != "x y" && axes != "x y z") problem = not_understood("axisLabels other than x y z");
        auto const dimension = attribute(node, "srsDimension");
        if (!dimension) return;
        dimensions = trimmed(dimension.value()) == "2" ? 2 : 3;
        if (dimensions == 3 && trimmed(dimension.value()) != "3") problem = not_understood("srsDimension other than 2 and 3");
    }
};

// Two points of the same frame are the opposite corners of a box; one point is its own.
Expression decode_corners(Frame frame, std::vector<pugi::xml_node> const& corners) {
    Geometry geometry;
    std::vector<std::vector<double>> points;
    for (auto const corner : corners) {
        auto const crs = frame.crs;
        frame.read(corner);
        if (!crs.empty() && frame.crs != crs) return {not_understood("corners in two frames")};
        points.push_back(numbers_in(text_of(corner)));
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

Expression decode_geometry(pugi::xml_node node) {
    if (local_name(node) != "Envelope" && local_name(node) != "Point") return {not_understood(local_name(node))};
    Frame frame;
    frame.read(node);
    return decode_corners(std::move(frame), elements_in(node));
}

// beginPosition, or begin with a TimeInstant inside.
Expression decode_position(pugi::xml_node node) {
    if (local_name(node) == "begin" || local_name(node) == "end") node = elements_in(node).front();
    if (local_name(node) == "TimeInstant") node = elements_in(node).front();
    if (attribute(node, "indeterminatePosition")) return {not_understood("indeterminatePosition")};
    auto const text = text_of(node);
    if (auto const period = to_period(text)) return {*period};
    return {NotUnderstood{"the condition has the time " + quoted(text) + ", which is no moment, day, month or year"}};
}

Expression decode_period(pugi::xml_node node) {
    auto const ends = elements_in(node);
    auto const begin = decode_position(ends.at(0));
    auto const end = decode_position(ends.at(1));
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

std::vector<pugi::xml_node> elements_in(pugi::xml_node node) {
    std::vector<pugi::xml_node> elements;
    for (auto const each : node.children()) {
        if (each.type() == pugi::node_element) elements.push_back(each);
    }
    return elements;
}

Expression decode_expression(pugi::xml_node node) {
    auto const name = local_name(node);
    auto const inside = elements_in(node);
    if (name == "ValueReference") return {ValueReference{std::string{trimmed(text_of(node))}}};
    if (name == "Literal") return inside.empty() ? Expression{Literal{text_of(node)}} : decode_expression(inside.front());
    if (name == "TimeInstant") return decode_position(node);
    if (name == "TimePeriod") return decode_period(node);
    if (name != "Function") return decode_geometry(node);
    Function function{attribute_text(node, "name"), {}};
    for (auto const argument : inside) function.arguments.push_back(decode_expression(argument));
    return {std::move(function)};
}

}  // namespace rois::xml
