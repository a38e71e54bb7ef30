// Things named one after the other, as reasons do it: "desk, entrance, exit".
#pragma once

#include <functional>
#include <ranges>
#include <string>
#include <utility>

namespace rois {

// The text of each, in the range's order; empty when there is none.
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
