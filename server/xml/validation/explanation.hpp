// Explains why a well-formed document is invalid: reason and start tag.
#pragma once

#include <cstddef>
#include <optional>
#include <pugixml.hpp>
#include <span>
#include <string>
#include <string_view>

#include "xml/validation/schemas.hpp"

namespace rois::xml {

struct Explanation {
    std::string reason;
    std::size_t offset = 0;  // of the `<` of the offending start tag
};

// Finds the first part of the document that the schemas do not allow; nothing if it finds none. `roots` are the allowed root
// elements; empty: any root that the schemas have.
std::optional<Explanation> explain(Schemas const&, pugi::xml_node root, std::span<std::string_view const> roots);

}  // namespace rois::xml
