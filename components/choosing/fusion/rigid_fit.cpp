#include "choosing/fusion/rigid_fit.hpp"

#include <algorithm>
#include <cmath>

namespace rois::choosing {
namespace {

constexpr double least_spread = 0.25;  // m^2; less shows no rotation

double cross_of(Vector const& x, Vector const& y) { return x.x() * y.y() - x.y() * y.x(); }

}  // namespace

Matrix Rigid::rotation() const {
    Matrix rotation;
    rotation << std::cos(turn), -std::sin(turn), std::sin(turn), std::cos(turn);
    return rotation;
}

void RigidSums::add(Vector const& x, Vector const& y, double weight) {
    weight_ += weight;
    x_ += weight * x;
    y_ += weight * y;
    xx_ += weight * x.squaredNorm();
    yy_ += weight * y.squaredNorm();
    dot_ += weight * x.dot(y);
    cross_ += weight * cross_of(x, y);
}

void RigidSums::add(RigidSums const& other) {
    weight_ += other.weight_;
    x_ += other.x_;
    y_ += other.y_;
    xx_ += other.xx_;
    yy_ += other.yy_;
    dot_ += other.dot_;
    cross_ += other.cross_;
}

double RigidSums::cross() const { return cross_ / weight_ - cross_of(mean_x(), mean_y()); }

Rigid RigidSums::fit() const {
    Rigid motion;
    if (spread() >= least_spread) motion.turn = std::atan2(cross(), dot());
    motion.shift = mean_y() - motion.rotation() * mean_x();
    return motion;
}

double RigidSums::error(Rigid const& motion) const {
    double const of_means = (mean_y() - motion(mean_x())).squaredNorm();
    double const spread_y = yy_ / weight_ - mean_y().squaredNorm();
    double const common = std::cos(motion.turn) * dot() + std::sin(motion.turn) * cross();
    return of_means + std::max(0.0, spread() + spread_y - 2 * common);
}

}  // namespace rois::choosing
