// Decodes the trees of profile documents.
#pragma once

#include <pugixml.hpp>
#include <string>

#include "xml/codec/place.hpp"
#include "xml/profiles/profile_document.hpp"

namespace rois::xml {

// `root` is an HRIComponentProfile or an HRIEngineProfile of the document with these places. `name` is the document's name in
// errors and warnings. Throws BadDocument if the profile is invalid.
ProfileDocument decode_profile(pugi::xml_node root, std::string const& name, Places&);

// Returns "name:line:column".
std::string at(std::string const& name, Place);

}  // namespace rois::xml
