// One step between two frames, one of which is placed in the other: where something is, and how certain that is, told in the
// other frame. The inside of Frames.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "engine/frames.hpp"

namespace rois {

using Covariance6 = Eigen::Matrix<double, 6, 6>;  // of x, y, z in mm and roll, pitch, yaw in degrees

// Where something is, in the frame that is spoken of.
struct Whereat {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // mm
    Eigen::Vector3d turned = Eigen::Vector3d::Zero();    // roll, pitch, yaw in degrees; 0 for what has no orientation
    std::optional<Covariance6> covariance;               // absent: nothing is known of it
};

// A frame as it is placed in its base, made ready.
struct Placement {
    Eigen::Vector3d origin;
    Eigen::Vector3d turned;
    Covariance6 covariance;

    // Throws std::invalid_argument when the frame's numbers are no placement.
    static Placement of(Frame const&);
};

// From the placed frame to its base, and back.
Whereat to_base(Whereat const&, Placement const&);
Whereat from_base(Whereat const&, Placement const&);

// Degrees in (-180, 180].
double normal_angle(double degrees);

// Whether it can be a covariance, but for the errors of arithmetic.
bool is_symmetric(Eigen::MatrixXd const&);
bool is_positive(Eigen::MatrixXd const&);

// Rounded to a thousandth, and positive semi-definite nonetheless: where rounding took that away, the variances are raised.
Eigen::MatrixXd rounded_covariance(Eigen::MatrixXd const&);

}  // namespace rois
