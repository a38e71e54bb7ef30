#include "choosing/fusion/track.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace rois::choosing {
namespace {

constexpr double acceleration = 0.15;   // spectral density of the random acceleration, in m^2/s^3
constexpr double first_speed = 1.0;     // standard deviation of a new person's velocity, in m/s for each axis
constexpr double standing_speed = 0.5;  // the same after a silence
constexpr double top_speed = 2.5;       // in m/s; faster is a jump

double seconds(std::chrono::nanoseconds d) { return std::chrono::duration<double>{d}.count(); }

}  // namespace

Track::Track(std::uint64_t id, int unit, std::string name, UnitSettings const& settings, Measurement const& first, Steady when)
    : id_{id},
      unit_{unit},
      name_{std::move(name)},
      settings_{settings},
      filter_{State::Zero(), StateCovariance::Identity() * first_speed * first_speed},
      measured_{when},
      details_{first.details} {
    filter_.mean.head<2>() = first.position.mean;
    filter_.covariance.topLeftCorner<2, 2>() = first.position.covariance;
    now = at(when);
}

Track::Filter Track::predicted(Steady when) const {
    Filter next = filter_;
    if (stands(when)) {
        next.mean.tail<2>().setZero();
        next.covariance.topRightCorner<2, 2>().setZero();
        next.covariance.bottomLeftCorner<2, 2>().setZero();
        next.covariance.bottomRightCorner<2, 2>() = Matrix::Identity() * standing_speed * standing_speed;
        // The variance of a point anywhere in a circle of this radius is a quarter of the radius squared.
        next.covariance.topLeftCorner<2, 2>() += Matrix::Identity() * settings_.still_within * settings_.still_within / 4;
        return next;
    }
    double const dt = std::max(0.0, seconds(when - measured_));
    StateCovariance step = StateCovariance::Identity();
    step.topRightCorner<2, 2>() = Matrix::Identity() * dt;
    StateCovariance noise;
    noise.topLeftCorner<2, 2>() = Matrix::Identity() * dt * dt * dt / 3;
    noise.topRightCorner<2, 2>() = Matrix::Identity() * dt * dt / 2;
    noise.bottomLeftCorner<2, 2>() = noise.topRightCorner<2, 2>();
    noise.bottomRightCorner<2, 2>() = Matrix::Identity() * dt;
    next.mean = step * filter_.mean;
    next.covariance = step * filter_.covariance * step.transpose() + noise * acceleration;
    return next;
}

bool Track::can_reach(Measurement const& next, Steady when) const {
    double const moved = (next.position.mean - filter_.mean.head<2>()).norm();
    double const variance = (next.position.covariance + filter_.covariance.topLeftCorner<2, 2>() + reserve_).trace();
    return moved <= top_speed * seconds(when - measured_) + settings_.still_within + 4 * std::sqrt(variance);
}

void Track::measure(Measurement const& measurement, Steady when) {
    Filter const before = predicted(when);
    Matrix const error = measurement.position.covariance;
    Eigen::Matrix<double, 4, 2> const cross = before.covariance.leftCols<2>();
    Eigen::Matrix<double, 4, 2> const gain = cross * (cross.topRows<2>() + error).inverse();
    filter_.mean = before.mean + gain * (measurement.position.mean - before.mean.head<2>());
    filter_.covariance = before.covariance - gain * cross.transpose();
    filter_.covariance = (filter_.covariance + filter_.covariance.transpose()).eval() / 2;
    reserve_ = error - filter_.covariance.topLeftCorner<2, 2>();
    measured_ = when;
    details_ = measurement.details;
}

Estimate Track::at(Steady when) const {
    Filter const then = predicted(when);
    return {{then.mean.head<2>(), then.covariance.topLeftCorner<2, 2>() + reserve_},
            {then.mean.tail<2>(), then.covariance.bottomRightCorner<2, 2>()}};
}

}  // namespace rois::choosing
