// Numbers as texts.
#pragma once

#include <charconv>
#include <optional>
#include <string_view>

namespace rois {

// Returns nothing if the whole text is not such a number: digits, after '-' if the type is signed.
template <class Number>
std::optional<Number> to_number(std::string_view text) {
    Number number{};
    auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{} || end != text.data() + text.size()) return {};
    return number;
}

}  // namespace rois
