#include "xml/codec/codec.hpp"

#include <initializer_list>
#include <string_view>
#include <utility>

#include "xml/codec/writer.hpp"

namespace rois::xml {

namespace {

constexpr std::string_view map_namespace = "urn:x-rois:map:1";

using Numbers = std::initializer_list<std::pair<std::string_view, double>>;

Writer& write(Writer& out, Numbers numbers) {
    for (auto const& [name, number] : numbers) out.attribute(name, number_text(number));
    return out;
}

void write(Writer& out, std::string_view element, FloorMap::Box const& box) {
    write(out.start(element), {{"x", box.x}, {"y", box.y}, {"width", box.width}, {"depth", box.depth}}).end();
}

void write(Writer& out, FloorMap::Place const& place) {
    out.start("place").attribute("name", place.name);
    write(out, {{"x", place.x}, {"y", place.y}, {"heading", place.heading}, {"width", place.width}, {"depth", place.depth}});
    out.end();
}

void write(Writer& out, FloorMap::Robot const& robot) {
    out.start("robot").attribute("name", robot.name);
    write(out, {{"radius", robot.radius}});
    if (auto const& frame = robot.frame) {
        out.start("frame").attribute("crs", frame->crs);
        write(out, {{"x", frame->x}, {"y", frame->y}, {"heading", frame->heading}}).end();
    }
    out.end();
}

}  // namespace

std::string encode(FloorMap const& map) {
    Writer out;
    out.start("floor_map").constant("xmlns", map_namespace).attribute("name", map.name).attribute("crs", map.crs);
    write(out, "bounds", map.bounds);
    for (auto const& wall : map.walls)
        write(out.start("wall"), {{"x1", wall.x1}, {"y1", wall.y1}, {"x2", wall.x2}, {"y2", wall.y2}}).end();
    for (auto const& furniture : map.furniture) write(out, "furniture", furniture);
    for (auto const& place : map.places) write(out, place);
    for (auto const& robot : map.robots) write(out, robot);
    out.end();
    return std::move(out).written() + '\n';
}

}  // namespace rois::xml
