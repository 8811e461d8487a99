// An upper bound of ω_max by Gershgorin's circles.
//
// Lumped M = D: ω_max² is the largest eigenvalue of D^{−½} K D^{−½}, and every eigenvalue lies in one of Gershgorin's
// circles: |λ| ≤ G = max_i Σ_j |K_ij|/√(M_ii M_jj), a number without regard to the units of the degrees of freedom.
//
// Consistent M, with D = diag M and 0 < s < λ_min(D⁻¹M): for every x
//   xᵀKx/xᵀMx = (xᵀKx/xᵀDx)/(xᵀMx/xᵀDx) ≤ G/s,   so ω_max² ≤ G/s.
// s is guaranteed, because a Cholesky factor of M − s D exists: M − s D is positive definite, hence xᵀMx > s xᵀDx for
// all x. (Inverse iteration on M, always an upper estimate of λ_min(D⁻¹M), only proposes s.)
#include <stillpoint/spectrum.hpp>

#include <algorithm>
#include <cmath>

#include <Eigen/SparseCore>
#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "linalg/power_iteration.hpp"
#include "linalg/sparse_cholesky.hpp"

namespace stillpoint {
namespace {

struct LowerBound {
  double s = 0;
  int factorisations = 0;
};

// The sums Σ_j |A_ij|/√(D_i D_j) for every i, (n); A symmetric.
std::vector<double> scaled_row_sums(const SparseMatrix& A, ConstVec D) {
  std::vector<double> sums(D.size(), 0.0);
  for (Eigen::Index j = 0; j < A.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(A, j); entry; ++entry) {
      const auto row = static_cast<std::size_t>(entry.row()), column = static_cast<std::size_t>(j);
      sums[row] += std::abs(entry.value()) / std::sqrt(D[row] * D[column]);
    }
  }
  return sums;
}

// The largest of the values, or NaN if one of them is NaN.
double largest(const std::vector<double>& values) {
  double result = 0;
  for (double value : values) result = std::isnan(result) || value <= result ? result : value;
  return result;
}

bool is_below_spectrum(double s, const Mass& mass) {
  SparseMatrix shifted = mass.matrix();
  for (Eigen::Index i = 0; i < shifted.rows(); ++i) shifted.coeffRef(i, i) *= 1 - s;  // M − s D
  return SparseCholesky(shifted).positive_definite();
}

// A lower bound s of the scaled mass, 0 < s < λ_min(D⁻¹M), usually 1 to 10 % below λ_min and found by one
// factorisation.
LowerBound lower_bound_of_scaled_mass(const Mass& mass) {
  // Gershgorin's lower circles of D^{−½} M D^{−½}: its diagonal is 1, so 1 − (sum − 1).
  const double circles = 2 - largest(scaled_row_sums(mass.matrix(), mass.diagonal()));
  const LinearMap apply_D = [&](ConstVec x, Vec y) {
    std::transform(x.begin(), x.end(), mass.diagonal().begin(), y.begin(), std::multiplies<>());
  };
  const LinearMap solve_M = [&](ConstVec b, Vec x) { mass.solve(b, x); };
  const double estimate = 1 / power_iteration(mass.size(), apply_D, solve_M, 0.01, 100).eigenvalue;  // ≥ λ_min
  LowerBound bound;
  for (double s = 0.98 * estimate; s > circles && s > 1e-14; s *= 0.95) {
    ++bound.factorisations;
    if (is_below_spectrum(s, mass)) {
      bound.s = s;
      return bound;
    }
  }
  bound.s = std::max(circles, 0.0);
  return bound;
}

}  // namespace

FrequencyEstimate omega_max_bound_by_gershgorin(const SemiDiscrete& system, double t, ConstVec u) {
  const Stopwatch watch;
  const Mass& mass = system.mass();
  const double G = largest(scaled_row_sums(system.tangents().matrix(Tangent::stiffest, t, u), mass.diagonal()));
  if (!std::isfinite(G)) return {0, 0, watch.seconds(), false, "K is not finite"};
  if (mass.is_diagonal()) return {std::sqrt(G), 0, watch.seconds(), true, "ω² ≤ max Σ |K_ij|/√(M_ii M_jj)"};
  const auto [s, factorisations] = lower_bound_of_scaled_mass(mass);
  if (!(s > 0)) return {0, 0, watch.seconds(), false, "no s > 0 was found with M − s diag M positive definite"};
  return {std::sqrt(G / s), 0, watch.seconds(), true,
          fmt::format("ω² ≤ max Σ |K_ij|/√(M_ii M_jj)/s, s = {:.4g} < λ_min(D⁻¹M) certified by {}", s,
                      factorisations > 0 ? "a factor of M − s D" : "Gershgorin's circles of M")};
}

}  // namespace stillpoint
