// Which of several components that match an operation takes (decisions 6 and 18).
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

// The robots (engines and sub engines) that a session works with. Valid until a binding changes.
class Preference {
public:
    explicit Preference(Session const& asker);

    // Sorts components into the order in which one is taken when the condition does not sort: first the engine of which the asker
    // has bound the most components, then the lowest code within its engine, then the lowest engine name.
    void order(std::vector<RegisteredComponent*>&) const;

    // Moves the engines of which the asker has bound more components to the front of a list that the condition has sorted. Within
    // one number of bound components the order stays.
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
