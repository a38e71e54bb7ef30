// The namespaces of the documents (schemas/).
#pragma once

#include <string_view>

namespace rois::xml {

inline constexpr std::string_view message_namespace = "urn:x-rois:psm:xml:message:1";
inline constexpr std::string_view rois_namespace = "http://www.omg.org/spec/RoIS/20240801";
inline constexpr std::string_view old_rois_namespace = "http://www.omg.org/spec/RoIS/20151201";  // versions 1.1 and 1.2
inline constexpr std::string_view gml_namespace = "http://www.opengis.net/gml/3.2";
inline constexpr std::string_view fes_namespace = "http://www.opengis.net/fes/2.0";
inline constexpr std::string_view unr_namespace = "http://www.irc.atr.jp/std/unr/0.1";
inline constexpr std::string_view xsd_namespace = "http://www.w3.org/2001/XMLSchema";
inline constexpr std::string_view xsi_namespace = "http://www.w3.org/2001/XMLSchema-instance";
inline constexpr std::string_view xml_namespace = "http://www.w3.org/XML/1998/namespace";
inline constexpr std::string_view xlink_namespace = "http://www.w3.org/1999/xlink";

static_assert(rois_namespace.size() == old_rois_namespace.size(), "the scan overwrites the old one with the new one");

// Returns whether an attribute declares a namespace.
constexpr bool declares_namespace(std::string_view attribute) { return attribute == "xmlns" || attribute.starts_with("xmlns:"); }

// local_part("rois:code") is "code"; prefix_of("rois:code") is "rois".
constexpr std::string_view local_part(std::string_view name) {
    auto const colon = name.find(':');
    return colon == name.npos ? name : name.substr(colon + 1);
}
constexpr std::string_view prefix_of(std::string_view name) {
    auto const colon = name.find(':');
    return colon == name.npos ? std::string_view{} : name.substr(0, colon);
}

}  // namespace rois::xml
