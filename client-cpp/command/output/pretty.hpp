// Documents as text for people.
#pragma once

#include <string>
#include <string_view>

#include "types/messages.hpp"

namespace rois::command {

// Returns the document indented by two spaces a level, with a line end. Elements with only text stay on one line. Returns a text
// that is not XML unchanged.
std::string pretty(std::string_view document);

// Returns the line of the place in the document, with a mark below the start tag or text that begins there:
//
//     3 |   <component rois:code="navigation"/>
//       |   ^~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
//
// Cuts a long line to the part around the mark. Returns nothing if the document has no such place.
std::string underlined(std::string_view document, Place, bool coloured);

}  // namespace rois::command
