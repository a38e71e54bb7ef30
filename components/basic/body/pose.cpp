#include "basic/body/pose.hpp"

#include <cmath>

namespace rois::basic {

Radians wrapped(Radians angle) {
    constexpr Radians turn = 2 * std::numbers::pi;
    angle = std::fmod(angle, turn);
    if (angle > std::numbers::pi) return angle - turn;
    if (angle <= -std::numbers::pi) return angle + turn;
    return angle;
}

Metres distance(Point const& a, Point const& b) { return (b - a).norm(); }

Radians direction(Point const& from, Point const& to) {
    Point way = to - from;
    return way.isZero(0) ? 0 : std::atan2(way.y(), way.x());
}

Radians bearing(Pose const& from, Point const& to) { return wrapped(direction(from.position, to) - from.heading); }

Point unit(Radians heading) { return {std::cos(heading), std::sin(heading)}; }

Eigen::Isometry2d frame(Pose const& body) {
    Eigen::Isometry2d frame = Eigen::Isometry2d::Identity();
    frame.translate(body.position);
    frame.rotate(body.heading);
    return frame;
}

}  // namespace rois::basic
