// The contract of rigid shapes: the signed distance φ of a closed set, negative inside, with its derivatives.
#pragma once

#include <limits>
#include <memory>

#include <Eigen/Core>

namespace stillpoint {

/// φ and its derivatives at a position x. They belong to the position of the surface that is nearest to x; on the
/// medial axis, where several are equally near, to one of them.
template <int N>
struct Nearest {
  double distance;                      // φ [m]
  Eigen::Vector<double, N> normal;      // ∇φ, the unit normal out of the shape
  Eigen::Matrix<double, N, N> hessian;  // ∇∇φ [1/m]; its eigenvalues are 0 along n and 1/(φ + R) for a radius R
};

/// A closed set in the plane (N = 2) or in space (N = 3). In the half plane (r, z) of an axisymmetric scene a shape
/// that reaches the axis includes its mirror image at r < 0, so that the axis is not a part of its surface.
template <int N>
class RigidShape {
 public:
  using Position = Eigen::Vector<double, N>;
  using Matrix = Eigen::Matrix<double, N, N>;

  virtual ~RigidShape() = default;
  virtual Nearest<N> nearest(const Position& x) const = 0;
};
template <int N>
using RigidShapePtr = std::shared_ptr<const RigidShape<N>>;

/// The length below which a difference of coordinates of this size is nothing but rounding.
inline double rounding_of(double largest_coordinate) {
  return 16 * std::numeric_limits<double>::epsilon() * largest_coordinate;
}

/// The nearest position y is in a flat part of the surface.
template <int N>
Nearest<N> nearest_on_face(double distance, const Eigen::Vector<double, N>& normal) {
  return {distance, normal, Eigen::Matrix<double, N, N>::Zero()};
}

/// The nearest position y is on a corner or an edge. With T the projector onto the tangents, 0 for a corner and a aᵀ
/// for an edge along a,
///
///   φ = ±|x − y|,   n = (x − y)/φ,   ∂n/∂x = (I − T − n nᵀ)/φ.
///
/// offset: x − y. If that is only rounding, n is normal_there, and ∂n/∂x, which has no limit, is 0.
template <int N>
Nearest<N> nearest_on_feature(const Eigen::Vector<double, N>& offset, const Eigen::Matrix<double, N, N>& T, bool inside,
                              const Eigen::Vector<double, N>& normal_there, double rounding) {
  const double distance = inside ? -offset.norm() : offset.norm();
  if (offset.norm() <= rounding) return nearest_on_face<N>(distance, normal_there);
  const Eigen::Vector<double, N> n = offset / distance;
  return {distance, n, (Eigen::Matrix<double, N, N>::Identity() - T - n * n.transpose()) / distance};
}

/// The same for the shape grown by a radius: φ − radius. For a convex shape this is exact inside as well.
template <int N>
Nearest<N> grown(Nearest<N> nearest, double radius) {
  nearest.distance -= radius;
  return nearest;
}

}  // namespace stillpoint
