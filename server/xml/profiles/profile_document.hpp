// Reads profile documents (7.5.3, 7.5.4). Accepts common deviations from the schemas, with a warning each.
#pragma once

#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "types/profiles.hpp"
#include "xml/profiles/document.hpp"

namespace rois::xml {

struct ProfileDocument {
    std::variant<ComponentProfile, EngineProfile> profile;
    std::vector<std::string> warnings;  // "name:line:column: the deviation, and how it was read"
    // Places in a component profile, as "name:line:column"; empty if the element is missing.
    std::vector<std::string> sub_component_places;
    std::string adapter_place;     // of metaDataProperty
    std::string identifier_place;  // of the URN
    std::string name_place;
};

// Throws BadDocument if the text is not well-formed, or invalid beyond the accepted deviations.
ProfileDocument read_profile_document(std::shared_ptr<Schemas const> const&, std::string const& name, std::string const& text);

// Reads a component profile (7.5.4) and accepts no deviation. Throws BadDocument.
ComponentProfile read_component_profile(std::shared_ptr<Schemas const> const&, std::string const& name, std::string const& text);

// The same for each of these files.
std::vector<ComponentProfile> read_component_profiles(std::shared_ptr<Schemas const> const&, NamedFiles const&);

}  // namespace rois::xml
