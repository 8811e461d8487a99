// The domains that material points represent: quadrilaterals, whose corners move with the body.
//
// A domain is initially a point's part of its cell. Functions are evaluated at its corners x_c,
//
//   N̄_ip = 2^-dim Σ_c N_i(x_c),   ∇N̄_ip = Σ_c N_i(x_c) S_c/V_p,   S_c = ∂V_p/∂x_c:
//
// the mean gradient of the interpolation of the corners' values [Sadeghirad, Brannon and Burghardt 2013, CPDI2].
// Adjacent domains share corners, and continue to do so, so that Σ_p V_p ∇N̄_ip telescopes to the surface of the body:
// a uniform stress is in equilibrium with its tractions, wherever the points lie in their cells and the surface cuts
// these. With functions evaluated at the points alone this holds by chance only.
//
// With u_c = Σ_i N_i(x_c) u_i the point moves as the mean of its corners, and the product of the f_p from phase to
// phase is the mean gradient from the first corners to the present ones: the positions of its corners are the body's
// only memory.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "space/points/material_points.hpp"

namespace stillpoint {

/// The cell from which on a domain that begins at `low` has its functions.
inline int first_cell_of_domain(const Axis& axis, double low) {
  constexpr double rounding = 1e-12;
  const double tolerance =
      axis.is_even ? rounding * (axis.max() - axis.min()) / axis.cells() : rounding * axis.scale_at(axis.cell_of(low));
  return axis.cell_of(low + tolerance);
}

/// The largest width of a domain between low and high: the narrowest of the cells that it touches, so that it touches
/// two at most; along an even axis the narrowest of all. A wider one would hardly feel the functions between its
/// corners.
template <int Dim>
double widest_between(const MaterialPoints<Dim>& points, const Axis& axis, int d, double low, double high) {
  constexpr double rounding = 1e-9;
  if (axis.is_even) return points.widest[d];
  const auto line = [&](int k) { return axis.nodes[static_cast<std::size_t>(k)]; };
  int first = axis.cell_of(low), last = axis.cell_of(high);
  if (first < last && line(first + 1) - low <= rounding * axis.scale_at(first)) ++first;
  if (first < last && high - line(last) <= rounding * axis.scale_at(last)) --last;
  double narrowest = axis.scale_at(first);
  for (int c = first + 1; c <= last; ++c) narrowest = std::min(narrowest, axis.scale_at(c));
  return narrowest;
}

template <int Dim>
struct Domain {
  static constexpr int corners = 1 << Dim;

  std::array<Point<Dim>, corners> x;  // corner c is the upper one along axis d if bit d of c is set [m]

  /// The domain in its present shape.
  static Domain of(const MaterialPoints<Dim>& points, std::size_t p) {
    Domain domain;
    for (int c = 0; c < corners; ++c) {
      for (int d = 0; d < Dim; ++d) domain.x[c][d] = points.corner[Dim * c + d][p];
    }
    return domain;
  }
  /// The domain at whose corners functions are evaluated: shrunk where it is too wide (widest_between), and without
  /// corners outside the grid.
  static Domain in_grid(const MaterialPoints<Dim>& points, std::size_t p, const Grid<Dim>& grid) {
    Domain domain = of(points, p);
    for (int d = 0; d < Dim; ++d) {
      double low = domain.x[0][d], high = low;
      for (const auto& corner : domain.x) low = std::min(low, corner[d]), high = std::max(high, corner[d]);
      const double middle = points.x[d][p], most = widest_between(points, grid.axes[d], d, low, high);
      if (high - low > most) {
        for (auto& corner : domain.x) corner[d] = middle + (corner[d] - middle) * (most / (high - low));
      }
      for (auto& corner : domain.x) corner[d] = std::clamp(corner[d], grid.axes[d].min(), grid.axes[d].max());
    }
    return domain;
  }

  /// The deformation since the domain was a box with these half sides r: F_ij = 2^-dim Σ_c ± x_c,i/r_j, (Dim × Dim).
  std::array<double, (Dim * Dim)> deformation(const Point<Dim>& r) const {
    std::array<double, Dim * Dim> F{};
    for (int c = 0; c < corners; ++c) {
      for (int i = 0; i < Dim; ++i) {
        for (int j = 0; j < Dim; ++j) F[Dim * i + j] += (c >> j & 1 ? x[c][i] : -x[c][i]) / (corners * r[j]);
      }
    }
    return F;
  }

  Point<Dim> low() const {
    Point<Dim> least = x[0];
    for (const auto& corner : x) {
      for (int d = 0; d < Dim; ++d) least[d] = std::min(least[d], corner[d]);
    }
    return least;
  }

  /// The volume V for a thickness of 1.
  double size() const {
    if constexpr (Dim == 1) {
      return x[1][0] - x[0][0];
    } else {
      return ((x[3][0] - x[0][0]) * (x[2][1] - x[1][1]) - (x[3][1] - x[0][1]) * (x[2][0] - x[1][0])) / 2;
    }
  }

  /// The gradients S_c/V.
  std::array<Point<Dim>, corners> gradients() const {
    std::array<Point<Dim>, corners> S;
    if constexpr (Dim == 1) {
      const double length = x[1][0] - x[0][0];
      S[0] = {-1 / length};
      S[1] = {1 / length};
    } else {
      // With the diagonals a = x_3 − x_0 and b = x_2 − x_1: V = ½ a × b
      const Point<2> a{x[3][0] - x[0][0], x[3][1] - x[0][1]}, b{x[2][0] - x[1][0], x[2][1] - x[1][1]};
      const double twice = a[0] * b[1] - a[1] * b[0];
      S[0] = {-b[1] / twice, b[0] / twice};
      S[1] = {a[1] / twice, -a[0] / twice};
      S[2] = {-S[1][0], -S[1][1]};
      S[3] = {-S[0][0], -S[0][1]};
    }
    return S;
  }

  /// The weights of a position in the domain, ξ_d from −1 to 1, that moves with the domain's mean deformation: x = Σ_c
  /// weight_c x_c. A load with these weights does not drive the relative motion of corners that strains nothing.
  static std::array<double, corners> weights(const Point<Dim>& xi) {
    std::array<double, corners> weight;
    for (int c = 0; c < corners; ++c) {
      weight[c] = 1.0 / corners;
      for (int d = 0; d < Dim; ++d) weight[c] += (c >> d & 1 ? xi[d] : -xi[d]) / corners;
    }
    return weight;
  }
};

/// The largest width of a domain along each axis that is even: the narrowest cell.
template <int Dim>
Point<Dim> widest_domain(const Grid<Dim>& grid) {
  Point<Dim> widest;
  for (int d = 0; d < Dim; ++d) {
    const std::vector<double>& nodes = grid.axes[d].nodes;
    widest[d] = nodes[1] - nodes[0];
    for (std::size_t c = 1; c + 1 < nodes.size(); ++c) widest[d] = std::min(widest[d], nodes[c + 1] - nodes[c]);
  }
  return widest;
}

/// The cell whose window contains a domain: that of its lower corner.
template <int Dim>
std::array<int, Dim> window_of(const Domain<Dim>& domain, const Grid<Dim>& grid) {
  std::array<int, Dim> cell;
  const Point<Dim> low = domain.low();
  for (int d = 0; d < Dim; ++d) {
    const Axis& axis = grid.axes[d];
    cell[d] = std::clamp(first_cell_of_domain(axis, low[d]), 0, std::max(axis.cells() - 2, 0));
  }
  return cell;
}

}  // namespace stillpoint
