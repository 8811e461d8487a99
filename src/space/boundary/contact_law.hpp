// The law of contact at a piece of a border: pressure and shear, and how they change with its position.
//
//   p = max(0, λ − κ g),   τ = clip(λ_t − κ s) to |τ| ≤ c + μ p where p > 0
#pragma once

#include <stillpoint/shear_limit.hpp>

#include <algorithm>
#include <array>

#include "space/boundary/touch_finder.hpp"

namespace stillpoint {

/// What touches at a piece.
template <Kinematics K>
struct ContactTouch : TouchFinder<K>::Near {
  using Position = typename TouchFinder<K>::Position;

  double area, kappa;
  double p;                               // [Pa]
  Position tau = Position::Zero();        // τ, in the scene's axes [Pa]
  Position tau_trial = Position::Zero();  // λ_t − κ s before the limit, likewise
  bool slips = false;
};

/// Adds the shear within its limit; trial: λ_t − κ (X − a), in the scene's axes.
template <Kinematics K>
void add_shear(const ShearLimit& shear, const typename TouchFinder<K>::Position& trial, ContactTouch<K>& touch) {
  const auto& n = touch.at.normal;
  touch.tau_trial = trial - n.dot(trial) * n;
  const double size = touch.tau_trial.norm(), limit = shear.at(touch.p);
  touch.slips = size > limit || touch.p == 0;
  touch.tau = touch.tau_trial;
  if (touch.slips) touch.tau *= limit / std::max(size, limit);
  if (limit == 0) touch.tau.setZero();
}

/// −∂f/∂x of a piece, times A. With the direction d of τ where it slips at its limit,
///
///   ∂τ/∂x = −κ (I − n nᵀ) where it sticks,   −μ κ d nᵀ − κ |τ|/|τ_trial| (I − n nᵀ − d dᵀ) where it slips.
///
/// A round body that presses softens by −p ∇n. Where a motion begins, with pieces that a jump has left deep in it, p is
/// far from that of any balance, and so is this term: frequencies are those without it.
template <Kinematics K>
auto stiffness_of(Tangent kind, const ShearLimit& shear, const ContactTouch<K>& touch) {
  constexpr int N = TouchFinder<K>::N;
  using Matrix = Eigen::Matrix<double, N, N>;
  const auto& n = touch.at.normal;
  Matrix S = touch.kappa * n * n.transpose();
  if (kind == Tangent::consistent) S -= touch.p * touch.at.hessian;
  if (shear.acts()) {
    const Matrix along = Matrix::Identity() - n * n.transpose();
    if (kind != Tangent::consistent || !touch.slips) {
      S += touch.kappa * along;
    } else if (touch.p > 0) {
      const double size = touch.tau_trial.norm();
      const Eigen::Vector<double, N> d = touch.tau_trial / size;
      S += shear.friction * touch.kappa * d * n.transpose() +
           touch.kappa * touch.tau.norm() / size * (along - d * d.transpose());
    }
  }
  return Matrix(touch.area * S);
}

/// Adds arm × f; in the plane its third component alone.
template <int N>
void add_moment(const Eigen::Vector<double, N>& arm, const Eigen::Vector<double, N>& f, std::array<double, 3>& moment) {
  if constexpr (N == 3) {
    const Eigen::Vector3d of_piece = arm.cross(f);
    for (int i = 0; i < 3; ++i) moment[static_cast<std::size_t>(i)] += of_piece[i];
  } else {
    moment[2] += arm[0] * f[1] - arm[1] * f[0];
  }
}

}  // namespace stillpoint
