#include "xml/codec/writer.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "xml/codec/characters.hpp"

namespace rois::xml {

namespace {

using namespace std::string_view_literals;

constexpr std::string_view replacement = "\xEF\xBF\xBD";  // U+FFFD, for characters that XML does not allow

enum class Place { text, attribute };

// Returns how a character is escaped here; empty if it needs no escaping.
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

// The ASCII characters that need no escaping.
constexpr Table plain(Place place) {
    Table table{};
    for (std::size_t c = ' '; c < 0x80; ++c) table[c] = escaped(static_cast<char>(c), place).empty();
    return table;
}
constexpr Table plain_in_text = plain(Place::text);
constexpr Table plain_in_attributes = plain(Place::attribute);

bool is_plain(std::string_view value, Place place) {
    auto const& table = place == Place::text ? plain_in_text : plain_in_attributes;
    return std::ranges::all_of(value, [&](char c) { return table[static_cast<unsigned char>(c)]; });
}

}  // namespace

void Writer::grow(std::size_t wanted) { text_.resize(std::max(length_ + wanted, text_.size() * 2)); }

// Appends the pieces, and checks the size of the buffer only once.
template <class... Pieces>
void Writer::append(Pieces const&... pieces) {
    auto const wanted = (std::string_view{pieces}.size() + ...);
    if (text_.size() - length_ < wanted) grow(wanted);
    auto* to = text_.data() + length_;
    ((to += std::string_view{pieces}.copy(to, pieces.size())), ...);
    length_ += wanted;
}

void Writer::append_unusual(std::string_view value, bool in_attribute) {
    auto const place = in_attribute ? Place::attribute : Place::text;
    while (!value.empty()) {
        auto const bad = first_bad_character(value);
        auto const clean = value.substr(0, bad ? bad->offset : value.size());
        value.remove_prefix(bad ? bad->offset + bad->length : value.size());
        std::size_t done = 0;
        for (std::size_t i = 0; i < clean.size(); ++i) {
            auto const form = escaped(clean[i], place);
            if (form.empty()) continue;
            append(clean.substr(done, i - done), form);
            done = i + 1;
        }
        append(clean.substr(done), bad ? replacement : ""sv);
    }
}

Writer& Writer::start(std::string_view element) {
    append(std::exchange(in_start_tag_, true) ? "><"sv : "<"sv, element);
    open_.push_back(element);
    return *this;
}

Writer& Writer::constant(std::string_view name, std::string_view value) {
    append(" "sv, name, R"(=")"sv, value, R"(")"sv);
    return *this;
}

Writer& Writer::attribute(std::string_view name, std::string_view value) {
    if (is_plain(value, Place::attribute)) return constant(name, value);
    append(" "sv, name, R"(=")"sv);
    append_unusual(value, true);
    append(R"(")"sv);
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
    auto const end_of_tag = std::exchange(in_start_tag_, false) ? ">"sv : ""sv;
    if (is_plain(value, Place::text)) {
        append(end_of_tag, value);
    } else {
        append(end_of_tag);
        append_unusual(value, false);
    }
    return *this;
}

Writer& Writer::end() {
    if (std::exchange(in_start_tag_, false)) {
        append("/>"sv);
    } else {
        append("</"sv, open_.back(), ">"sv);
    }
    open_.pop_back();
    return *this;
}

std::string number_text(double number) {
    if (std::isnan(number)) return "NaN";
    if (std::isinf(number)) return number < 0 ? "-INF" : "INF";
    std::array<char, 32> text{};
    auto const end = std::to_chars(text.data(), text.data() + text.size(), number).ptr;
    return {text.data(), end};
}

}  // namespace rois::xml
