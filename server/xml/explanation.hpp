// Says in our words what is wrong with a well-formed document that is not valid, and with which tag.
#pragma once

#include <cstddef>
#include <optional>
#include <pugixml.hpp>
#include <span>
#include <string>
#include <string_view>

#include "xml/schemas.hpp"

namespace rois::xml {

struct Explanation {
    std::string reason;
    std::size_t offset = 0;  // of the `<` of the start tag that it is about
};

// The first thing in the document's order that the schemas do not allow. `roots` are the elements of messages that may be the
// root; none: any that the schemas have. Nothing when no such thing is found.
std::optional<Explanation> explain(Schemas const&, pugi::xml_node root, std::span<std::string_view const> roots);

}  // namespace rois::xml
