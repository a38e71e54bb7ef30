#include "simulation/plan/routing.hpp"

#include <algorithm>
#include <cmath>

namespace rois::simulation {
namespace {

constexpr Radians straight_ahead = 0.08;  // a standing robot with a smaller heading error drives on without a turn

// The duration from standstill to standstill.
Seconds shortest(double way, double speed, double acceleration) {
    if (way >= speed * speed / acceleration) return way / speed + speed / acceleration;
    return 2 * std::sqrt(way / acceleration);
}

}  // namespace

MetresPerSecond corner_speed(Radians turn, Agility const& agility) {
    return std::max(0.0, 1 - std::abs(turn) / sharpest_bend) * agility.speed;
}

MetresPerSecond passing_speed(Radians turn, Agility const& agility) {
    if (std::abs(turn) >= sharpest_bend) return 0;
    return std::min(agility.speed, std::hypot(corner_speed(turn, agility), std::sqrt(2 * agility.acceleration * near_corner)));
}

Seconds turn_duration(Radians turn, Agility const& agility) {
    Seconds const to_its_end = shortest(std::abs(turn), agility.turn_rate, agility.turn_acceleration);
    return std::max(0.0, to_its_end - std::sqrt(2 * turned_enough / agility.turn_acceleration));
}

Seconds corner_duration(Radians turn, Agility const& agility) {
    if (std::abs(turn) < sharpest_bend) return 0;
    return std::max(0.0, turn_duration(turn, agility) - 2 * slow_enough / agility.acceleration);
}

Seconds leg_duration(Metres length, MetresPerSecond at_begin, MetresPerSecond at_end, Agility const& agility) {
    double const squared = agility.acceleration * length + (at_begin * at_begin + at_end * at_end) / 2;
    MetresPerSecond const top = std::clamp(std::sqrt(squared), std::max(at_begin, at_end), agility.speed);
    Metres const changing = ((top * top - at_begin * at_begin) + (top * top - at_end * at_end)) / (2 * agility.acceleration);
    return (2 * top - at_begin - at_end) / agility.acceleration + (top > 0 ? std::max(0.0, length - changing) / top : 0);
}

Seconds duration(Pose const& from, std::vector<Point> const& way, Agility const& agility) {
    std::vector<MetresPerSecond> speeds(way.size(), 0.0);  // at the corners, limited by all later corners
    for (std::size_t i = way.size() - 1; i-- > 0;) {
        Point const& before = i == 0 ? from.position : way[i - 1];
        Radians const turn = wrapped(direction(way[i], way[i + 1]) - direction(before, way[i]));
        MetresPerSecond const braking =
            std::sqrt(speeds[i + 1] * speeds[i + 1] + 2 * agility.acceleration * distance(way[i], way[i + 1]));
        speeds[i] = std::min(passing_speed(turn, agility), braking);
    }
    Seconds sum = 0;
    Pose at = from;
    MetresPerSecond speed = 0;
    for (std::size_t i = 0; i < way.size(); ++i) {
        Metres const leg = distance(at.position, way[i]);
        Radians const turn = std::abs(bearing(at, way[i]));
        if (i > 0) sum += corner_duration(turn, agility);
        if (i == 0 && turn > straight_ahead) sum += turn_duration(turn, agility);
        MetresPerSecond const at_end = std::min(speeds[i], std::sqrt(speed * speed + 2 * agility.acceleration * leg));
        sum += leg_duration(leg, speed, at_end, agility);
        speed = at_end;
        at = {way[i], direction(at.position, way[i])};
    }
    return sum;
}

Metres length(Point const& from, std::vector<Point> const& way) {
    Metres sum = 0;
    Point at = from;
    for (Point const& corner : way) {
        sum += distance(at, corner);
        at = corner;
    }
    return sum;
}

}  // namespace rois::simulation
