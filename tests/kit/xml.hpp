// Builds well-formed XML: escapes all texts except literals of the source.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rois::kit {

using Attributes = std::vector<std::pair<std::string, std::string>>;  // names and unescaped values

// A sequence of elements. A string literal is XML and taken unchanged. All other texts enter as attribute values or characters of
// an element, and are escaped; a std::string does not convert to Xml.
class Xml {
public:
    Xml() = default;
    template <std::size_t size>
    Xml(char const (&written)[size]) : text_{written, size - 1} {}

    std::string const& text() const { return text_; }
    bool empty() const { return text_.empty(); }

    // Returns a copy whose first element has another attribute before its own.
    Xml with(std::string_view name, std::string_view value) const;

    Xml& operator+=(Xml const& more);
    friend Xml operator+(Xml one, Xml const& other) { return one += other; }

private:
    friend Xml element(std::string_view name, Attributes const&, Xml const& content);
    friend Xml characters(std::string_view text);

    std::string text_;
};

Xml element(std::string_view name, Attributes const&, Xml const& content = {});
Xml element(std::string_view name, Xml const& content);
Xml characters(std::string_view text);
Xml text_element(std::string_view name, std::string_view text);

}  // namespace rois::kit
