#include "choosing/fusion/estimate.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace rois::choosing {
namespace {

// How strongly covariance_intersection prefers `share`. With 0.5, a value whose standard deviation is half of the other's gets
// the whole weight.
constexpr double preference = 0.5;

// Returns the weight w in [0, 1] that maximizes det(w a + (1 - w) b) - penalty, for two inverse covariances. The determinant is a
// quadratic function of w, and so is the penalty: preference * (det a + det b) * (w - share)^2.
double weight_of(Matrix const& a, Matrix const& b, double share) {
    double const det_a = a.determinant();
    double const det_b = b.determinant();
    double const mixed = a(0, 0) * b(1, 1) + a(1, 1) * b(0, 0) - 2 * a(0, 1) * b(0, 1);
    double const penalty = preference * (det_a + det_b);
    double const square = det_a + det_b - mixed - penalty;          // the coefficient of w^2
    double const linear = mixed - 2 * det_b + 2 * penalty * share;  // the coefficient of w
    if (square < 0) return std::clamp(-linear / (2 * square), 0.0, 1.0);
    return square + linear > 0 ? 1 : 0;
}

}  // namespace

bool is_covariance(Matrix const& m) {
    if (!m.allFinite() || m(0, 0) <= 0 || m(1, 1) <= 0) return false;
    if (std::abs(m(0, 1) - m(1, 0)) > 1e-6 * (m(0, 0) + m(1, 1))) return false;
    return m.determinant() > 1e-9 * m(0, 0) * m(1, 1);
}

double deviations(Vector const& difference, Matrix const& covariance) {
    return std::sqrt(difference.dot(covariance.inverse() * difference));
}

double deviations_apart(Gaussian const& a, Gaussian const& b) { return deviations(a.mean - b.mean, a.covariance + b.covariance); }

Gaussian covariance_intersection(Gaussian const& a, Gaussian const& b, double share) {
    Matrix const of_a = a.covariance.inverse();
    Matrix const of_b = b.covariance.inverse();
    double const weight = weight_of(of_a, of_b, share);
    Gaussian result;
    result.covariance = (weight * of_a + (1 - weight) * of_b).inverse();
    result.mean = result.covariance * (weight * of_a * a.mean + (1 - weight) * of_b * b.mean);
    return result;
}

}  // namespace rois::choosing
