// The space that the engine's components share, as whoever knows the floor plan tells it: its frames, and places with names.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "engine/frames.hpp"
#include "types/condition.hpp"

namespace rois {

// An area that conditions mean by a name.
struct NamedPlace {
    std::string name;
    Geometry area;
};

struct Places {
    Frames frames;  // the areas, and coordinates that say none, are in the engine's own
    std::vector<NamedPlace> all;

    // Null when there is none of that name, to the letter.
    NamedPlace const* find(std::string_view name) const {
        auto const found = std::ranges::find(all, name, &NamedPlace::name);
        return found == all.end() ? nullptr : &*found;
    }
};

}  // namespace rois
