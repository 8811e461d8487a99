// A free rigid body: without inertia it is where its load and what it touches balance.
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "geometry/rigid_placement.hpp"
#include "space/boundary/small_stiffness.hpp"

namespace stillpoint {

/// What a rigid body at some place bears, and how that would change.
template <int N>
struct Balance {
  using Position = Eigen::Vector<double, N>;

  Position load = Position::Zero(), force = Position::Zero();                   // W, Σ f [N]
  Eigen::Matrix<double, N, N> stiffness = Eigen::Matrix<double, N, N>::Zero();  // Σ A S [N/m]

  Position out() const { return load - force; }
  bool holds() const { return is_within(1e-13); }  // rounding
  bool is_near() const { return is_within(1e-6); }

 private:
  bool is_within(double share) const { return out().norm() <= share * std::max(load.norm(), force.norm()); }
};

/// The lengths by which a body settles [m].
struct SettlingLengths {
  double longest;   // of a step
  double rounding;  // a step that is none
  double touching;  // that it goes into what it meets
  double furthest;  // of a way through empty space
};

/// Newton's method downhill in the potential, whose slope Σ f − W is piecewise linear but for the turn of n. As long as
/// nothing resists the body goes the way of its load, as far as certainly nothing is in the way; a round one that
/// touches a single piece rolls off it until a second one bears it as well. balance(): where the placement is now;
/// way_to_touch(): no more than the way to what is nearest, infinite if nothing is there.
template <int N, class BalanceAt, class WayToTouch>
void settle(RigidPlacement<N>& placement, const SettlingLengths& lengths, const BalanceAt& balance,
            const WayToTouch& way_to_touch) {
  constexpr int most = 60, most_halvings = 12;
  constexpr double overshoot = 0.5;  // as a share of the slope along a step
  Balance<N> now = balance();
  for (int k = 0; k < most && !now.holds(); ++k) {
    const Eigen::Vector<double, N> out = now.out(), before = placement.u;
    if (now.stiffness.isZero(0)) {
      const double way = way_to_touch();
      if (!std::isfinite(way)) return;  // nothing to touch
      placement.u += (std::min(way, lengths.furthest) + lengths.touching) / out.norm() * out;
      now = balance();
      continue;
    }
    Eigen::Vector<double, N> step = step_downhill<N>(now.stiffness, out);
    const double length = step.norm();
    if (length <= lengths.rounding) return;
    if (length > lengths.longest) step *= lengths.longest / length;
    for (int halving = 0;; ++halving, step /= 2) {
      placement.u = before + step;
      now = balance();
      if (now.out().dot(step) >= -overshoot * out.dot(step)) break;
      if (halving == most_halvings) return;  // no nearer than by rounding
    }
  }
}

}  // namespace stillpoint
