// What profile documents of other versions and other hands have wrong, put right in their trees.
#pragma once

#include <cstddef>
#include <optional>
#include <pugixml.hpp>
#include <span>
#include <string>
#include <vector>

namespace rois::xml {

struct Repair {
    std::size_t offset = 0;  // of the start tag that it is about
    std::string what;        // what was wrong, and what it was taken for
};

// Declarations of the RoIS namespace with white space around it, or of another date, become the one that the schemas know. The
// length of the text stays.
std::vector<Repair> repair_namespaces(std::span<char> document, std::span<std::string const> known);

// Changes the tree of a profile, whose namespaces are known, until it says what was meant in the form of the schemas. What it
// does not understand stays as it is.
std::vector<Repair> repair_profile(pugi::xml_node root);

}  // namespace rois::xml
