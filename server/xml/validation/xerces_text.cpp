#include "xml/validation/xerces_text.hpp"

#include <xercesc/util/TransService.hpp>
#include <xercesc/util/XMLString.hpp>

namespace rois::xml {

static_assert(sizeof(XMLCh) == sizeof(char16_t));

std::u16string to_xerces(std::string_view text) {
    xercesc::TranscodeFromStr const transcoded{reinterpret_cast<XMLByte const*>(text.data()), text.size(), "UTF-8"};
    return {transcoded.str(), transcoded.str() + transcoded.length()};
}

std::string from_xerces(XMLCh const* text) {
    if (text == nullptr || *text == 0) return {};
    xercesc::TranscodeToStr const transcoded{text, "UTF-8"};
    return {reinterpret_cast<char const*>(transcoded.str()), transcoded.length()};
}

}  // namespace rois::xml
