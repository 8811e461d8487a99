// Solids bounded by quadrics: spheres and cylinders, solid or hollow.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "geometry/solid.hpp"

namespace stillpoint {

/// The matrix q of the quadric [x; 1]ᵀ q [x; 1] in N variables, q symmetric.
template <int N>
using Quadric = Eigen::Matrix<double, N + 1, N + 1>;

/// The set of points at which all of several quadrics are ≤ 0.
///
/// A rule integrates along x between roots, the results along y, and those along z:
///
///   ∫ q dV = ∫ ∫ Σ_intervals ∫ q dx dy dz.
///
/// An inner integral has a kink, or a root's singularity, where an interval ends at a face of the box, begins, or ends
/// at another surface: there one of three functions vanishes, a quadric with x on that face, its discriminant in x, or
/// the quadric with x from a plane. All of these are quadrics of one variable less, whose roots divide the next
/// integral; its parts have Gauss-Legendre points in s with t = s² (3 − 2 s), which makes √t and √(1 − t) smooth [Saye
/// 2015 proceeds likewise for other level sets].
class QuadricSolid final : public Solid {
 public:
  /// inner: the radius of the hollow; 0 if there is none.
  static QuadricSolid sphere(const SpacePoint& centre, double radius, double inner);
  /// from, to: the centres of the two end circles, which have to differ.
  static QuadricSolid cylinder(const SpacePoint& from, const SpacePoint& to, double radius, double inner);

  SpaceBox bounds() const override { return bounds_; }
  bool contains(const SpacePoint& x) const override;
  Part part_of(const SpaceBox& box) const override;
  SpaceRule rule(const SpaceBox& box, int degree) const override;

 private:
  QuadricSolid(const SpacePoint& origin, const SpaceBox& bounds) : origin_(origin), bounds_(bounds) {}
  Eigen::Vector3d seen_from_origin(const SpacePoint& x) const;

  SpacePoint origin_;                 // origin of the quadrics' coordinates
  std::vector<Quadric<3>> quadrics_;  // each ≤ 0 inside
  SpaceBox bounds_;
};

}  // namespace stillpoint
