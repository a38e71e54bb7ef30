// Converts between byte offsets in a document and the lines and columns of faults.
#pragma once

#include <cstddef>
#include <string_view>

#include "types/messages.hpp"

namespace rois::xml {

// Returns line and column of the character at `offset`, or of the end. Lines end with LF, CR LF or CR. A byte order mark is not
// counted.
Place place_of(std::string_view document, std::size_t offset);

// The same for many offsets. Fast if they ascend: each search begins where the last one ended.
class Places {
public:
    explicit Places(std::string_view document);
    Place of(std::size_t offset);

private:
    std::string_view document_;
    std::size_t at_;
    Place here_;
};

// Returns the byte offset of a place whose column counts UTF-16 units, as xerces-c does; the end if there is no such place.
std::size_t offset_of(std::string_view document, Place in_utf16);

}  // namespace rois::xml
