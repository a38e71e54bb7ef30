// Gives the names of a received document known prefixes.
#pragma once

#include <pugixml.hpp>

namespace rois::kit {

// Replaces the prefixes of elements, attributes and the values of xsi:type by those of wire.md: none for messages, and rois, fes,
// gml, unr and xsi. A name with one of these prefixes but another namespace becomes `other:...`. A name without a namespace
// stays.
void give_known_prefixes(pugi::xml_document&);

}  // namespace rois::kit
