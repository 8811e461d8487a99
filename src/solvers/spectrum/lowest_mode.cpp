#include "solvers/spectrum/lowest_mode.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/SparseCore>

#include "linalg/sparse_cholesky.hpp"
#include "solvers/spectrum/nearest_eigenvalue.hpp"

namespace stillpoint {
namespace {

// max |K_ij|/√(M_ii M_jj), of the size of the largest |λ|; NaN if one is. An indefinite K may have a diagonal of zeros.
double largest_entry(const SparseMatrix& K, const Mass& mass) {
  double largest = 0;
  for (Eigen::Index j = 0; j < K.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator entry(K, j); entry; ++entry) {
      const auto row = static_cast<std::size_t>(entry.row()), column = static_cast<std::size_t>(j);
      const double size = std::abs(entry.value()) / std::sqrt(mass.diagonal()[row] * mass.diagonal()[column]);
      if (std::isnan(size)) return size;
      largest = std::max(largest, size);
    }
  }
  return largest;
}

}  // namespace

LowestMode lowest_mode(const SparseMatrix& K, const Mass& mass) {
  const double scale = largest_entry(K, mass);
  LowestMode lowest{.rounding = 64 * std::numeric_limits<double>::epsilon() * scale};
  if (!(scale > 0) || !std::isfinite(scale)) return lowest;
  const SparseMatrix M = mass.matrix();
  lowest.positive_definite = SparseCholesky(SparseMatrix(K - lowest.rounding * M)).positive_definite();
  if (lowest.positive_definite) return lowest;
  constexpr int most_shifts = 15;
  double sigma = 1e-10 * scale;
  for (int k = 0; k < most_shifts; ++k, sigma *= 10) {
    const SparseCholesky factor(SparseMatrix(K + sigma * M));
    if (!factor.positive_definite()) continue;
    const LinearMap solve = [&](ConstVec b, Vec x) { factor.solve(b, x); };
    const NearestEigenvalue nearest = nearest_eigenvalue(solve, mass, -sigma);
    lowest.found = nearest.converged;
    lowest.omega_squared = nearest.lambda;
    lowest.x = nearest.mode;
    break;
  }
  return lowest;
}

}  // namespace stillpoint
