// The content of a document, independent of the parser: elements and attributes with their namespaces, and text.
#pragma once

#include <string>

namespace rois::fuzz {

// Of a well-formed document, as xerces-c reads it.
std::string read_by_xerces(std::string const& document);

// As the decoders find it in their tree.
std::string read_by_pugixml(std::string document);

}  // namespace rois::fuzz
