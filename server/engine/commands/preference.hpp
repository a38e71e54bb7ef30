// The order in which operations choose among several matching components (decisions 6 and 18).
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>
#include <string_view>
#include <vector>

namespace rois {

class RegisteredComponent;
struct Session;

// Counts the components that a session has bound, by engine (main engine or sub engine). Invalid once a binding changes.
class Preference {
public:
    explicit Preference(Session const& asker);

    // Sorts components by preference, for conditions that do not sort: first the engine of which the asker has bound the most
    // components, then the lowest code within its engine, then the lowest engine name.
    void order(std::vector<RegisteredComponent*>&) const;

    // Stable sort of a list that the condition has sorted: components of the engine with the most components bound by the asker
    // come first.
    template <class List, class Projection = std::identity>
    void bring_forward(List& list, Projection component = {}) const {
        if (bound_.empty()) return;
        std::ranges::stable_sort(list, std::ranges::greater{},
                                 [&](auto const& each) { return bound_beside(*std::invoke(component, each)); });
    }

private:
    std::size_t bound_beside(RegisteredComponent const&) const;

    std::map<std::string_view, std::size_t> bound_;  // components that the asker has bound, by engine
};

}  // namespace rois
