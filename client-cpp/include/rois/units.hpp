// Types for millimetre and degree, which documents carry as bare numbers (decision 27 of docs/conformance-decisions.md).
#pragma once

#include <compare>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace rois {

namespace detail {

// A number with a unit. Can be added to and compared with numbers of the same unit only.
template <class Self>
struct Quantity {
    double value = 0;

    friend constexpr auto operator<=>(Quantity, Quantity) = default;
    friend constexpr Self operator+(Self a, Self b) { return Self{a.value + b.value}; }
    friend constexpr Self operator-(Self a, Self b) { return Self{a.value - b.value}; }
    friend constexpr Self operator-(Self a) { return Self{-a.value}; }
    friend constexpr Self operator*(Self a, double factor) { return Self{a.value * factor}; }
    friend constexpr Self operator*(double factor, Self a) { return Self{a.value * factor}; }
    friend constexpr Self operator/(Self a, double divisor) { return Self{a.value / divisor}; }
    friend constexpr double operator/(Self a, Self b) { return a.value / b.value; }

private:
    friend Self;
    constexpr Quantity() = default;
    explicit constexpr Quantity(double number) : value{number} {}
};

}  // namespace detail

struct millimetres : detail::Quantity<millimetres> {
    constexpr millimetres() = default;
    explicit constexpr millimetres(double number) : Quantity{number} {}
};

// Counter-clockwise.
struct degrees : detail::Quantity<degrees> {
    constexpr degrees() = default;
    explicit constexpr degrees(double number) : Quantity{number} {}
};

// `using namespace rois::literals;`: 500_mm, 1.5_m, 90_deg.
inline namespace literals {

constexpr millimetres operator""_mm(long double number) { return millimetres{static_cast<double>(number)}; }
constexpr millimetres operator""_mm(unsigned long long number) { return millimetres{static_cast<double>(number)}; }
constexpr millimetres operator""_m(long double number) { return millimetres{static_cast<double>(number) * 1000}; }
constexpr millimetres operator""_m(unsigned long long number) { return millimetres{static_cast<double>(number) * 1000}; }
constexpr degrees operator""_deg(long double number) { return degrees{static_cast<double>(number)}; }
constexpr degrees operator""_deg(unsigned long long number) { return degrees{static_cast<double>(number)}; }

}  // namespace literals

// The position and heading of a person or object.
struct Pose {
    Pose() = default;
    Pose(millimetres east, millimetres north, degrees towards = {}, std::string frame = {})
        : x{east}, y{north}, th{towards}, crs{std::move(frame)} {}

    millimetres x;
    millimetres y;
    degrees th;
    std::string crs;  // the frame; empty: the engine's own

    bool operator==(Pose const&) const = default;
};

millimetres distance(Pose const&, Pose const&);

// Returns the pose this far in front of a person, facing them. `turn` moves it around the person, to their left when positive.
Pose before(Pose const&, millimetres away, degrees turn = {});

// Converts a pose to "x, y, th", the form of parameters and results, and back. to_pose returns nothing if the text is not a pose;
// a missing th is 0.
std::string to_text(Pose const&);
std::optional<Pose> to_pose(std::string_view text, std::string crs = {});

}  // namespace rois
