// The coefficient of a spline from values of what it stands for.
#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/LU>

#include "space/grid/grid.hpp"

namespace stillpoint {

/// Positions along an axis, with weights: Σ_k weight_k f(x_k) is the coefficient of one function of a spline for f.
struct WeightedPositions {
  std::vector<double> x;  // [m]
  std::vector<double> weight;
};

/// The coefficient of function i of splines of degree p ≥ 1 on the cells of an axis, from positions between the first
/// and the last of its inner knots. It is exact for polynomials up to degree p, so that f is met to order p + 1, and
/// takes a single value where the basis interpolates. The weights have the coefficient of each monomial, which is its
/// polar form at the function's knots τ_1 … τ_p: e_m(τ)/(p over m) for x^m [de Boor and Fix 1973, J. Approx. Theory
/// 8:19-45].
inline WeightedPositions spline_coefficient(const Axis& axis, int degree, int function) {
  std::vector<double> knots;
  for (int q = function - degree + 1; q <= function; ++q)
    knots.push_back(axis.nodes[static_cast<std::size_t>(std::clamp(q, 0, axis.cells()))]);
  const double from = knots.front(), length = knots.back() - from;
  if (length == 0) return {{from}, {1.0}};

  // Elementary symmetric polynomials of the knots in units of their interval, by multiplying Π (1 + τ z) out.
  const auto n = static_cast<Eigen::Index>(degree) + 1;
  Eigen::VectorXd e = Eigen::VectorXd::Unit(n, 0);
  for (const double knot : knots)
    for (Eigen::Index m = n - 1; m > 0; --m) e[m] += (knot - from) / length * e[m - 1];
  double over = 1;  // p over m
  for (Eigen::Index m = 0; m < n; ++m) {
    e[m] /= over;
    over *= static_cast<double>(degree - m) / static_cast<double>(m + 1);
  }
  Eigen::MatrixXd powers(n, n);
  WeightedPositions found;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double s = static_cast<double>(k) / degree;
    found.x.push_back(from + s * length);
    powers(0, k) = 1;
    for (Eigen::Index m = 1; m < n; ++m) powers(m, k) = powers(m - 1, k) * s;
  }
  const Eigen::VectorXd weight = powers.partialPivLu().solve(e);
  found.weight.assign(weight.begin(), weight.end());
  return found;
}

}  // namespace stillpoint
