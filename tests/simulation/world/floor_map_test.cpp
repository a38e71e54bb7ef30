// The floor map and its document.
#include "simulation/plan/floor_map.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "simulation/world_stage.hpp"
#include "xml/codec/codec.hpp"
#include "xml/profiles/document.hpp"

namespace rois::simulation {
namespace {

// Validates the document and returns one line for each element: "place name=desk x=9500 ...".
std::string lines(xml::Element const& element) {
    auto line = std::string{element.name()};
    for (auto const& attribute : element.attributes()) line += " " + std::string{attribute.name} + "=" + attribute.value;
    line += "\n";
    for (auto const& child : element.children()) line += lines(child);
    return line;
}
std::string lines(std::string document) { return lines(xml::Document::parse(schemas(), "map.xml", std::move(document)).root()); }

TEST(FloorMapDocument, OfTheHallWithTwoRobotsEqualsTheSample) {
    std::ifstream sample{ROIS_SOURCE_DIR "/schemas/samples/floor_map.xml"};
    EXPECT_EQ(lines(xml::encode(floor_map(shipped_plan("two-robots.xml")))),
              lines(std::string{std::istreambuf_iterator<char>{sample}, {}}));
}

TEST(FloorMapDocument, IsInMillimetresAndDegrees) {
    FloorPlan plan = plain_hall();
    plan.name = "<\"5 o'clock\" & later>";
    plan.bounds.low = Point{-0.0001234, 0.28};
    plan.places[0].pose.heading = from_degrees(270);
    plan.robots[0].radius = 1.0 / 3;
    auto const reported = lines(xml::encode(floor_map(plan)));
    EXPECT_NE(reported.find("floor_map name=<\"5 o'clock\" & later> "), reported.npos) << reported;
    EXPECT_NE(reported.find("\nbounds x=-0.123 y=280 width=10000.123 depth=7720\n"), reported.npos) << reported;
    EXPECT_NE(reported.find("\nplace name=entrance x=9000 y=4000 heading=-90 width=2000 depth=2000\n"), reported.npos)
        << reported;
    EXPECT_NE(reported.find("\nrobot name=robot1 radius=333.333\n"), reported.npos) << reported;
}

}  // namespace
}  // namespace rois::simulation
