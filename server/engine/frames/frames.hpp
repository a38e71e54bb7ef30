// The frames in which components and applications state positions, and the conversion between them (RLS data; decision 27;
// docs/frames.md).
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
#include "types/space.hpp"
#include "types/values.hpp"

namespace rois {

// All frames that the engine knows: its own, and frames placed in it or in one another. Frame names are not case-sensitive; an
// empty name means the engine's frame. Conversions leave values in unknown frames unchanged.
class Frames {
public:
    // The precision of converted numbers: a thousandth for values sent to applications; a millionth for values that are compared
    // or passed to components, so that they convert back exactly.
    enum class Rounding : std::uint8_t { thousandth, millionth };

    // Knows no frames: coordinates of any frame are compared without conversion.
    Frames() = default;

    // Throws std::invalid_argument if a frame is duplicated, is placed in an unknown frame or in itself, or has an invalid
    // placement: a number is not finite, or the covariance does not have 9 or 36 numbers, is not symmetric or not positive
    // semi-definite.
    Frames(std::string own, std::vector<Frame> others = {});

    std::string const& own() const { return own_; }

    // Returns these frames and others. Throws as the constructor does.
    Frames with(std::vector<Frame> others) const;

    // Adds a frame that is placed in a known one. Returns why the frame is not added, for the reasons of the constructor, or
    // nullopt.
    std::optional<std::string> include(Frame);

    // Returns whether the engine's frame is the only one. Then no value needs a conversion.
    bool are_one() const { return placed_.empty(); }
    bool know(std::string_view crs) const;
    std::vector<std::string> names() const;  // the engine's frame first
    std::vector<Frame> others() const;       // without the engine's own; each after the frame that it is placed in

    // Converts the position to the frame `to`. Converts a covariance to the first order, and adds those of the frames between.
    // The covariance keeps its form. The forms are
    //     x, y    x, y, yaw (x, y, z without orientation)    x, y, z, yaw    x, y, z, roll, pitch, yaw
    // A reliability is not changed. Returns why the covariance or the orientation is invalid, or nullopt.
    std::optional<std::string> change(Located&, std::string_view to) const;

    // Converts the points among the parameter's values ("x, y" or "x, y, th"), and sets the frame. Other values, such as names of
    // places, are not changed.
    void change(Parameter&, std::string_view to, Rounding) const;

    // Converts all positions to the engine's frame. Returns the first problem, as above.
    std::optional<std::string> change_to_own(Results&) const;

    // Whether the coordinates of the two can be compared without conversion.
    bool share(Geometry const& a, Geometry const& b) const;

    // Returns the geometry in the frame `to`. Returns nullopt for an unknown frame, for a box (a turned box is not a box), and
    // for a line, circle or polygon if the frames are tilted against each other.
    std::optional<Geometry> moved(Geometry const&, std::string_view to) const;

private:
    struct Placed;
    struct Step;

    void add(std::vector<Frame>);
    void insert(Frame);
    static std::string unknown_base(Frame const&);
    Placed const* find(std::string_view crs) const;  // null for the engine's frame
    std::vector<Placed const*> ancestry(std::string_view crs) const;
    std::optional<std::vector<Step>> way(std::string_view from, std::string_view to) const;

    // Converts the text "x, y" or "x, y, th"; nullopt for other texts.
    static std::optional<std::string> moved(std::string_view text, std::vector<Step> const& way, Rounding);

    std::string own_;
    std::map<std::string, std::shared_ptr<Placed const>> placed_;  // by name in lower case
};

// Calls `make` with both geometries in one frame. If only one is a box, its frame is used. Returns nullopt if they share no
// frame.
template <class Make>
std::optional<std::invoke_result_t<Make, Geometry const&, Geometry const&>> in_one_frame(Frames const& frames, Geometry const& a,
                                                                                         Geometry const& b, Make const& make) {
    if (frames.share(a, b)) return make(a, b);
    if (auto const moved = frames.moved(a, b.crs)) return make(*moved, b);
    if (auto const moved = frames.moved(b, a.crs)) return make(a, *moved);
    return {};
}

}  // namespace rois
