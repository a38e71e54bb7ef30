// The entries of parallel lists, and which of them a condition chooses (decision 19).
#pragma once

#include <string_view>

#include "engine/filter.hpp"
#include "types/values.hpp"

namespace rois {

// Removes what the filter does not match; `id` is the id by which the results were asked for.
//
// Lists of the same length are parallel: `person_ref`, `position_data` and the `located` elements of both. If the filter refers
// to such lists, each entry is matched as a whole row, with the scalar results beside it. The entries that match stay, and so do
// all scalars and the lists of other lengths. If the filter refers to no list, it is about the whole: all results stay, or none.
void keep_matching(Results&, Filter const&, std::string_view id);

}  // namespace rois
