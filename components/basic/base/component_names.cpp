#include "basic/base/component_names.hpp"

#include <algorithm>
#include <array>
#include <span>

#include "types/text/texts.hpp"

namespace rois::basic {

namespace {

struct Range {
    char32_t first;
    char32_t last;
};
// Non-ASCII characters of XML names (XML 1.0): NameStartChar, and the additional ones of NameChar.
constexpr std::array<Range, 11> letters{{{0xC0, 0xD6},
                                         {0xD8, 0xF6},
                                         {0xF8, 0x2FF},
                                         {0x370, 0x37D},
                                         {0x37F, 0x1FFF},
                                         {0x200C, 0x200D},
                                         {0x2070, 0x218F},
                                         {0x2C00, 0x2FEF},
                                         {0x3001, 0xD7FF},
                                         {0xF900, 0xFDCF},
                                         {0xFDF0, 0xEFFFF}}};
constexpr std::array<Range, 3> inside_names{{{0xB7, 0xB7}, {0x300, 0x36F}, {0x203F, 0x2040}}};

bool is_in(std::span<Range const> ranges, char32_t c) {
    return std::ranges::any_of(ranges, [&](Range const& range) { return range.first <= c && c <= range.last; });
}

bool is_letter(char32_t c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || is_in(letters, c); }
bool is_small_or_digit(char32_t c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); }
bool is_big(char32_t c) { return c >= 'A' && c <= 'Z'; }
bool is_in_names(char32_t c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '-' || is_in(inside_names, c); }

}  // namespace

bool is_name(std::string_view text) {
    auto const first = take_character(text);
    if (!first || !is_letter(*first)) return false;
    while (auto const c = take_character(text))
        if (!is_in_names(*c)) return false;
    return true;
}

std::string component_ref(std::string_view component, std::string_view engine) {
    return engine.empty() ? std::string{component} : std::string{engine} + "." + std::string{component};
}

std::string component_name(ComponentProfile const& profile) {
    if (is_name(profile.object.name)) return profile.object.name;
    auto const& urn = profile.object.identifier;
    std::string name;
    auto rest = std::string_view{urn}.substr(urn.rfind(':') + 1);
    while (!rest.empty()) {
        auto const before = rest;
        auto const c = *take_character(rest);
        if (is_big(c) && !name.empty() && is_small_or_digit(static_cast<unsigned char>(name.back()))) name += '_';
        name += is_in_names(c) && c != '-' ? before.substr(0, before.size() - rest.size()) : "_";
    }
    return is_name(name) ? lower_case(name) : "_" + lower_case(name);
}

}  // namespace rois::basic
