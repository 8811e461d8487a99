#include "solvers/spectrum/lowest_mode.hpp"

#include <cmath>

#include <Eigen/SparseCore>

#include "linalg/sparse_cholesky.hpp"
#include "solvers/spectrum/largest_entry.hpp"
#include "solvers/spectrum/nearest_eigenvalue.hpp"

namespace stillpoint {
namespace {

// Removes modes from x: x −= Σ_j x_j (x_jᵀ M x), for modes with x_jᵀ M x_j = 1, given with their products M x_j.
void leave_out(const std::vector<Eigen::VectorXd>& modes, const std::vector<Eigen::VectorXd>& M_modes, Vec x) {
  Eigen::Map<Eigen::VectorXd> of_x(x.data(), static_cast<Eigen::Index>(x.size()));
  for (std::size_t j = 0; j < modes.size(); ++j) of_x -= M_modes[j].dot(of_x) * modes[j];
}

// Finds the lowest mode that is not left out, by a factor of K + σM.
void find(const SparseCholesky& factor, const Mass& mass, double sigma,
          const std::function<bool(const std::vector<double>&)>& is_left_out, LowestMode& lowest) {
  constexpr int most = 12;
  std::vector<Eigen::VectorXd> modes, M_modes;
  const LinearMap solve = [&](ConstVec b, Vec x) {
    factor.solve(b, x);
    leave_out(modes, M_modes, x);
  };
  for (int k = 0; k <= most; ++k) {
    const NearestEigenvalue nearest = nearest_eigenvalue(solve, mass, -sigma);
    lowest.found = nearest.converged;
    lowest.omega_squared = nearest.lambda;
    lowest.x = nearest.mode;
    if (!lowest.found || !is_left_out || !is_left_out(lowest.x)) return;
    modes.emplace_back(Eigen::Map<const Eigen::VectorXd>(lowest.x.data(), static_cast<Eigen::Index>(lowest.x.size())));
    M_modes.emplace_back(modes.back().size());
    mass.apply(lowest.x, {M_modes.back().data(), lowest.x.size()});
  }
  lowest.found = false;
}

}  // namespace

LowestMode lowest_mode(const SparseMatrix& K, const Mass& mass,
                       const std::function<bool(const std::vector<double>&)>& is_left_out) {
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
    find(factor, mass, sigma, is_left_out, lowest);
    break;
  }
  return lowest;
}

}  // namespace stillpoint
