// Profile documents (7.5.3, 7.5.4) as others write them: what the schemas do not allow but everybody understands is read all the
// same, with a warning.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "types/profiles.hpp"
#include "xml/document.hpp"

namespace rois::xml {

struct ProfileDocument {
    std::variant<ComponentProfile, EngineProfile> profile;
    std::vector<std::string> warnings;  // "name:line:column: what it says, and what it was taken for"
    // Of a component profile, "name:line:column" each:
    std::vector<std::string> sub_component_places;
    std::string adapter_place;     // of what says its meta_data; empty when nothing does
    std::string identifier_place;  // of its URN
    std::string name_place;        // of its name; empty when it has none
};

// Throws BadDocument when it is not well-formed, or not valid and not understood.
ProfileDocument read_profile_document(std::shared_ptr<Schemas const> const&, std::string const& name, std::string const& text);

// A component profile that must be valid as it stands (7.5.4). Throws BadDocument.
ComponentProfile read_component_profile(std::shared_ptr<Schemas const> const&, std::string const& name, std::string const& text);

}  // namespace rois::xml
