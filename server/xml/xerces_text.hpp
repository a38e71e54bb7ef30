// Between the texts of xerces-c (UTF-16) and ours (UTF-8).
#pragma once

#include <string>
#include <string_view>
#include <xercesc/util/XercesDefs.hpp>

namespace rois::xml {

std::u16string to_xerces(std::string_view);
std::string from_xerces(XMLCh const*);  // null becomes empty

}  // namespace rois::xml
