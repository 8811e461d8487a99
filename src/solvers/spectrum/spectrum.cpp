// Extreme frequencies by power iteration and inverse iteration. iterations counts applications of the operator.
#include <stillpoint/spectrum.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "linalg/power_iteration.hpp"
#include "solvers/spectrum/nearest_eigenvalue.hpp"
#include "solvers/spectrum/stiffness.hpp"

namespace stillpoint {
namespace {

void require_valid(const SpectrumOptions& options) {
  if (const std::string wrong = options.validate(); !wrong.empty()) throw std::invalid_argument(wrong);
}

std::string status_of(const PowerIterationResult& result, const SpectrumOptions& options) {
  if (!std::isfinite(result.eigenvalue)) return "the Rayleigh quotient is not finite";
  return fmt::format("estimated error of ω² {:.1e} {} tolerance {:.1e} after {} iterations", result.relative_error,
                     result.converged ? "≤" : ">", options.tolerance, result.iterations);
}

}  // namespace

std::string SpectrumOptions::validate() const {
  if (!(tolerance > 0) || !std::isfinite(tolerance)) return fmt::format("tolerance = {}, expected > 0", tolerance);
  if (max_iterations < 1) return fmt::format("max_iterations = {}, expected ≥ 1", max_iterations);
  return "";
}

FrequencyEstimate omega_max_by_power_iteration(const SemiDiscrete& system, double t, ConstVec u,
                                               const SpectrumOptions& options) {
  require_valid(options);
  const Stopwatch watch;
  const LinearMap apply_K = [&](ConstVec x, Vec Kx) { system.tangents().apply(Tangent::elastic, t, u, x, Kx); };
  const LinearMap solve_M = [&](ConstVec b, Vec x) { system.mass().solve(b, x); };
  const PowerIterationResult result =
      power_iteration(system.size(), apply_K, solve_M, options.tolerance, options.max_iterations);
  FrequencyEstimate estimate{0, result.iterations, watch.seconds(), result.converged, status_of(result, options)};
  if (result.eigenvalue > 0) {
    estimate.omega = std::sqrt(result.eigenvalue);
  } else if (result.eigenvalue < 0) {
    estimate.converged = false;
    estimate.status = "K is indefinite: its eigenvalue of largest modulus is negative";
  }
  return estimate;
}

// x ← K⁻¹ M x, and with the same factor ARPACK, if that does not converge: rounding in solutions with an
// ill-conditioned K moves ρ by more than the tolerance, or a second mode has nearly the same frequency. Each has half
// of the iterations.
FrequencyEstimate lowest_frequency(const SparseMatrix& of_body, const Mass& mass, const SpectrumOptions& options) {
  require_valid(options);
  const Stopwatch watch;
  const FactorisedStiffness K(mass, of_body);
  if (!K.usable()) return {0, 0, watch.seconds(), false, K.refusal(0)};
  const LinearMap apply_M = [&](ConstVec x, Vec Mx) { mass.apply(x, Mx); };
  const LinearMap solve_K = [&](ConstVec b, Vec x) { K.solve(b, x); };
  const int half = std::max(1, options.max_iterations / 2);
  const PowerIterationResult result = power_iteration(mass.size(), apply_M, solve_K, options.tolerance, half);
  FrequencyEstimate estimate{0, result.iterations, 0, result.converged, status_of(result, options), result.x};
  double omega_squared = 1 / result.eigenvalue;  // from above
  if (!result.converged && std::isfinite(result.eigenvalue) && options.max_iterations > half) {
    const NearestEigenvalue lowest = nearest_eigenvalue(
        solve_K, mass, 0, {.tolerance = options.tolerance, .max_iterations = options.max_iterations - half});
    estimate.iterations += lowest.applications;
    estimate.converged = lowest.converged;
    if (lowest.converged) {
      omega_squared = lowest.lambda;
      estimate.mode = lowest.mode;
    }
    estimate.status = fmt::format("{}; {}", estimate.status, lowest.status);
  }
  estimate.wall_s = watch.seconds();
  if (const std::string refusal = K.refusal(omega_squared); !refusal.empty()) {
    estimate.converged = false;
    estimate.status = refusal;
  } else {
    estimate.omega = std::sqrt(omega_squared);
  }
  return estimate;
}

FrequencyEstimate omega_1_by_inverse_iteration(const SemiDiscrete& system, double t, ConstVec u,
                                               const SpectrumOptions& options) {
  return lowest_frequency(system.tangents().matrix(Tangent::elastic, t, u), system.mass(), options);
}

}  // namespace stillpoint
