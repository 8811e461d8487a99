// Where a rigid body is at one time, and how fast its points move.
#pragma once

#include "geometry/rigid_shape.hpp"

namespace stillpoint {

/// The angle in the plane, counter-clockwise, or the rotation vector θ in space: by |θ| about the axis along θ [rad].
template <int N>
using Turning = Eigen::Vector<double, N == 2 ? 1 : 3>;

/// A body turned about the position a and moved by u. Its point that was at X is at
///
///   x = a + u + Q (X − a)   and has the velocity   v = du/dt + Ω (x − a − u),   Ω = dQ/dt Qᵀ.
template <int N>
struct RigidPlacement {
  using Position = Eigen::Vector<double, N>;
  using Matrix = Eigen::Matrix<double, N, N>;

  Position a = Position::Zero(), u = Position::Zero();  // [m]
  Matrix Q = Matrix::Identity();
  Position du_dt = Position::Zero();  // [m/s]
  Matrix Omega = Matrix::Zero();      // [1/s]

  /// The X of the body's point that is at x.
  Position to_body(const Position& x) const { return a + Q.transpose() * (x - a - u); }
  /// The x of the body's point that was at X.
  Position to_space(const Position& X) const { return a + u + Q * (X - a); }
  /// The velocity of the body's point that is at x.
  Position velocity(const Position& x) const { return du_dt + Omega * (x - a - u); }

  /// φ(X(x)) with its derivatives by x, Q ∇φ and Q ∇∇φ Qᵀ, for a shape as it was.
  Nearest<N> nearest(const RigidShape<N>& shape, const Position& x) const {
    const Nearest<N> in_body = shape.nearest(to_body(x));
    return {in_body.distance, Q * in_body.normal, Q * in_body.hessian * Q.transpose()};
  }
};

/// In the plane, and in space with c the axis along θ and [c] the matrix of c × (Rodrigues),
///
///   Q = (cos θ, −sin θ; sin θ, cos θ),   Q = I + sin |θ| [c] + (1 − cos |θ|) [c]².
template <int N>
Eigen::Matrix<double, N, N> rotation(const Turning<N>& theta);

/// Ω = dQ/dt Qᵀ at θ and dθ/dt: in the plane (0, −1; 1, 0) dθ/dt, and in space [ω] with
///
///   ω = dθ/dt + (1 − cos |θ|)/|θ|² θ × dθ/dt + (|θ| − sin |θ|)/|θ|³ θ × (θ × dθ/dt).
template <int N>
Eigen::Matrix<double, N, N> spin(const Turning<N>& theta, const Turning<N>& dtheta_dt);

}  // namespace stillpoint
