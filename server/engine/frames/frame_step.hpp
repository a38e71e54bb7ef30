// Converts a position, with its uncertainty, between a frame and the frame that it is placed in. Used by Frames.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "engine/frames/frames.hpp"

namespace rois {

using Covariance6 = Eigen::Matrix<double, 6, 6>;  // rows and columns: x, y, z in mm; roll, pitch, yaw in degrees

// A position and an orientation in a frame.
struct PoseInFrame {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  // mm
    Eigen::Vector3d turned = Eigen::Vector3d::Zero();    // roll, pitch, yaw in degrees; 0 without an orientation
    std::optional<Covariance6> covariance;               // absent: unknown
};

// The position of a frame in its base frame.
struct Placement {
    Eigen::Vector3d origin;
    Eigen::Vector3d turned;
    Covariance6 covariance;

    // Throws std::invalid_argument if the numbers of the frame are invalid.
    static Placement of(Frame const&);
};

// Converts from the placed frame to its base, and back.
PoseInFrame to_base(PoseInFrame const&, Placement const&);
PoseInFrame from_base(PoseInFrame const&, Placement const&);

// Returns the angle in (-180, 180] degrees.
double normal_angle(double degrees);

// Whether the matrix is symmetric, or positive semi-definite, within the precision of the arithmetic.
bool is_symmetric(Eigen::MatrixXd const&);
bool is_positive(Eigen::MatrixXd const&);

// Rounds to a thousandth. If rounding makes the matrix lose positive semi-definiteness, raises the variances.
Eigen::MatrixXd rounded_covariance(Eigen::MatrixXd const&);

}  // namespace rois
