// Joins texts for reasons: "desk, entrance, exit".
#pragma once

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

}  // namespace rois
