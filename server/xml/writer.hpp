// Appends XML to a text. What is written is well-formed whatever the values are.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace rois::xml {

class Writer {
public:
    explicit Writer(std::string& out) : out_{out} {}

    // Names are literals of ours: they are not checked, and must outlive the element.
    Writer& start(std::string_view element);
    Writer& attribute(std::string_view name, std::string_view value);
    Writer& attribute(std::string_view name, std::uint64_t value);
    Writer& attribute_unless_empty(std::string_view name, std::string_view value);
    Writer& text(std::string_view);
    Writer& end();

    // An element with nothing but text.
    Writer& element(std::string_view name, std::string_view text) { return start(name).text(text).end(); }

private:
    void close_start_tag();

    std::string& out_;
    std::vector<std::string_view> open_;
    bool in_start_tag_ = false;
};

// The shortest text that reads back as the same number, in the form of xsd:double.
std::string number_text(double);

}  // namespace rois::xml
