// XML to be said, which cannot be put together wrong: what comes from somewhere else is always escaped.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rois::client {

using Attributes = std::vector<std::pair<std::string, std::string>>;  // names and values, as they are

// Elements, one after the other. What stands in a source file is taken as it is written there; all other texts come in as values
// of attributes or as characters of an element, where they are escaped: a std::string is no Xml.
class Xml {
public:
    Xml() = default;
    template <std::size_t size>
    Xml(char const (&written)[size]) : text_{written, size - 1} {}

    std::string const& text() const { return text_; }
    bool empty() const { return text_.empty(); }

    // The first element with another attribute before its own.
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

}  // namespace rois::client
