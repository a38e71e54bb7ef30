#include "basic/base/movement.hpp"

#include <algorithm>
#include <cmath>

namespace rois::basic {
namespace {

// The number of measurements for the first mean. The moving mean afterwards has a third of the sensor's noise.
constexpr int settling = 5;

// In standard deviations of the sensor. This is five standard deviations of the difference between two smoothed positions.
constexpr double noise = 2.5;

}  // namespace

Metres Movement::least_movement(Metres sigma) { return noise * sigma; }

void Movement::measured(std::string const& ref, Point const& position, Covariance const& covariance, WorldTime now) {
    Track& track = tracks_[ref];
    track.measurements = std::min(track.measurements + 1, settling);
    track.smoothed += (position - track.smoothed) / track.measurements;
    track.sigma = std::sqrt(covariance.topLeftCorner<2, 2>().trace() / 2);
    track.last = now;
    if (track.reported && track.measurements < settling) track.reported = track.smoothed;
}

bool Movement::worth_reporting(std::string const& ref, Metres threshold) const {
    auto const found = tracks_.find(ref);
    if (found == tracks_.end() || !found->second.reported) return true;
    Track const& track = found->second;
    return distance(track.smoothed, *track.reported) > std::max(threshold, least_movement(track.sigma));
}

void Movement::reported(std::string const& ref) {
    Track& track = tracks_[ref];
    track.reported = track.smoothed;
}

void Movement::forget_old(WorldTime now) {
    std::erase_if(tracks_, [&](auto const& entry) { return entry.second.last + memory < now; });
}

}  // namespace rois::basic
