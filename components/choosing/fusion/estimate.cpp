#include "choosing/fusion/estimate.hpp"

#include <Eigen/LU>
#include <cmath>

namespace rois::choosing {

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
    double const for_a = share * std::pow(b.covariance.trace(), 2);
    double const for_b = (1 - share) * std::pow(a.covariance.trace(), 2);
    double const weight = for_a / (for_a + for_b);
    Gaussian result;
    result.covariance = (weight * of_a + (1 - weight) * of_b).inverse();
    result.mean = result.covariance * (weight * of_a * a.mean + (1 - weight) * of_b * b.mean);
    return result;
}

}  // namespace rois::choosing
