// The part of a condition that the component index can look up: refs and types of components.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

namespace rois {

// Only components with one of these refs or types can meet the condition. Types have the form of RegisteredComponent::type_key.
// The texts belong to the condition.
struct Demand {
    std::vector<std::string_view> refs;
    std::vector<std::string_view> types;

    // Adds the refs and types of `other`.
    void widen(Demand const& other) {
        refs.insert(refs.end(), other.refs.begin(), other.refs.end());
        types.insert(types.end(), other.types.begin(), other.types.end());
    }

    // Sorts the lists and removes duplicates.
    void tidy() {
        for (auto* texts : {&refs, &types}) {
            std::ranges::sort(*texts);
            auto const again = std::ranges::unique(*texts);
            texts->erase(again.begin(), again.end());
        }
    }
};

}  // namespace rois
