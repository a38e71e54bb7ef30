// The reactions of robots: the example codebook Reaction_Type of Annex D.
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>

#include "basic/body/pose.hpp"

namespace rois::basic {

struct ReactionType {
    std::string_view name;
    Seconds duration;
};

// In the order of the annex. The code of the first reaction is "1".
extern std::array<ReactionType, 50> const reaction_types;

// Returns the code of a reaction given by its code, its name or the name of its gesture, "bow" (names ignore case). If several
// reactions have the same gesture, returns the first. Empty if unknown.
std::string reaction_code(std::string_view code_or_name);

// The gestures of people and robots: the codes of codebook::gesture.
std::span<std::string_view const> gestures();

// Returns which of the gestures() the reaction looks like; empty if none.
std::string_view gesture_of(std::string_view code);

// Returns the reaction with this code, which must be valid.
ReactionType const& reaction_type(std::string_view code);

}  // namespace rois::basic
