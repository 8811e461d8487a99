// Solids between quadrics: spheres and cylinders, solid or hollow.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "base/solid.hpp"

namespace stillpoint {

/// [x; 1]ᵀ q [x; 1] of N variables, q symmetric.
template <int N>
using Quadric = Eigen::Matrix<double, N + 1, N + 1>;

/// Where several quadrics are ≤ 0.
///
/// A rule integrates along x between roots, these along y, and that along z:
///
///   ∫ q dV = ∫ ∫ Σ_intervals ∫ q dx dy dz.
///
/// An inner integral has a kink, or a root's singularity, where an interval ends at a face of the box, begins, or ends
/// at another surface: where a quadric with x on that face, its discriminant in x, or the quadric with x from a plane
/// vanishes. All of these are quadrics of one variable less, whose roots divide the next integral; its parts have
/// Gauss-Legendre points in s with t = s² (3 − 2 s), which makes √t and √(1 − t) smooth [Saye 2015 goes the same way
/// for other level sets].
class QuadricSolid final : public Solid {
 public:
  /// inner: the radius of the hollow; 0: none.
  static QuadricSolid sphere(const SpacePoint& centre, double radius, double inner);
  /// Between two different ends, the centres of its circles.
  static QuadricSolid cylinder(const SpacePoint& from, const SpacePoint& to, double radius, double inner);

  SpaceBox bounds() const override { return bounds_; }
  bool contains(const SpacePoint& x) const override;
  Part part_of(const SpaceBox& box) const override;
  SpaceRule rule(const SpaceBox& box, int degree) const override;

 private:
  QuadricSolid(const SpacePoint& origin, const SpaceBox& bounds) : origin_(origin), bounds_(bounds) {}
  Eigen::Vector3d seen_from_origin(const SpacePoint& x) const;

  SpacePoint origin_;                 // of the quadrics' coordinates
  std::vector<Quadric<3>> quadrics_;  // ≤ 0 inside
  SpaceBox bounds_;
};

}  // namespace stillpoint
