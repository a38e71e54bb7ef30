#include "engine/frames/frame_step.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "types/text/texts.hpp"

namespace rois {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double degree = std::numbers::pi / 180;

// Below this cosine of the pitch, roll and yaw turn about the same axis.
constexpr double least_cosine = 1e-6;

Vector3d radians(Vector3d const& turned) { return turned * degree; }

Matrix3d rotation(Vector3d const& turned) {
    Vector3d const angle = radians(turned);
    return (Eigen::AngleAxisd{angle.z(), Vector3d::UnitZ()} * Eigen::AngleAxisd{angle.y(), Vector3d::UnitY()} *
            Eigen::AngleAxisd{angle.x(), Vector3d::UnitX()})
        .toRotationMatrix();
}

// Roll, pitch and yaw of a rotation. At a pitch of 90 degrees roll is 0.
Vector3d turned_by(Matrix3d const& r) {
    double const level = std::hypot(r(0, 0), r(1, 0));
    Vector3d angle{0, std::atan2(-r(2, 0), level), 0};
    if (level < least_cosine) {
        angle.z() = std::atan2(-r(0, 1), r(1, 1));
    } else {
        angle.x() = std::atan2(r(2, 1), r(2, 2));
        angle.z() = std::atan2(r(1, 0), r(0, 0));
    }
    return angle / degree;
}

bool is_level(Vector3d const& turned) { return turned.x() == 0 && turned.y() == 0; }

// The rotation, about the axes of the outer frame, that a small change of roll, pitch and yaw causes.
Matrix3d turn_of_change(Vector3d const& turned) {
    Vector3d const angle = radians(turned);
    double const cp = std::cos(angle.y()), sp = std::sin(angle.y()), cy = std::cos(angle.z()), sy = std::sin(angle.z());
    Matrix3d turn;
    turn << cy * cp, -sy, 0, sy * cp, cy, 0, -sp, 0, 1;
    return turn;
}

// The inverse: the change of roll, pitch and yaw that a small rotation about the axes causes.
Matrix3d change_of_turn(Vector3d const& turned) {
    Vector3d const angle = radians(turned);
    double const cp = std::cos(angle.y()), sp = std::sin(angle.y()), cy = std::cos(angle.z()), sy = std::sin(angle.z());
    Matrix3d change;
    if (std::abs(cp) < least_cosine) {
        change << 0, 0, 0, -sy, cy, 0, 0, 0, 1;
    } else {
        change << cy / cp, sy / cp, 0, -sy, cy, 0, cy * sp / cp, sy * sp / cp, 1;
    }
    return change;
}

Matrix3d cross_product(Vector3d const& a) {
    Matrix3d with;
    with << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
    return with;
}

// The covariance of the result, to the first order: J C J^T for the position, and for the placement.
Covariance6 carried(Covariance6 const& covariance, Covariance6 const& jacobian, Covariance6 const& placed,
                    Covariance6 const& placed_jacobian) {
    Covariance6 const sum = jacobian * covariance * jacobian.transpose() + placed_jacobian * placed * placed_jacobian.transpose();
    return (sum + sum.transpose()) / 2;
}

Vector3d vector_of(std::array<double, 3> const& numbers) { return {numbers[0], numbers[1], numbers[2]}; }

bool is_finite(std::vector<double> const& numbers) {
    return std::ranges::all_of(numbers, [](double number) { return std::isfinite(number); });
}

[[noreturn]] void refuse(Frame const& frame, std::string const& why) {
    throw std::invalid_argument("the frame " + quoted(frame.crs, 200) + ": " + why);
}

Covariance6 covariance_of(Frame const& frame) {
    Covariance6 whole = Covariance6::Zero();
    if (frame.covariance.empty()) return whole;
    auto const size = frame.covariance.size() == 9 ? 3 : 6;
    if (frame.covariance.size() != 9 && frame.covariance.size() != 36)
        refuse(frame, "the covariance of its placement has " + std::to_string(frame.covariance.size()) +
                          " numbers; expected are 9 (x, y, yaw) or 36 (x, y, z, roll, pitch, yaw)");
    if (!is_finite(frame.covariance)) refuse(frame, "the covariance of its placement is not finite");
    Eigen::MatrixXd const given = Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> const>{
        frame.covariance.data(), size, size};
    if (!is_symmetric(given)) refuse(frame, "the covariance of its placement is not symmetric");
    if (!is_positive(given)) refuse(frame, "the covariance of its placement is not positive semi-definite");
    if (size == 6) {
        whole = given;
    } else {
        constexpr std::array<Eigen::Index, 3> at{0, 1, 5};
        whole(at, at) = given;
    }
    return (whole + whole.transpose()) / 2;
}

Eigen::VectorXd eigenvalues(Eigen::MatrixXd const& symmetric) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>{symmetric, Eigen::EigenvaluesOnly}.eigenvalues();
}

}  // namespace

Placement Placement::of(Frame const& frame) {
    if (!vector_of(frame.position).allFinite() || !vector_of(frame.orientation).allFinite())
        refuse(frame, "its position or orientation is not finite");
    return {vector_of(frame.position), vector_of(frame.orientation), covariance_of(frame)};
}

PoseInFrame to_base(PoseInFrame const& pose, Placement const& placed) {
    Matrix3d const turn = rotation(placed.turned);
    Vector3d const arm = turn * pose.position;
    bool const level = is_level(placed.turned);
    PoseInFrame there;
    there.position = placed.origin + arm;
    there.turned = level ? pose.turned + placed.turned : turned_by(turn * rotation(pose.turned));
    if (!pose.covariance) return there;
    Matrix3d const change = change_of_turn(there.turned), of_placement = turn_of_change(placed.turned);
    Covariance6 by_pose = Covariance6::Zero(), by_placement = Covariance6::Identity();
    by_pose.topLeftCorner<3, 3>() = turn;
    by_pose.bottomRightCorner<3, 3>() = level ? Matrix3d::Identity() : Matrix3d{change * turn * turn_of_change(pose.turned)};
    by_placement.topRightCorner<3, 3>() = -cross_product(arm) * of_placement * degree;
    by_placement.bottomRightCorner<3, 3>() = change * of_placement;
    there.covariance = carried(*pose.covariance, by_pose, placed.covariance, by_placement);
    return there;
}

PoseInFrame from_base(PoseInFrame const& pose, Placement const& placed) {
    Matrix3d const back = rotation(placed.turned).transpose();
    Vector3d const arm = pose.position - placed.origin;
    bool const level = is_level(placed.turned);
    PoseInFrame there;
    there.position = back * arm;
    there.turned = level ? pose.turned - placed.turned : turned_by(back * rotation(pose.turned));
    if (!pose.covariance) return there;
    Matrix3d const change = change_of_turn(there.turned), of_placement = turn_of_change(placed.turned);
    Covariance6 by_pose = Covariance6::Zero(), by_placement = Covariance6::Zero();
    by_pose.topLeftCorner<3, 3>() = back;
    by_pose.bottomRightCorner<3, 3>() = level ? Matrix3d::Identity() : Matrix3d{change * back * turn_of_change(pose.turned)};
    by_placement.topLeftCorner<3, 3>() = -back;
    by_placement.topRightCorner<3, 3>() = back * cross_product(arm) * of_placement * degree;
    by_placement.bottomRightCorner<3, 3>() = -change * back * of_placement;
    there.covariance = carried(*pose.covariance, by_pose, placed.covariance, by_placement);
    return there;
}

double normal_angle(double degrees) {
    double const angle = std::remainder(degrees, 360.0);
    return angle <= -180 ? 180 : angle;
}

bool is_symmetric(Eigen::MatrixXd const& matrix) {
    double const most = matrix.cwiseAbs().maxCoeff();
    return (matrix - matrix.transpose()).cwiseAbs().maxCoeff() <= 1e-6 * most;
}

bool is_positive(Eigen::MatrixXd const& matrix) {
    return eigenvalues((matrix + matrix.transpose()) / 2).minCoeff() >= -1e-9 * matrix.cwiseAbs().maxCoeff();
}

Eigen::MatrixXd rounded_covariance(Eigen::MatrixXd const& matrix) {
    Eigen::MatrixXd rounded = matrix.unaryExpr([](double x) { return std::round(x * 1000.0) / 1000.0 + 0.0; });
    double const least = eigenvalues(rounded).minCoeff();
    double const bearable = 1e-9 * rounded.cwiseAbs().maxCoeff();
    if (least < -bearable)
        for (double& variance : rounded.diagonal())
            variance = std::round(variance * 1000.0 + std::ceil(-least * 1000.0)) / 1000.0;
    return rounded;
}

}  // namespace rois
