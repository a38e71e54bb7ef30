// Places in a document: byte offsets, and the lines and columns that faults tell.
#pragma once

#include <cstddef>
#include <string_view>

#include "types/messages.hpp"

namespace rois::xml {

// Line and column of the character that begins at `offset`, or of the end. Lines end with LF, CR LF or CR; a byte order mark is
// no character.
Place place_of(std::string_view document, std::size_t offset);

// The byte offset of a place as a parser counts columns, that is in UTF-16 units; the end when there is no such place.
std::size_t offset_of(std::string_view document, Place in_utf16);

}  // namespace rois::xml
