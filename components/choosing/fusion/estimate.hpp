// Positions and velocities with their uncertainty, and how two of them are combined.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace rois::choosing {

using Vector = Eigen::Vector2d;
using Matrix = Eigen::Matrix2d;

// A value with its covariance.
struct Gaussian {
    Vector mean = Vector::Zero();
    Matrix covariance = Matrix::Identity();
};

// What is not fused, only passed through: of the latest measurement.
struct Details {
    double z = 0;  // metres
    struct Heading {
        double degrees = 0;
        double variance = 0;
    };
    std::optional<Heading> heading{};
};

// The position of a person in metres, and the velocity in metres per second.
struct Estimate {
    Gaussian position;
    Gaussian velocity;
};

// Whether a matrix is finite, symmetric and positive definite.
bool is_covariance(Matrix const&);

// Returns the length of a difference in standard deviations (the Mahalanobis distance).
double deviations(Vector const& difference, Matrix const& covariance);

// Returns the distance of two values in standard deviations of both together.
double deviations_apart(Gaussian const& a, Gaussian const& b);

// Combines two values of the same thing whose errors may be correlated in an unknown way (covariance intersection). If both
// covariances are honest, so is the result. The weights are in proportion to the inverse of the squared variance: the weight with
// the smallest covariance would take nearly all from a value that is a little more certain, and lose what the other one adds.
// `share`: the weight of `a`, 0 to 1, if both are equally certain.
Gaussian covariance_intersection(Gaussian const& a, Gaussian const& b, double share = 0.5);

}  // namespace rois::choosing
