#include "xml/writer.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "xml/characters.hpp"

namespace rois::xml {

namespace {

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD, for what XML cannot carry

enum class Place { text, attribute };

// How a character must be written here; empty when as it is.
constexpr std::string_view escaped(char c, Place place) {
    switch (c) {
        case '<':
            return "&lt;";
        case '>':
            return "&gt;";
        case '&':
            return "&amp;";
        case '"':
            return place == Place::attribute ? "&quot;" : "";
        case '\t':
            return place == Place::attribute ? "&#9;" : "";
        case '\n':
            return place == Place::attribute ? "&#10;" : "";
        case '\r':
            return "&#13;";
        default:
            return "";
    }
}

using Table = std::array<bool, 256>;

// The bytes that stand for themselves, wherever they are.
constexpr Table plain(Place place) {
    Table table{};
    for (std::size_t c = ' '; c < 0x80; ++c) table[c] = escaped(static_cast<char>(c), place).empty();
    return table;
}
constexpr Table plain_in_text = plain(Place::text);
constexpr Table plain_in_attributes = plain(Place::attribute);

void append_escaped(std::string& out, std::string_view clean, Place place) {
    std::size_t done = 0;
    for (std::size_t i = 0; i < clean.size(); ++i) {
        auto const form = escaped(clean[i], place);
        if (form.empty()) continue;
        out.append(clean.substr(done, i - done)).append(form);
        done = i + 1;
    }
    out.append(clean.substr(done));
}

void append(std::string& out, std::string_view value, Place place) {
    auto const& is_plain = place == Place::text ? plain_in_text : plain_in_attributes;
    auto const unusual = std::ranges::find_if_not(value, [&](char c) { return is_plain[static_cast<unsigned char>(c)]; });
    auto const length = static_cast<std::size_t>(unusual - value.begin());
    out.append(value.substr(0, length));
    value.remove_prefix(length);
    if (value.empty()) return;
    while (auto const bad = first_bad_character(value)) {
        append_escaped(out, value.substr(0, bad->offset), place);
        out += replacement;
        value.remove_prefix(bad->offset + bad->length);
    }
    append_escaped(out, value, place);
}

}  // namespace

Writer& Writer::start(std::string_view element) {
    close_start_tag();
    (out_ += '<') += element;
    open_.push_back(element);
    in_start_tag_ = true;
    return *this;
}

Writer& Writer::attribute(std::string_view name, std::string_view value) {
    ((out_ += ' ') += name) += "=\"";
    append(out_, value, Place::attribute);
    out_ += '"';
    return *this;
}

Writer& Writer::attribute(std::string_view name, std::uint64_t value) {
    return attribute(name, std::string_view{std::to_string(value)});
}

Writer& Writer::attribute_unless_empty(std::string_view name, std::string_view value) {
    return value.empty() ? *this : attribute(name, value);
}

Writer& Writer::text(std::string_view value) {
    if (value.empty()) return *this;
    close_start_tag();
    append(out_, value, Place::text);
    return *this;
}

Writer& Writer::end() {
    if (in_start_tag_) {
        out_ += "/>";
        in_start_tag_ = false;
    } else {
        ((out_ += "</") += open_.back()) += '>';
    }
    open_.pop_back();
    return *this;
}

void Writer::close_start_tag() {
    if (in_start_tag_) out_ += '>';
    in_start_tag_ = false;
}

std::string number_text(double number) {
    if (std::isnan(number)) return "NaN";
    if (std::isinf(number)) return number < 0 ? "-INF" : "INF";
    std::array<char, 32> text{};
    auto const end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
    return {text.data(), end};
}

}  // namespace rois::xml
