// Detects movement of localized people and sounds despite the sensor's noise.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "basic/body/pose.hpp"

namespace rois::basic {

// Remembers the last reported position of each ref. Positions are smoothed over some tenths of a second.
class Movement {
public:
    // A ref without measurements for this long is forgotten.
    static constexpr WorldTime memory{5'000};

    // The shortest movement that is distinguishable from the noise of a sensor with this standard deviation.
    static Metres least_movement(Metres sigma);

    void measured(std::string const& ref, Point const& position, Covariance const&, WorldTime now);

    // Whether a ref is new, or has moved more than `threshold` since reported(). The threshold is at least least_movement().
    bool worth_reporting(std::string const& ref, Metres threshold) const;

    void reported(std::string const& ref);

    void forget_old(WorldTime now);
    void clear() { tracks_.clear(); }

private:
    struct Track {
        Point smoothed = Point::Zero();
        Metres sigma = 0;
        int measurements = 0;
        WorldTime last{};
        std::optional<Point> reported;
    };
    std::map<std::string, Track> tracks_;
};

}  // namespace rois::basic
