#include "simulation/movement.hpp"

#include <algorithm>
#include <cmath>

namespace rois::simulation {
namespace {

// The mean of the first five measurements, then a moving one: its noise is a third of the sensor's.
constexpr int settling = 5;

// In standard deviations of the sensor: five of the difference of two smoothed positions.
constexpr double noise = 2.5;

}  // namespace

Metres Movement::least_movement(Metres sigma) { return noise * sigma; }

void Movement::measured(std::string const& ref, Point const& position, Covariance const& covariance, WorldTime now) {
    Track& track = tracks_[ref];
    track.measurements = std::min(track.measurements + 1, settling);
    track.smoothed += (position - track.smoothed) / track.measurements;
    track.sigma = std::sqrt(covariance.topLeftCorner<2, 2>().trace() / 2);
    track.last = now;
    if (track.told && track.measurements < settling) track.told = track.smoothed;
}

bool Movement::worth_telling(std::string const& ref, Metres threshold) const {
    auto const found = tracks_.find(ref);
    if (found == tracks_.end() || !found->second.told) return true;
    Track const& track = found->second;
    return distance(track.smoothed, *track.told) > std::max(threshold, least_movement(track.sigma));
}

void Movement::told(std::string const& ref) {
    Track& track = tracks_[ref];
    track.told = track.smoothed;
}

void Movement::forget_old(WorldTime now) {
    std::erase_if(tracks_, [&](auto const& entry) { return entry.second.last + memory < now; });
}

}  // namespace rois::simulation
