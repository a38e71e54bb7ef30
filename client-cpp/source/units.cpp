#include "rois/units.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "types/text/texts.hpp"
#include "xml/codec/writer.hpp"

namespace rois {

millimetres distance(Pose const& a, Pose const& b) {
    return millimetres{std::hypot(a.x.value - b.x.value, a.y.value - b.y.value)};
}

Pose before(Pose const& somebody, millimetres away, degrees turn) {
    auto const angle = (somebody.th + turn).value * std::numbers::pi / 180;
    return {somebody.x + away * std::cos(angle), somebody.y + away * std::sin(angle), somebody.th + turn + degrees{180},
            somebody.crs};
}

// Rounds to a thousandth of a millimetre or degree.
std::string to_text(Pose const& pose) {
    auto const number = [](double value) { return xml::number_text(std::round(value * 1'000) / 1'000 + 0.0); };
    return number(pose.x.value) + ", " + number(pose.y.value) + ", " + number(pose.th.value);
}

std::optional<Pose> to_pose(std::string_view text, std::string crs) {
    std::array<double, 3> numbers{};
    std::size_t count = 0;
    for (bool more = true; more; ++count) {
        if (count == numbers.size()) return std::nullopt;
        auto const comma = text.find(',');
        more = comma != text.npos;
        auto const number = to_double(text.substr(0, comma));
        if (!number || !std::isfinite(*number)) return std::nullopt;
        numbers.at(count) = *number;
        text.remove_prefix(more ? comma + 1 : text.size());
    }
    if (count < 2) return std::nullopt;
    return Pose{millimetres{numbers[0]}, millimetres{numbers[1]}, degrees{numbers[2]}, std::move(crs)};
}

}  // namespace rois
