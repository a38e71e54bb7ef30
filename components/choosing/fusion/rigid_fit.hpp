// The rotation and shift between two series of points.
#pragma once

#include "choosing/fusion/estimate.hpp"

namespace rois::choosing {

// y = rotation by `turn` of x, plus `shift`.
struct Rigid {
    double turn = 0;  // radians, counter-clockwise
    Vector shift = Vector::Zero();

    Matrix rotation() const;
    Vector operator()(Vector const& x) const { return rotation() * x + shift; }
};

// Weighted sums over pairs of points (x, y), and the rigid motion that fits them best (least squares).
class RigidSums {
public:
    void add(Vector const& x, Vector const& y, double weight);
    void add(RigidSums const&);

    double weight() const { return weight_; }
    Vector mean_x() const { return x_ / weight_; }
    Vector mean_y() const { return y_ / weight_; }
    double spread() const { return xx_ / weight_ - mean_x().squaredNorm(); }  // mean squared distance of the x from their mean

    // The best motion. Without a rotation if the x are too near each other to show one.
    Rigid fit() const;

    // The mean squared distance between the y and their images.
    double error(Rigid const&) const;

private:
    double dot() const { return dot_ / weight_ - mean_x().dot(mean_y()); }
    double cross() const;

    double weight_ = 0;
    Vector x_ = Vector::Zero();
    Vector y_ = Vector::Zero();
    double xx_ = 0;
    double yy_ = 0;
    double dot_ = 0;
    double cross_ = 0;
};

}  // namespace rois::choosing
