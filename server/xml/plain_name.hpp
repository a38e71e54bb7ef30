// Names as almost all documents write them, taken apart in one look.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace rois::xml {

// A name of ASCII letters, digits and ".-_" with at most one colon; or none, whatever it is to XML.
class PlainName {
public:
    PlainName() = default;
    // `colon` is its offset; 0 without one.
    PlainName(std::string_view whole, std::size_t colon) : whole_{whole}, colon_{colon} {}

    bool none() const { return whole_.empty(); }
    std::string_view whole() const { return whole_; }
    std::string_view prefix() const { return whole_.substr(0, colon_); }
    std::string_view local() const { return colon_ == 0 ? whole_ : whole_.substr(colon_ + 1); }

private:
    std::string_view whole_;
    std::size_t colon_ = 0;
};

namespace plain {

constexpr bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

inline constexpr auto in_names = [] {
    std::array<bool, 256> table{};
    for (auto c = 'a'; c <= 'z'; ++c) table[static_cast<unsigned char>(c)] = true;
    for (auto c = 'A'; c <= 'Z'; ++c) table[static_cast<unsigned char>(c)] = true;
    for (auto const c : std::string_view{"0123456789_-.:"}) table[static_cast<unsigned char>(c)] = true;
    return table;
}();

}  // namespace plain

// The one that a text begins with.
inline PlainName plain_name_before(std::string_view text) {
    std::size_t colons = 0, colon = 0, end = 0;
    for (; end < text.size() && plain::in_names[static_cast<unsigned char>(text[end])]; ++end) {
        if (text[end] != ':') continue;
        ++colons;
        colon = end;
    }
    bool const begins = end > 0 && plain::is_letter(text.front());
    bool const goes_on = colons == 0 || (colons == 1 && colon + 1 < end && plain::is_letter(text[colon + 1]));
    return {text.substr(0, begins && goes_on ? end : 0), colon};
}

// The text as a whole.
inline PlainName plain_name(std::string_view text) {
    auto const name = plain_name_before(text);
    return name.whole().size() == text.size() ? name : PlainName{};
}

}  // namespace rois::xml
