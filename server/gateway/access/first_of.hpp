// Which of many connections is the first to give way, without a look at all of them each time.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <ranges>
#include <utility>
#include <vector>

namespace rois {

// For ranks that grow with time: usually, a rank changes only to one that is not less than all ranks so far, or to `none`. An
// element whose rank has become less is found after at most 64 others.
template <class Element>
class FirstOf {
public:
    using Rank = std::int64_t;
    static constexpr Rank none = std::numeric_limits<Rank>::max();  // of an element that cannot be chosen

    // Returns the element with the least rank, or null. Call `forget` before an element ends.
    Element* operator()(std::vector<Element*> const& all, auto const& rank_of) {
        if (Element* const found = known(rank_of)) return found;
        std::vector<std::pair<Rank, Element*>> ranked;
        for (Element* each : all)
            if (Rank const rank = rank_of(*each); rank != none) ranked.emplace_back(rank, each);
        auto const some = std::min(most, ranked.size());
        std::ranges::partial_sort(ranked, ranked.begin() + static_cast<std::ptrdiff_t>(some));
        first_.assign(ranked.begin(), ranked.begin() + static_cast<std::ptrdiff_t>(some));
        std::ranges::reverse(first_);
        return known(rank_of);
    }

    void forget(Element const& element) {
        std::erase_if(first_, [&](auto const& each) { return each.second == &element; });
    }

private:
    static constexpr std::size_t most = 64;

    Element* known(auto const& rank_of) {
        while (!first_.empty() && rank_of(*first_.back().second) != first_.back().first) first_.pop_back();
        return first_.empty() ? nullptr : first_.back().second;
    }

    std::vector<std::pair<Rank, Element*>> first_;  // those with the least ranks when they were looked for, the first one last
};

}  // namespace rois
