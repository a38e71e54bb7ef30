#include "choosing/fusion/person.hpp"

#include <cmath>
#include <limits>

namespace rois::choosing {
namespace {

constexpr double walks_on = 1.0;       // seconds that the predicted place of a lost person moves on
constexpr double wandering = 0.7;      // growth of a lost person's standard deviation, in m/s
constexpr double search_growth = 0.4;  // growth of the search radius for a lost person, in m/s, besides that of their velocity
constexpr double search_limit = 1.5;   // of this growth, in metres
constexpr double top_speed = 2.0;      // of persons, in m/s

double seconds(std::chrono::nanoseconds d) { return std::chrono::duration<double>{d}.count(); }

Estimate predicted(LastSeen const& last, Steady when) {
    double const dt = std::max(0.0, seconds(when - last.when));
    Estimate then = last.estimate;
    then.position.mean += then.velocity.mean * std::min(dt, walks_on);
    then.position.covariance += Matrix::Identity() * (wandering * dt) * (wandering * dt);
    return then;
}

// Returns the distance of a point from the straight line between two others.
double distance_from_line(Vector const& point, Vector const& from, Vector const& to) {
    Vector const along = to - from;
    double const length = along.squaredNorm();
    double const part = length > 0 ? std::clamp((point - from).dot(along) / length, 0.0, 1.0) : 0.0;
    return (point - from - part * along).norm();
}

}  // namespace

Estimate Person::at(Steady when) const { return is_sensed() ? fused(tracks, when) : predicted(last, when); }

Details const& Person::details() const {
    return is_sensed() ? (*std::ranges::max_element(tracks, {}, &Track::measured))->details() : last.details;
}

bool share_a_unit(Person const& a, Person const& b) {
    return std::ranges::any_of(a.tracks, [&](Track const* t) { return b.is_sensed_by(t->unit()); });
}

Estimate fused(std::span<Track* const> tracks, Steady when, int except) {
    Estimate all;
    int count = 0;
    for (Track const* track : tracks) {
        if (track->unit() == except) continue;
        Estimate const one = track->at(when);
        double const share = static_cast<double>(count) / (count + 1);
        all.position = count == 0 ? one.position : covariance_intersection(all.position, one.position, share);
        all.velocity = count == 0 ? one.velocity : covariance_intersection(all.velocity, one.velocity, share);
        ++count;
    }
    return all;
}

double gap(Matching const& matching, Estimate const& a, Estimate const& b) {
    double const distance = (a.position.mean - b.position.mean).squaredNorm();
    if (distance > matching.never_beyond * matching.never_beyond) return std::numeric_limits<double>::infinity();
    return deviations_apart(a.position, b.position);
}

double misfit(Estimate const& found, Steady when, LastSeen const& lost) {
    double const dt = std::max(0.0, seconds(when - lost.when));
    Vector velocity = lost.estimate.velocity.mean;
    if (velocity.norm() > top_speed) velocity *= top_speed / velocity.norm();
    Vector const from = lost.estimate.position.mean;
    // The person may have walked on, or stopped anywhere on the way.
    double const off = distance_from_line(found.position.mean, from, from + velocity * dt);
    double const noise = 3 * std::sqrt((found.position.covariance + lost.estimate.position.covariance).trace() / 2);
    if ((found.position.mean - from).norm() > top_speed * dt + noise) return 1;
    double const of_velocity = std::sqrt(lost.estimate.velocity.covariance.trace() / 2);
    return off / (noise + std::min((search_growth + of_velocity) * dt, search_limit));
}

}  // namespace rois::choosing
