// What a stiffness in two or three directions gives way to.
#pragma once

#include <Eigen/Core>

namespace stillpoint {

/// The inverse of a stiffness [m/N], 0 along directions in which there is none.
template <int N>
Eigen::Matrix<double, N, N> flexibility(const Eigen::Matrix<double, N, N>& stiffness);

/// A step S⁻¹ out that goes downhill where the stiffness is that of an unstable place: with the sizes of its
/// eigenvalues, and where it has none with a share of the largest.
template <int N>
Eigen::Vector<double, N> step_downhill(const Eigen::Matrix<double, N, N>& stiffness,
                                       const Eigen::Vector<double, N>& out);

}  // namespace stillpoint
