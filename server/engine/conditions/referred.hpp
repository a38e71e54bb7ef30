// The values of references in lists of parameters and results.
#pragma once

#include "engine/conditions/candidate.hpp"
#include "types/values.hpp"

namespace rois {

// A parameter or result whose values are longer in total counts as missing. Without this limit, a session could make the engine
// read megabytes for each predicate of a condition.
inline constexpr std::size_t longest_value = 64 * 1024;  // bytes

bool speaks_of_results(Reference const&);

// The items of a list, or the single value.
Texts items_of(Parameter const&, Reference::Items);

// The values in one parameter or result; null counts as missing.
Texts texts_in(Parameter const*, Reference const&);
Positions positions_in(Parameter const*, Reference const&);

Texts texts_in(Results const&, Reference const&);
Positions positions_in(Results const&, Reference const&);
bool is_in(Results const&, Reference const&);

// If the reference names a place in the list, keeps only the value there.
template <class Value>
std::vector<Value> at_its_place(std::vector<Value> all, Reference const& reference) {
    if (reference.position == 0) return all;
    if (reference.position > all.size()) return {};
    return {std::move(all[reference.position - 1])};
}

}  // namespace rois
