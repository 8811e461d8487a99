// ARPACK's symmetric Lanczos method in shift-invert [Lehoucq, Sorensen & Yang, ARPACK Users' Guide, 1998, mode 3]:
//   K x = λ M x,   OP = (K − σM)⁻¹ M,   OP x = θ x,   λ = σ + 1/θ,
// so the λ nearest to σ is the θ of largest modulus. Only this file calls ARPACK, which keeps its state in static
// variables: one solution at a time.
#include <stillpoint/spectrum.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <stdexcept>

#include <arpack/arpack.h>
#include <fmt/format.h>

#include "base/stop_request.hpp"
#include "base/stopwatch.hpp"
#include "linalg/one_blas_thread.hpp"
#include "linalg/power_iteration.hpp"
#include "solvers/spectrum/nearest_eigenvalue.hpp"
#include "solvers/spectrum/stiffness.hpp"

namespace stillpoint {
namespace {

// The single eigenvalue λ = xᵀKx/xᵀMx of a system with n = 1: Lanczos' method needs at least two dimensions.
NearestEigenvalue single_eigenvalue(const LinearMap& solve, const Mass& mass, double sigma) {
  const std::array<double, 1> m = {mass.diagonal()[0]};
  std::array<double, 1> theta{};
  solve(m, theta);  // (K − σM)⁻¹ M
  return {sigma + 1 / theta[0], 1, true, "one degree of freedom: ω² = K/M, without ARPACK", {1 / std::sqrt(m[0])}};
}

}  // namespace

NearestEigenvalue nearest_eigenvalue(const LinearMap& solve, const Mass& mass, double sigma,
                                     const SpectrumOptions& options) {
  if (const std::string wrong = options.validate(); !wrong.empty()) throw std::invalid_argument(wrong);
  if (mass.size() == 1) return single_eigenvalue(solve, mass, sigma);
  static std::mutex arpack_state;
  const std::lock_guard lock(arpack_state);
  const OneBlasThread same_bits;

  const std::size_t n = mass.size();  // unknowns; there are twenty Lanczos vectors if n and max_iterations allow them
  const std::size_t vectors = std::min(n, static_cast<std::size_t>(std::clamp(options.max_iterations, 2, 20)));
  const auto size = static_cast<a_int>(n), ncv = static_cast<a_int>(vectors);
  constexpr a_int nev = 1;
  std::vector<double> residual = start_vector(n), basis(n * vectors), workd(3 * n), workl(vectors * (vectors + 8));
  const auto lworkl = static_cast<a_int>(workl.size());
  // iparam: exact shifts, at most max_iterations/ncv restarts of about ncv applications each, blocks of 1, mode 3.
  std::array<a_int, 11> iparam = {1, 0, std::max(1, options.max_iterations / ncv), 1, 0, 0, 3, 0, 0, 0, 0}, ipntr{};
  a_int ido = 0, info = 1;  // info = 1: start from residual
  const auto part = [&](std::size_t k) { return Vec(workd).subspan(static_cast<std::size_t>(ipntr[k] - 1), n); };

  NearestEigenvalue result;
  std::vector<double> Mx(n);
  while (true) {
    heed_stop_request();
    dsaupd_c(&ido, "G", size, "LM", nev, options.tolerance, residual.data(), ncv, basis.data(), size, iparam.data(),
             ipntr.data(), workd.data(), workl.data(), lworkl, &info);
    if (ido == -1) {  // y = OP x
      mass.apply(part(0), Mx);
      solve(Mx, part(1));
      ++result.applications;
    } else if (ido == 1) {  // y = OP x, M x given
      solve(part(2), part(1));
      ++result.applications;
    } else if (ido == 2) {  // y = M x
      mass.apply(part(0), part(1));
    } else {
      break;
    }
  }
  if (info != 0 || iparam[4] < nev) {
    result.status = info == 1 || info == 0
                        ? fmt::format("ARPACK: error of the Ritz value > tolerance {:.1e} after {} applications",
                                      options.tolerance, result.applications)
                        : fmt::format("ARPACK: dsaupd failed with info = {}", info);
    return result;
  }
  std::vector<a_int> select(vectors);
  dseupd_c(1, "A", select.data(), &result.lambda, basis.data(), size, sigma, "G", size, "LM", nev, options.tolerance,
           residual.data(), ncv, basis.data(), size, iparam.data(), ipntr.data(), workd.data(), workl.data(), lworkl,
           &info);
  result.converged = info == 0;
  result.mode.assign(basis.begin(), basis.begin() + static_cast<std::ptrdiff_t>(n));
  result.status = info == 0 ? fmt::format("ARPACK: error of the Ritz value ≤ tolerance {:.1e}", options.tolerance)
                            : fmt::format("ARPACK: dseupd failed with info = {}", info);
  return result;
}

FrequencyEstimate omega_1_by_arpack(const SemiDiscrete& system, double t, ConstVec u, const SpectrumOptions& options) {
  const Stopwatch watch;
  const SparseMatrix of_body = system.tangents().matrix(Tangent::elastic, t, u);
  const FactorisedStiffness K(system.mass(), of_body);
  if (!K.usable()) return {0, 0, watch.seconds(), false, K.refusal(0)};
  const LinearMap solve = [&](ConstVec b, Vec x) { K.solve(b, x); };
  const auto [lambda, applications, converged, status, mode] = nearest_eigenvalue(solve, system.mass(), 0, options);
  if (!converged) return {0, applications, watch.seconds(), false, status};
  if (const std::string refusal = K.refusal(lambda); !refusal.empty()) {
    return {0, applications, watch.seconds(), false, refusal};
  }
  return {std::sqrt(lambda), applications, watch.seconds(), true, status};
}

FrequencyEstimate omega_max_by_arpack(const SemiDiscrete& system, double t, ConstVec u,
                                      const SpectrumOptions& options) {
  const Stopwatch watch;
  const FrequencyEstimate bound = omega_max_bound_by_gershgorin(system, t, u);
  if (!bound.converged) return {0, 0, watch.seconds(), false, bound.status};
  if (bound.omega == 0) return {0, 0, watch.seconds(), true, "K = 0"};
  // Above the spectrum σM − K is positive definite, so that a Cholesky factor serves: (K − σM)⁻¹ = −(σM − K)⁻¹.
  const double sigma = (1 + 1e-6) * bound.omega * bound.omega;
  const SparseCholesky factor(
      SparseMatrix(sigma * system.mass().matrix() - system.tangents().matrix(Tangent::stiffest, t, u)));
  if (!factor.positive_definite()) return {0, 0, watch.seconds(), false, "σM − K is not positive definite"};
  const LinearMap solve = [&](ConstVec b, Vec x) {
    factor.solve(b, x);
    for (double& value : x) value = -value;
  };
  const auto [lambda, applications, converged, status, mode] = nearest_eigenvalue(solve, system.mass(), sigma, options);
  if (converged && lambda < 0) return {0, applications, watch.seconds(), false, "K is negative definite"};
  return {converged ? std::sqrt(lambda) : 0, applications, watch.seconds(), converged, status};
}

}  // namespace stillpoint
