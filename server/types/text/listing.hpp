// Joins texts for reasons: "desk, entrance, exit".
#pragma once

#include <cstddef>
#include <functional>
#include <ranges>
#include <string>
#include <utility>

namespace rois {

// Returns the texts of all elements, in order, separated by ", ". `text` returns the text of an element.
template <std::ranges::input_range Range, class Text = std::identity>
std::string listed(Range&& range, Text text = {}) {
    std::string all;
    for (auto const& each : std::views::all(std::forward<Range>(range))) {
        if (!all.empty()) all += ", ";
        all += std::invoke(text, each);
    }
    return all;
}

// The same for the first 50 elements: "desk, entrance and 12 more". With many sub engines, a list of all names would be too long.
template <std::ranges::sized_range Range, class Text = std::identity>
std::string first_listed(Range const& range, Text text = {}) {
    constexpr std::size_t most = 50;
    auto const all = listed(range | std::views::take(most), std::move(text));
    auto const count = std::ranges::size(range);
    return count > most ? all + " and " + std::to_string(count - most) + " more" : all;
}

}  // namespace rois
