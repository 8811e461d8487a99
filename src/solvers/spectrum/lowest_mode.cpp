#include "solvers/spectrum/lowest_mode.hpp"

#include <cmath>

#include <Eigen/SparseCore>

#include "linalg/sparse_cholesky.hpp"
#include "solvers/spectrum/largest_entry.hpp"
#include "solvers/spectrum/nearest_eigenvalue.hpp"

namespace stillpoint {
LowestMode lowest_mode(const SparseMatrix& K, const Mass& mass) {
  const double scale = largest_entry(K, mass);
  LowestMode lowest{.rounding = rounding_of_eigenvalues * scale};
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
