// What a robot can show: the example codebook Reaction_Type of Annex D.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "simulation/pose.hpp"

namespace rois::simulation {

struct ReactionType {
    std::string_view name;
    Seconds duration;
};

// In the annex's order; the code of the first one is "1".
extern std::array<ReactionType, 50> const reaction_types;

// The code of a reaction that is named by its code or, in any case, by its name or that of its gesture, "bow", the first one that
// is seen as it; empty when it is none of these.
std::string reaction_code(std::string_view code_or_name);

// As which of the gestures() others see the reaction of that code; empty when as none.
std::string_view gesture_of(std::string_view code);

// The reaction of that code, which must be one.
ReactionType const& reaction_type(std::string_view code);

}  // namespace rois::simulation
