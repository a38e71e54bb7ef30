// Whether those who are localized have moved, seen through the noise of the sensor.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "simulation/pose.hpp"

namespace rois::simulation {

// Remembers where each one was when they were told of last. Positions are smoothed over some tenths of a second first, so that a
// sensor's noise is not taken for movement.
class Movement {
public:
    // Who is not measured for this long is forgotten, and new when they come back.
    static constexpr WorldTime memory{5'000};

    // The shortest movement that a sensor with this standard deviation tells from its noise.
    static Metres least_movement(Metres sigma);

    void measured(std::string const& ref, Point const& position, Covariance const&, WorldTime now);

    // Whether one who was measured now is new, or has moved further than `threshold` since they were told of. A threshold below
    // least_movement() counts as that.
    bool worth_telling(std::string const& ref, Metres threshold) const;

    void told(std::string const& ref);

    void forget_old(WorldTime now);
    void clear() { tracks_.clear(); }

private:
    struct Track {
        Point smoothed = Point::Zero();
        Metres sigma = 0;
        int measurements = 0;
        WorldTime last{};
        std::optional<Point> told;
    };
    std::map<std::string, Track> tracks_;
};

}  // namespace rois::simulation
