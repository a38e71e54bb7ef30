// What references stand for in lists of parameters and results.
#pragma once

#include "engine/candidate.hpp"
#include "types/values.hpp"

namespace rois {

// What is longer, all values of a parameter or result together, is to conditions as if it were not there: else a session could
// make the engine read megabytes for each predicate of a condition.
inline constexpr std::size_t longest_value = 64 * 1024;  // bytes

bool speaks_of_results(Reference const&);

// The items of a list; the value of what is not a list.
Texts items_of(Parameter const&, Reference::Items);

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
