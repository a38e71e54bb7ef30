// What references stand for in lists of parameters and results.
#pragma once

#include "engine/candidate.hpp"
#include "types/values.hpp"

namespace rois {

bool speaks_of_results(Reference const&);

// Of one parameter or result; null when it is not there.
Texts texts_in(Parameter const*, Reference const&);
Positions positions_in(Parameter const*, Reference const&);

Texts texts_in(Results const&, Reference const&);
Positions positions_in(Results const&, Reference const&);
bool is_in(Results const&, Reference const&);

// Only the one at the place that the reference says, when it says one.
template <class Value>
std::vector<Value> at_its_place(std::vector<Value> all, Reference const& reference) {
    if (reference.position == 0) return all;
    if (reference.position > all.size()) return {};
    return {std::move(all[reference.position - 1])};
}

}  // namespace rois
