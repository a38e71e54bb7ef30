// Documents as people read them.
#pragma once

#include <string>
#include <string_view>

#include "types/messages.hpp"

namespace rois::command {

// Two blanks for each level, an element with nothing but text on one line, a line end at the end. What is no XML comes back as it
// is.
std::string pretty(std::string_view document);

// The line of the place in what was sent, with a mark below what begins there, up to the end of its start tag:
//
//     3 |   <component rois:code="navigation"/>
//       |   ^~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~~
//
// A long line is cut to what stands around the mark. Nothing when the document has no such place.
std::string underlined(std::string_view document, Place, bool coloured);

}  // namespace rois::command
