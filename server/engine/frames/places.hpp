// The space that the engine's components share, from the floor plan: frames and named places.
#pragma once

#include <algorithm>
#include <string_view>
#include <vector>

#include "engine/frames/frames.hpp"
#include "types/space.hpp"

namespace rois {

struct Places {
    Frames frames;  // coordinates without a frame are in the engine's frame
    std::vector<NamedPlace> all;

    // Finds a place by its exact name. Returns null if there is none.
    NamedPlace const* find(std::string_view name) const {
        auto const found = std::ranges::find(all, name, &NamedPlace::name);
        return found == all.end() ? nullptr : &*found;
    }
};

}  // namespace rois
