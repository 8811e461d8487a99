#include "space/boundary/small_stiffness.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace stillpoint {
namespace {

constexpr double none = 1e-9;  // of the largest eigenvalue

template <int N>
using ModesOf = Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, N, N>>;

}  // namespace

template <int N>
Eigen::Matrix<double, N, N> flexibility(const Eigen::Matrix<double, N, N>& stiffness) {
  const ModesOf<N> modes(0.5 * (stiffness + stiffness.transpose()));
  Eigen::Vector<double, N> values = modes.eigenvalues();
  const double largest = values.cwiseAbs().maxCoeff();
  if (values.cwiseAbs().minCoeff() > none * largest) return stiffness.inverse();
  for (double& value : values) value = std::abs(value) > none * largest ? 1 / value : 0;
  return modes.eigenvectors() * values.asDiagonal() * modes.eigenvectors().transpose();
}

template <int N>
Eigen::Vector<double, N> step_downhill(const Eigen::Matrix<double, N, N>& stiffness,
                                       const Eigen::Vector<double, N>& out) {
  constexpr double share = 1e-2;
  const ModesOf<N> modes(0.5 * (stiffness + stiffness.transpose()));
  Eigen::Vector<double, N> sizes = modes.eigenvalues().cwiseAbs();
  const double largest = sizes.maxCoeff();
  if (modes.eigenvalues().minCoeff() > none * largest) return stiffness.inverse() * out;
  for (double& size : sizes)
    if (!(size > none * largest)) size = share * largest;
  return modes.eigenvectors() * (modes.eigenvectors().transpose() * out).cwiseQuotient(sizes);
}

template Eigen::Matrix2d flexibility<2>(const Eigen::Matrix2d&);
template Eigen::Matrix3d flexibility<3>(const Eigen::Matrix3d&);
template Eigen::Vector2d step_downhill<2>(const Eigen::Matrix2d&, const Eigen::Vector2d&);
template Eigen::Vector3d step_downhill<3>(const Eigen::Matrix3d&, const Eigen::Vector3d&);

}  // namespace stillpoint
