// Geometries and times of GML for conditions.
#pragma once

#include <string>

#include "server/conversation.hpp"

namespace rois::test {

inline Xml gml(std::string const& name, Xml const& inside) {
    return element("gml:" + name, {{"xmlns:gml", "http://www.opengis.net/gml/3.2"}}, inside);
}

inline Xml ring(std::string const& points) {
    return gml("Polygon", gml("exterior", gml("LinearRing", text_element("gml:posList", points))));
}

inline Xml circle(std::string const& centre, std::string const& radius, std::string const& unit) {
    return gml("CircleByCenterPoint",
               text_element("gml:pos", centre) + element("gml:radius", {{"uom", unit}}, characters(radius)));
}

inline Xml period(std::string const& begin, std::string const& end) {
    return gml("TimePeriod", text_element("gml:beginPosition", begin) + text_element("gml:endPosition", end));
}

}  // namespace rois::test
