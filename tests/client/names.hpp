// The names of a document that is read, whatever prefixes it was written with.
#pragma once

#include <pugixml.hpp>

namespace rois::client {

// Whoever writes a document chooses its prefixes. After this, elements, attributes and the values of xsi:type have those of
// wire.md: none for messages, and rois, fes, gml, unr and xsi. What has one of these prefixes and another namespace is renamed to
// `other:...`, so that it is not taken for what it is not. What has no namespace at all keeps its name.
void give_known_prefixes(pugi::xml_document&);

}  // namespace rois::client
