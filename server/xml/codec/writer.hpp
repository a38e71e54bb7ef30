// Writes an XML document. Escapes all values, so that the document is well-formed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rois::xml {

class Writer {
public:
    Writer() : text_(usual_length, '\0') { open_.reserve(usual_depth); }

    // Names must be string literals: they are not checked, and must outlive the element.
    Writer& start(std::string_view element);
    Writer& attribute(std::string_view name, std::string_view value);
    Writer& attribute(std::string_view name, std::uint64_t value);
    Writer& attribute_unless_empty(std::string_view name, std::string_view value);
    // Does not escape `value`, which must need no escaping.
    Writer& constant(std::string_view name, std::string_view value);
    Writer& text(std::string_view);
    Writer& end();

    // Writes an element that contains only text.
    Writer& element(std::string_view name, std::string_view text) { return start(name).text(text).end(); }

    // Returns the document. All elements must have ended.
    std::string written() && {
        text_.resize(length_);
        return std::move(text_);
    }

private:
    static constexpr std::size_t usual_length = 1000, usual_depth = 8;

    template <class... Pieces>
    void append(Pieces const&...);
    void append_unusual(std::string_view value, bool in_attribute);
    void grow(std::size_t wanted);

    std::string text_;  // a buffer, of which `length_` bytes are written
    std::size_t length_ = 0;
    std::vector<std::string_view> open_;
    bool in_start_tag_ = false;
};

// Returns the shortest xsd:double that reads back as the same number.
std::string number_text(double);

}  // namespace rois::xml
