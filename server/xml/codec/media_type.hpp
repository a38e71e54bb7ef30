// Media types of XML documents.
#pragma once

#include <string_view>

namespace rois::xml {

// Returns whether the value of a Content-Type field is a media type of XML, in UTF-8 (RFC 7303).
bool is_xml_media_type(std::string_view content_type);

}  // namespace rois::xml
