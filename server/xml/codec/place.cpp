#include "xml/codec/place.hpp"

#include "types/text/text_encoding.hpp"

namespace rois::xml {

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

// Returns whether a line ends with this character. In CR LF, only the LF ends it.
bool ends_line(std::string_view document, std::size_t i) {
    return document[i] == '\n' || (document[i] == '\r' && (i + 1 == document.size() || document[i + 1] != '\n'));
}

// The number of columns that xerces-c counts for the character with this first byte.
std::uint64_t utf16_units(char first) { return static_cast<unsigned char>(first) >= 0xF0 ? 2 : 1; }

std::size_t start_of(std::string_view document) { return document.starts_with(byte_order_mark) ? byte_order_mark.size() : 0; }

}  // namespace

Place place_of(std::string_view document, std::size_t offset) { return Places{document}.of(offset); }

Places::Places(std::string_view document) : document_{document}, at_{start_of(document)} {}

Place Places::of(std::size_t offset) {
    if (offset < at_) *this = Places{document_};
    for (; at_ < offset && at_ < document_.size(); ++at_) {
        if (ends_line(document_, at_)) {
            ++here_.line;
            here_.column = 1;
        } else if (!continues_character(document_[at_]) && document_[at_] != '\r') {
            ++here_.column;
        }
    }
    return here_;
}

std::size_t offset_of(std::string_view document, Place in_utf16) {
    Place here;
    auto i = start_of(document);
    for (; i < document.size(); ++i) {
        if (continues_character(document[i])) continue;
        if (here.line > in_utf16.line || (here.line == in_utf16.line && here.column >= in_utf16.column)) break;
        if (ends_line(document, i)) {
            ++here.line;
            here.column = 1;
        } else {
            here.column += utf16_units(document[i]);
        }
    }
    return i;
}

}  // namespace rois::xml
