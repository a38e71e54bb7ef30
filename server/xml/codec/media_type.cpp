#include "xml/codec/codec.hpp"

#include <algorithm>

#include "types/text/texts.hpp"

namespace rois::xml {

bool is_xml_media_type(std::string_view content_type) {
    if (content_type == "application/xml") return true;  // the usual form
    auto const semicolon = std::min(content_type.find(';'), content_type.size());
    auto const type = lower_case(trimmed(content_type.substr(0, semicolon)));
    bool const structured = type.starts_with("application/") && type.ends_with("+xml");
    if (type != "application/xml" && type != "text/xml" && !structured) return false;
    for (auto rest = content_type.substr(semicolon); !rest.empty();) {
        rest.remove_prefix(1);
        auto const end = std::min(rest.find(';'), rest.size());
        auto const parameter = lower_case(trimmed(rest.substr(0, end)));
        rest.remove_prefix(end);
        if (!parameter.starts_with("charset")) continue;
        if (parameter != "charset=utf-8" && parameter != "charset=\"utf-8\"") return false;
    }
    return true;
}

}  // namespace rois::xml
