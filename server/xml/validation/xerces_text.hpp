// Converts between UTF-8 and the UTF-16 texts of xerces-c.
#pragma once

#include <string>
#include <string_view>
#include <xercesc/util/XercesDefs.hpp>

namespace rois::xml {

std::u16string to_xerces(std::string_view);
std::string from_xerces(XMLCh const*);  // null becomes empty

}  // namespace rois::xml
