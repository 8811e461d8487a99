// The affine velocity field about a material point that APIC stores beside its velocity, B_p = Σ_i N_ip v_i ⊗ (x_i −
// x_p) [Jiang et al. 2015].
//
// It is transferred to the grid by weights w_ip with Σ_i w_ip = 0 and Σ_i x_i ⊗ w_ip = I, so that momentum and angular
// momentum Σ_p m_p x_p × v_p + m_p (B_p,yx − B_p,xy) are conserved: w_ip = N_ip (x_i − x_p)/D_p, D_p = Σ_i N_ip (x_i −
// x_p)², which is ∇N_ip for a linear basis. There D_p vanishes at a grid line, and the B_p of a point that came near
// one would grow by the ratio of the two D_p without bound: points of a linear basis store the velocity gradient
// B_p/D_p in its place, and angular momentum is conserved approximately.
#pragma once

#include <algorithm>
#include <array>

#include "space/kernels/point_weights.hpp"
#include "space/materials/deformation.hpp"

namespace stillpoint {

template <AxisBasis B, Kinematics K>
struct AffineVelocity {
  using Weights = PointWeights<B, K>;
  static constexpr int dim = Weights::dim;
  static constexpr int per_cell = Weights::per_cell;
  static constexpr bool carries_gradient = B::degree == 1 && B::window == 1;
  using Points = MaterialPoints<dim>;
  using Basis = typename Weights::Basis;
  using Centres = std::array<std::array<double, per_cell>, dim>;         // x_a of a cell's functions
  using WeightsOfPoint = std::array<std::array<double, per_cell>, dim>;  // w_a
  using Gradient = std::array<double, dim * dim>;                        // ∂v_i/∂x_j at [dim i + j]

  /// The contribution of a point to function a beside N_a v_p: Σ_j A_ij w_ja.
  struct MotionAbout {
    Gradient A;
    WeightsOfPoint w;
  };

  static Centres centres(const Grid<dim>& grid, int cell_number) {
    Centres of_cell{};
    if constexpr (B::partition_of_unity) {
      const auto cell = grid.cell_at(cell_number);
      for (int d = 0; d < dim; ++d) {
        const Axis& axis = grid.axes[d];
        for (int a = 0; a < per_cell; ++a) of_cell[d][a] = B::centre(axis, B::first(cell[d]) + Basis::axis_index(a, d));
      }
    }
    return of_cell;
  }

  // D_j = Σ_a N_a (x_a − x_p)_j²
  static Point<dim> second_moments(const auto& N, const Centres& centre, const Point<dim>& x) {
    Point<dim> D{};
    for (int j = 0; j < dim; ++j) {
      for (int a = 0; a < per_cell; ++a) D[j] += N[a] * (centre[j][a] - x[j]) * (centre[j][a] - x[j]);
    }
    return D;
  }

  static WeightsOfPoint weights_of_B(const Weights& weights, const Centres& centre, const Point<dim>& x, std::size_t k,
                                     std::size_t p) {
    constexpr double singular = 1e-6;  // share of the squared distances; D is 0 if only one function acts, at a
                                       // boundary
    const auto N = weights.N(k, p);
    const auto dN = weights.dN(k, p);
    const Point<dim> D = second_moments(N, centre, x);
    WeightsOfPoint w;
    for (int j = 0; j < dim; ++j) {
      double scale = 0;
      for (int a = 0; a < per_cell; ++a) scale = std::max(scale, (centre[j][a] - x[j]) * (centre[j][a] - x[j]));
      const bool by_gradient = B::degree == 1 || D[j] < singular * scale;
      for (int a = 0; a < per_cell; ++a) {
        w[j][a] = by_gradient ? dN[per_cell * j + a] : N[a] * (centre[j][a] - x[j]) / D[j];
      }
    }
    if constexpr (B::window > 1 && dim == 2) set_by_full_moments(N, centre, x, w);
    return w;
  }
  // The mean of N over a domain is no product of functions of x and y, so D_ij has mixed terms: w = D⁻¹ N (x_a − x_p).
  static void set_by_full_moments(const double* N, const Centres& centre, const Point<dim>& x, WeightsOfPoint& w) {
    double D_xx = 0, D_xy = 0, D_yy = 0;
    for (int a = 0; a < per_cell; ++a) {
      const double r_x = centre[0][a] - x[0], r_y = centre[1][a] - x[1];
      D_xx += N[a] * r_x * r_x;
      D_xy += N[a] * r_x * r_y;
      D_yy += N[a] * r_y * r_y;
    }
    const double det = D_xx * D_yy - D_xy * D_xy;
    if (!(det > 1e-12 * (D_xx + D_yy) * (D_xx + D_yy))) return;
    for (int a = 0; a < per_cell; ++a) {
      const double r_x = centre[0][a] - x[0], r_y = centre[1][a] - x[1];
      w[0][a] = N[a] * (D_yy * r_x - D_xy * r_y) / det;
      w[1][a] = N[a] * (D_xx * r_y - D_xy * r_x) / det;
    }
  }

  // Σ_a v_a ⊗ ∇N_a
  static Gradient velocity_gradient(const Weights& weights, const double* v, std::size_t k, std::size_t p) {
    const auto full = weights.gradient(v, k, p);
    Gradient in_plane{};
    std::copy_n(full.begin(), in_plane.size(), in_plane.begin());
    return in_plane;
  }
  // H (I + G)⁻¹
  static Gradient times_inverse(const Gradient& H, Gradient G) {
    for (int i = 0; i < dim; ++i) G[dim * i + i] += 1;
    constexpr Kinematics without_hoop = dim == 1 ? Kinematics::line : dim == 2 ? Kinematics::plane : Kinematics::space;
    return product<without_hoop>(H, inverse<without_hoop>(G));
  }
  static Gradient B_of(const Points& points, std::size_t p) {
    Gradient B_p{};
    for (int ij = 0; ij < dim * dim; ++ij) B_p[ij] = points.B_apic[ij][p];
    return B_p;
  }
  // N_ip (x_i − x_p)
  static WeightsOfPoint distances_weighed(const auto& N, const Centres& centre, const Point<dim>& x) {
    WeightsOfPoint w;
    for (int j = 0; j < dim; ++j) {
      for (int a = 0; a < per_cell; ++a) w[j][a] = N[a] * (centre[j][a] - x[j]);
    }
    return w;
  }

  // B_p = Σ_a N_a v_a ⊗ (x_a + u_a − x_p − u_p), or the gradient ∂v/∂(x + u)
  static void set(Points& points, const Weights& weights, const Centres& centre, std::size_t k, std::size_t p,
                  const double* u, const double* v) {
    if constexpr (carries_gradient) {
      const Gradient C = times_inverse(velocity_gradient(weights, v, k, p), velocity_gradient(weights, u, k, p));
      for (int ij = 0; ij < dim * dim; ++ij) points.B_apic[ij][p] = C[ij];
    } else {
      const auto u_p = weights.value(u, k, p);
      const auto N = weights.N(k, p);
      const Point<dim> x = points.position(p);
      Gradient B_p{};
      for (int a = 0; a < per_cell; ++a) {
        const int f = dim * weights.function(k, a);
        for (int i = 0; i < dim; ++i) {
          for (int j = 0; j < dim; ++j) {
            B_p[dim * i + j] += N[a] * v[f + i] * (centre[j][a] + u[f + j] - x[j] - u_p[j]);
          }
        }
      }
      for (int ij = 0; ij < dim * dim; ++ij) points.B_apic[ij][p] = B_p[ij];
    }
  }
};

}  // namespace stillpoint
