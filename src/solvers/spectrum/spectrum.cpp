// The highest frequency by power iteration, the lowest by Lanczos' method on K⁻¹M. iterations counts applications of
// the operator.
#include <stillpoint/spectrum.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "linalg/lanczos.hpp"
#include "linalg/power_iteration.hpp"
#include "solvers/spectrum/nearest_eigenvalue.hpp"
#include "solvers/spectrum/stiffness.hpp"

namespace stillpoint {
namespace {

void require_valid(const SpectrumOptions& options) {
  if (const std::string wrong = options.validate(); !wrong.empty()) throw std::invalid_argument(wrong);
}

std::string status_of(double error, bool converged, int iterations, double tolerance) {
  return fmt::format("estimated error of ω² {:.1e} {} tolerance {:.1e} after {} iterations", error,
                     converged ? "≤" : ">", tolerance, iterations);
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
  const LinearMap apply_K = [&](ConstVec x, Vec Kx) { system.tangents().apply(Tangent::stiffest, t, u, x, Kx); };
  const LinearMap solve_M = [&](ConstVec b, Vec x) { system.mass().solve(b, x); };
  const PowerIterationResult result =
      power_iteration(system.size(), apply_K, solve_M, options.tolerance, options.max_iterations);
  FrequencyEstimate estimate{0, result.iterations, watch.seconds(), result.converged,
                             status_of(result.relative_error, result.converged, result.iterations, options.tolerance)};
  if (!std::isfinite(result.eigenvalue)) estimate.status = "the Rayleigh quotient is not finite";
  if (result.eigenvalue > 0) {
    estimate.omega = std::sqrt(result.eigenvalue);
  } else if (result.eigenvalue < 0) {
    estimate.converged = false;
    estimate.status = "K is indefinite: its eigenvalue of largest modulus is negative";
  }
  return estimate;
}

namespace {

struct Lowest {
  double omega_squared = 0;  // ω₁², approached from above [1/s²]
  int applications = 0;      // of K⁻¹M
  bool converged = false;
  std::string status;
  std::vector<double> mode;
};

constexpr int most_vectors = 60;  // most Lanczos vectors that are kept

// The largest eigenvalue of K⁻¹M by Lanczos' method, with its error within the tolerance twice running; n: size of M.
Lowest lowest_by_lanczos(const FactorisedStiffness& K, const LinearMap& apply_M, std::size_t n, double tolerance,
                         int most) {
  const LinearMap solve_K = [&](ConstVec b, Vec x) { K.solve(b, x); };
  const VectorSpace vectors;
  Vector b = vectors.make(n);
  std::ranges::copy(start_vector(n), b.span().begin());
  Lanczos lanczos(apply_M, solve_K, std::move(b), true);
  Lanczos::Largest largest{.theta = std::numeric_limits<double>::quiet_NaN()};
  double error = std::numeric_limits<double>::infinity();
  int held = 0;
  while (lanczos.applications() < most && held < 2 && lanczos.step()) {
    largest = lanczos.largest();
    error = std::max(largest.error / largest.theta, std::numeric_limits<double>::epsilon());
    held = error <= std::max(tolerance, std::numeric_limits<double>::epsilon()) ? held + 1 : 0;
  }
  const bool exhausted = lanczos.finite() && lanczos.applications() < most && held == 1;
  Lowest lowest{.omega_squared = 1 / largest.theta,
                .applications = lanczos.applications(),
                .converged = held == 2 || exhausted,
                .status = "the Rayleigh quotient is not finite",
                .mode = {}};
  if (!lanczos.finite() || !std::isfinite(largest.theta)) {
    lowest.converged = false;
    return lowest;
  }
  lowest.status = status_of(error, lowest.converged, lowest.applications, tolerance);
  lowest.mode = lanczos.vector();
  return lowest;
}

}  // namespace

// If Lanczos' method does not converge, ARPACK uses the same factor: rounding in solutions with an ill-conditioned K,
// or a second mode of nearly the same frequency, may keep the former from converging.
FrequencyEstimate lowest_frequency(const SparseMatrix& of_body, const Mass& mass, const SpectrumOptions& options) {
  require_valid(options);
  const Stopwatch watch;
  const FactorisedStiffness K(mass, of_body);
  if (!K.usable()) return {0, 0, watch.seconds(), false, K.refusal(0)};
  const int most = std::clamp(options.max_iterations / 2, 1, most_vectors);
  const LinearMap apply_M = [&](ConstVec x, Vec Mx) { mass.apply(x, Mx); };
  Lowest lowest = lowest_by_lanczos(K, apply_M, mass.size(), options.tolerance, most);
  FrequencyEstimate estimate{0, lowest.applications, 0, lowest.converged, lowest.status, std::move(lowest.mode)};
  double omega_squared = lowest.omega_squared;
  if (!lowest.converged && std::isfinite(omega_squared) && options.max_iterations > most) {
    const LinearMap solve_K = [&](ConstVec b, Vec x) { K.solve(b, x); };
    const NearestEigenvalue nearest = nearest_eigenvalue(
        solve_K, mass, 0, {.tolerance = options.tolerance, .max_iterations = options.max_iterations - most});
    estimate.iterations += nearest.applications;
    estimate.converged = nearest.converged;
    if (nearest.converged) {
      omega_squared = nearest.lambda;
      estimate.mode = nearest.mode;
    }
    estimate.status = fmt::format("{}; {}", estimate.status, nearest.status);
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

FrequencyEstimate lowest_frequency(const SparseMatrix& of_body, const SparseMatrix& of_material, const Mass& mass,
                                   const SpectrumOptions& options) {
  require_valid(options);
  const Stopwatch watch;
  const FactorisedStiffness K(mass, of_body);
  if (!K.usable()) return {0, 0, watch.seconds(), false, K.refusal(0)};
  const LinearMap apply_M = [&](ConstVec x, Vec Mx) {
    const auto n = static_cast<Eigen::Index>(x.size());
    Eigen::Map<Eigen::VectorXd>(Mx.data(), n) = of_material * Eigen::Map<const Eigen::VectorXd>(x.data(), n);
  };
  Lowest lowest =
      lowest_by_lanczos(K, apply_M, mass.size(), options.tolerance, std::min(options.max_iterations, most_vectors));
  const std::string refusal = K.refusal(lowest.omega_squared);
  if (!refusal.empty()) return {0, lowest.applications, watch.seconds(), false, refusal};
  return {std::sqrt(lowest.omega_squared), lowest.applications, watch.seconds(), lowest.converged, lowest.status,
          std::move(lowest.mode)};
}

FrequencyEstimate omega_1_by_lanczos(const SemiDiscrete& system, double t, ConstVec u, const SpectrumOptions& options) {
  return lowest_frequency(system.tangents().matrix(Tangent::elastic, t, u), system.mass(), options);
}

}  // namespace stillpoint
