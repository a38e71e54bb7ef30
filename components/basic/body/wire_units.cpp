#include "basic/body/wire_units.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "types/text/texts.hpp"

namespace rois::basic {
namespace {

constexpr double mm = 1000.0;

std::string whole(double value) { return std::to_string(std::lround(value)); }

double fine(double value) { return std::round(value * 1000.0) / 1000.0; }

std::optional<double> number(std::string_view text) {
    text = trimmed(text);
    if (text.starts_with('+')) text.remove_prefix(1);
    double value = 0;
    auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
    return value;
}

}  // namespace

double millimetres(Metres length) { return fine(length * mm); }

double degrees(Radians angle) { return fine(to_degrees(wrapped(angle))); }

std::string to_wire(Pose const& pose) {
    return whole(pose.position.x() * mm) + ", " + whole(pose.position.y() * mm) + ", " + whole(to_degrees(wrapped(pose.heading)));
}

std::optional<Target> target_from_wire(std::string_view text) {
    std::array<double, 3> read{};
    std::size_t count = 0;
    for (bool more = true; more; ++count) {
        auto comma = text.find(',');
        auto value = number(text.substr(0, comma));
        if (!value || count == read.size()) return std::nullopt;
        read[count] = *value;
        more = comma != std::string_view::npos;
        text.remove_prefix(more ? comma + 1 : text.size());
    }
    if (count < 2) return std::nullopt;
    Target target{Point{read[0] / mm, read[1] / mm}, std::nullopt};
    if (count == 3) target.heading = wrapped(from_degrees(read[2]));
    return target;
}

Located located(std::string of, std::string ref, std::string crs, Pose const& pose, Metres height,
                std::optional<Covariance> const& covariance) {
    Located made;
    made.of = std::move(of);
    made.ref = std::move(ref);
    made.crs = std::move(crs);
    made.position = {millimetres(pose.position.x()), millimetres(pose.position.y()), millimetres(height)};
    made.orientation = {0, 0, degrees(pose.heading)};
    if (covariance) made.certainty = Located::Covariance{rows_of(*covariance)};
    return made;
}

std::vector<double> rows_of(Covariance const& covariance) {
    Eigen::Vector3d const units{mm, mm, to_degrees(1.0)};
    Covariance const scaled = units.asDiagonal() * covariance * units.asDiagonal();
    std::vector<double> rows;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) rows.push_back(fine(scaled(row, column)));
    }
    return rows;
}

}  // namespace rois::basic
