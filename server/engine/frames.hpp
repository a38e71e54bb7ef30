// The frames in which components and applications tell positions, and how what is told in one is told in another (RLS data;
// decision 27; docs/frames.md).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "types/condition.hpp"
#include "types/values.hpp"

namespace rois {

// A frame: its name, and where it is as seen from another one.
struct Frame {
    std::string crs;
    std::string base;                  // the frame that it is placed in
    std::array<double, 3> position{};  // of its origin, mm
    std::array<double, 3>
        orientation{};  // of its axes: roll, pitch, yaw in degrees; turned by roll about x first, by yaw about z last
    std::vector<double> covariance;  // of the placement, row by row in mm and degrees: of x, y, yaw (9 numbers), or of x, y, z,
                                     // roll, pitch, yaw (36); empty: it is certain
};

// All frames that an engine knows: its own, and those that are placed in it or in one another. Names have no case; an empty one
// means the engine's own. Each change of frame leaves what it cannot change as it is: what is in a frame that is not known.
class Frames {
public:
    // How finely numbers are rounded: what is told to applications to a thousandth, what is only compared or handed to a
    // component to a millionth, so that it is the same again when it comes back.
    enum class Rounding : std::uint8_t { thousandth, millionth };

    // None is known: coordinates of any frame are taken as they are.
    Frames() = default;

    // Throws std::invalid_argument for a frame that is there twice, one that is placed in none that is known or in itself, and a
    // placement that is not finite or whose covariance is none: not of 9 or 36 numbers, not symmetric, not positive
    // semi-definite.
    Frames(std::string own, std::vector<Frame> others = {});

    std::string const& own() const { return own_; }

    // Whether there is nothing to change.
    bool are_one() const { return placed_.empty(); }
    bool know(std::string_view crs) const;
    std::vector<std::string> names() const;  // the engine's own first

    // Tells in the frame `to` where an entity is. A covariance is carried along to the first order, and takes in those of the
    // placements on the way; it keeps its form, which is one of
    //     x, y    x, y, yaw (x, y, z without orientation)    x, y, z, yaw    x, y, z, roll, pitch, yaw
    // A reliability stays. Why it cannot be done, when the covariance is none of these or the orientation is none; else nothing.
    std::optional<std::string> change(Located&, std::string_view to) const;

    // Tells in the frame `to` the points among a parameter's values ("x, y" or "x, y, th"), and which frame that is; other
    // values, the names of places for one, stay.
    void change(Parameter&, std::string_view to, Rounding) const;

    // Tells in the engine's own frame all that says another one. As above.
    std::optional<std::string> change_to_own(Results&) const;

    // Whether coordinates of the two may be compared as they are.
    bool share(Geometry const& a, Geometry const& b) const;

    // The geometry in the frame `to`; nothing for a frame that is not known, for a box, which may not be a box there, and for a
    // line, circle or polygon when the frames are tilted against each other.
    std::optional<Geometry> moved(Geometry const&, std::string_view to) const;

private:
    struct Placed;
    struct Step;

    Placed const* find(std::string_view crs) const;  // null for the engine's own
    std::vector<Placed const*> ancestry(std::string_view crs) const;
    std::optional<std::vector<Step>> way(std::string_view from, std::string_view to) const;

    // The text "x, y" or "x, y, th" at the end of a way; nothing when it is neither.
    static std::optional<std::string> moved(std::string_view text, std::vector<Step> const& way, Rounding);

    std::string own_;
    std::map<std::string, std::shared_ptr<Placed const>> placed_;  // by name in lower case
};

// What is made of the two in one frame, a box's where there is a box; nothing when they have none in common.
template <class Make>
std::optional<std::invoke_result_t<Make, Geometry const&, Geometry const&>> in_one_frame(Frames const& frames, Geometry const& a,
                                                                                         Geometry const& b, Make const& make) {
    if (frames.share(a, b)) return make(a, b);
    if (auto const moved = frames.moved(a, b.crs)) return make(*moved, b);
    if (auto const moved = frames.moved(b, a.crs)) return make(a, *moved);
    return {};
}

}  // namespace rois
