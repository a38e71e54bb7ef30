// Selects the entries of parallel lists that match a condition (decision 19).
#pragma once

#include <string_view>

#include "engine/conditions/filter.hpp"
#include "types/values.hpp"

namespace rois {

// Removes the results that the filter does not match. `id` is the id that the results were asked for by.
//
// Lists of the same length are parallel: `person_ref`, `position_data` and the `located` elements of both. If the filter refers
// to such lists, it is matched against each entry as a whole row, with the scalar results beside it. Keeps the entries that
// match, all scalars, and the lists of other lengths. If the filter refers to no list, keeps all results or none.
void keep_matching(Results&, Filter const&, std::string_view id);

}  // namespace rois
