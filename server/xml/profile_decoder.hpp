// From trees of profiles to profiles.
#pragma once

#include <pugixml.hpp>
#include <string>
#include <string_view>

#include "xml/profile_document.hpp"

namespace rois::xml {

// `root` is an HRIComponentProfile or an HRIEngineProfile of the document `text`, which `name` names in complaints. Throws
// BadDocument where it cannot be understood.
ProfileDocument decode_profile(pugi::xml_node root, std::string const& name, std::string_view text);

// "name:line:column".
std::string at(std::string const& name, Place);

}  // namespace rois::xml
