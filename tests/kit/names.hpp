// Gives the names of a received document known prefixes.
#pragma once

#include <pugixml.hpp>

namespace rois::kit {

// Replaces the prefixes of elements, attributes and the values of xsi:type by rois, fes, gml, unr or xsi. Messages get no prefix.
// A name that has one of these prefixes but another namespace becomes `other:...`. A name without a namespace is unchanged.
void give_known_prefixes(pugi::xml_document&);

}  // namespace rois::kit
