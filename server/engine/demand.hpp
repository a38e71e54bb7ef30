// What a condition demands of components, as far as there are indexes for it.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

namespace rois {

// Only components with one of these refs and those of one of these types can meet the condition. The types are as
// `RegisteredComponent::type_key` has them. All points into what was asked for it.
struct Demand {
    std::vector<std::string_view> refs;
    std::vector<std::string_view> types;

    // From now on what meets the other is let in, too.
    void widen(Demand const& other) {
        refs.insert(refs.end(), other.refs.begin(), other.refs.end());
        types.insert(types.end(), other.types.begin(), other.types.end());
    }

    // In order, each once.
    void tidy() {
        for (auto* texts : {&refs, &types}) {
            std::ranges::sort(*texts);
            auto const again = std::ranges::unique(*texts);
            texts->erase(again.begin(), again.end());
        }
    }
};

}  // namespace rois
