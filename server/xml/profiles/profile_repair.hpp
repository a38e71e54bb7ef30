// Repairs common deviations in profile documents of other versions and authors.
#pragma once

#include <cstddef>
#include <pugixml.hpp>
#include <span>
#include <string>
#include <vector>

namespace rois::xml {

struct Repair {
    std::size_t offset = 0;  // of the start tag
    std::string warning;     // the deviation, and how it was read
};

// Replaces declarations of the RoIS namespace that have another date or white space around the name. Keeps the length of the
// document. `known` are the namespaces of the schemas.
std::vector<Repair> repair_namespaces(std::span<char> document, std::span<std::string const> known);

// Changes the tree of a profile to the form of the schemas. Unknown elements stay unchanged. The namespaces must be repaired
// before.
std::vector<Repair> repair_profile(pugi::xml_node root);

}  // namespace rois::xml
