// The codebooks of identifiers (decision 25), the `codebook_ref` of their data types.
#pragma once

#include <string_view>

namespace rois::basic::codebook {

// Temporary names of sensed people: "person-3", "face-3" and "sound-3" are the same person during one visit.
inline constexpr std::string_view track = "urn:x-rois:def:codebook:simulation::track";

// Permanent ids of known visitors.
inline constexpr std::string_view visitor = "urn:x-rois:def:codebook:simulation::visitor";

// Names of robots.
inline constexpr std::string_view robot = "urn:x-rois:def:codebook:simulation::robot";

// Contains the codes of the three codebooks above.
inline constexpr std::string_view entity = "urn:x-rois:def:codebook:simulation::entity";

// Gestures of visitors and robots: gestures().
inline constexpr std::string_view gesture = "urn:x-rois:def:codebook:simulation::gesture";

// The reactions of Annex D: "1" to "50".
inline constexpr std::string_view reaction = "urn:x-rois:def:codebook:simulation::reaction";

// ISO 5218: 0 not known, 1 male, 2 female, 9 not applicable.
inline constexpr std::string_view gender = "urn:iso:std:iso:5218";

}  // namespace rois::basic::codebook
