#include "kit/xml.hpp"

namespace rois::kit {

namespace {

// Also escapes white space and line ends that a parser would normalize (XML 1.0, 2.11 and 3.3.3).
void append_escaped(std::string& written, std::string_view text, bool in_attribute) {
    for (char const c : text) {
        if (c == '&') {
            written += "&amp;";
        } else if (c == '<') {
            written += "&lt;";
        } else if (c == '>') {
            written += "&gt;";
        } else if (c == '\r') {
            written += "&#13;";
        } else if (in_attribute && c == '"') {
            written += "&quot;";
        } else if (in_attribute && c == '\n') {
            written += "&#10;";
        } else if (in_attribute && c == '\t') {
            written += "&#9;";
        } else {
            written += c;
        }
    }
}

std::string attribute(std::string_view name, std::string_view value) {
    std::string written{" "};
    written.append(name).append("=\"");
    append_escaped(written, value, true);
    return written += '"';
}

}  // namespace

Xml Xml::with(std::string_view name, std::string_view value) const {
    auto changed = *this;
    changed.text_.insert(text_.find_first_of(" />"), attribute(name, value));
    return changed;
}

Xml& Xml::operator+=(Xml const& more) {
    text_ += more.text_;
    return *this;
}

Xml element(std::string_view name, Attributes const& attributes, Xml const& content) {
    Xml made;
    made.text_.append("<").append(name);
    for (auto const& [attribute_name, value] : attributes) made.text_ += attribute(attribute_name, value);
    if (content.empty()) {
        made.text_ += "/>";
    } else {
        made.text_.append(">").append(content.text_).append("</").append(name).append(">");
    }
    return made;
}

Xml element(std::string_view name, Xml const& content) { return element(name, Attributes{}, content); }

Xml characters(std::string_view text) {
    Xml made;
    append_escaped(made.text_, text, false);
    return made;
}

Xml text_element(std::string_view name, std::string_view text) { return element(name, characters(text)); }

}  // namespace rois::kit
