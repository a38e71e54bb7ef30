// Parses the ASCII names that almost all documents use, in one pass.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace rois::xml {

// A name of ASCII letters, digits and ".-_" with at most one colon. For any other text, none() is true, also for other valid
// names of XML.
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
    for (auto const c : std::string_view{"0123456789_-."}) table[static_cast<unsigned char>(c)] = true;
    return table;
}();

}  // namespace plain

// Returns the name that the text begins with.
inline PlainName plain_name_before(std::string_view text) {
    auto const end_of_part = [&](std::size_t begin) {
        auto end = begin;
        while (end < text.size() && plain::in_names[static_cast<unsigned char>(text[end])]) ++end;
        return end > begin && plain::is_letter(text[begin]) ? end : begin;
    };
    auto const is_colon = [&](std::size_t at) { return at < text.size() && text[at] == ':'; };
    auto const first = end_of_part(0);
    if (first == 0 || !is_colon(first)) return {text.substr(0, first), 0};
    auto const end = end_of_part(first + 1);
    if (end == first + 1 || is_colon(end)) return {};
    return {text.substr(0, end), first};
}

// Returns the whole text as a name.
inline PlainName plain_name(std::string_view text) {
    auto const name = plain_name_before(text);
    return name.whole().size() == text.size() ? name : PlainName{};
}

}  // namespace rois::xml
