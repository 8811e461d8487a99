#include "geometry/rigid_placement.hpp"

#include <cmath>

#include <Eigen/Dense>

namespace stillpoint {
namespace {

/// The matrix of w ×.
Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& w) {
  Eigen::Matrix3d matrix;
  matrix << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
  return matrix;
}

/// (θ − sin θ)/θ³, by its series where the difference would lose digits.
double third_order_share(double theta) {
  const double square = theta * theta;
  if (square < 0.01) return (1 - square / 20 * (1 - square / 42 * (1 - square / 72))) / 6;
  return (theta - std::sin(theta)) / (theta * square);
}

}  // namespace

template <>
Eigen::Matrix2d rotation<2>(const Turning<2>& theta) {
  return Eigen::Rotation2Dd(theta[0]).toRotationMatrix();
}

template <>
Eigen::Matrix3d rotation<3>(const Turning<3>& theta) {
  if (theta.isZero(0)) return Eigen::Matrix3d::Identity();
  return Eigen::AngleAxisd(theta.norm(), theta.normalized()).toRotationMatrix();
}

template <>
Eigen::Matrix2d spin<2>(const Turning<2>& /*theta*/, const Turning<2>& dtheta_dt) {
  Eigen::Matrix2d Omega;
  Omega << 0, -dtheta_dt[0], dtheta_dt[0], 0;
  return Omega;
}

template <>
Eigen::Matrix3d spin<3>(const Turning<3>& theta, const Turning<3>& dtheta_dt) {
  const double angle = theta.norm(), half_sine = std::sin(angle / 2);
  const double second_order_share = angle > 0 ? 2 * half_sine * half_sine / (angle * angle) : 0.5;
  const Eigen::Vector3d across = theta.cross(dtheta_dt);
  return cross_matrix(dtheta_dt + second_order_share * across + third_order_share(angle) * theta.cross(across));
}

}  // namespace stillpoint
