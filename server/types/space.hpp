// The space of an engine: the frames of its positions, and its named places (docs/frames.md).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "types/condition.hpp"

namespace rois {

// A frame and its position in another frame.
struct Frame {
    std::string crs;
    std::string base;                  // the frame in which this one is placed; empty: the engine's own
    std::array<double, 3> position{};  // of its origin, mm
    std::array<double, 3>
        orientation{};  // of its axes: roll, pitch, yaw in degrees; turned by roll about x first, by yaw about z last
    std::vector<double> covariance;  // of the placement, row by row in mm and degrees: of x, y, yaw (9 numbers), or of x, y, z,
                                     // roll, pitch, yaw (36); empty: it is certain

    bool operator==(Frame const&) const = default;
};

// An area that conditions refer to by name.
struct NamedPlace {
    std::string name;
    Geometry area;

    bool operator==(NamedPlace const&) const = default;
};

// What an engine tells another engine of its space (decision 41). Without the engine's own frame, which its profile names.
struct Space {
    std::vector<Frame> frames;  // each after the frame that it is placed in
    std::vector<NamedPlace> places;

    bool operator==(Space const&) const = default;
};

}  // namespace rois
