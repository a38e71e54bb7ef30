// Gives the names of a received document known prefixes.
#pragma once

#include <pugixml.hpp>

namespace rois::kit {

// Replaces the prefixes of elements, attributes and the values of xsi:type: none for messages, else rois, fes, gml, unr or xsi.
// A name with one of these prefixes but another namespace becomes `other:...`. A name without a namespace stays.
void give_known_prefixes(pugi::xml_document&);

}  // namespace rois::kit
