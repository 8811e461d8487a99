// Extreme frequencies of K x = ω² M x, K the elastic tangent of R.
#pragma once

#include <stillpoint/semi_discrete.hpp>

#include <optional>
#include <string>
#include <vector>

namespace stillpoint {

struct SpectrumOptions {
  double tolerance = 1e-10;  // relative change of ω² between iterations that counts as convergence
  int max_iterations = 2000;
  /// Describes the fault of the options; empty if there is none.
  std::string validate() const;
};

/// One frequency by one method, with its cost.
struct FrequencyEstimate {
  double omega = 0;  // [rad/s]
  int iterations = 0;
  double wall_s = 0;
  bool converged = false;
  std::string status;  // the inequality that ended it, or why there is no answer
  /// The eigenvector x of the lowest frequency by Lanczos' method, (n), of any length; otherwise empty.
  std::vector<double> mode{};
};

/// ω_max from below by power iteration: x ← M⁻¹ K x, Rayleigh quotient xᵀKx/xᵀMx, matrix-free. K at (t, u).
FrequencyEstimate omega_max_by_power_iteration(const SemiDiscrete& system, double t, ConstVec u,
                                               const SpectrumOptions& = {});
/// ω_max from above, guaranteed, by Gershgorin's circles of the scaled K (see the source for consistent M).
FrequencyEstimate omega_max_bound_by_gershgorin(const SemiDiscrete& system, double t, ConstVec u);
/// ω_max, mostly from above, by Lanczos' method with the residual added. Without a tolerance, a dozen applications of K
/// give it to about a per cent; with one, iterates until the residual is that share of ω, in at most `applications`,
/// and is not converged if they were not enough.
FrequencyEstimate omega_max_by_lanczos(const SemiDiscrete& system, double t, ConstVec u, int applications = 12,
                                       std::optional<double> tolerance = std::nullopt);
/// ω₁: Lanczos' method on K⁻¹M with a CHOLMOD factor of K, and ARPACK with that factor if rounding keeps it from
/// converging. Not converged, ω = 0, if K is singular: the body is not held.
FrequencyEstimate omega_1_by_lanczos(const SemiDiscrete& system, double t, ConstVec u, const SpectrumOptions& = {});
/// The lowest frequency of any symmetric K and M, (n × n), by the method of omega_1_by_lanczos().
FrequencyEstimate lowest_frequency(const SparseMatrix& K, const Mass& M, const SpectrumOptions& = {});
/// The lowest frequency of K x = ω² A x with A, (n × n), positive semidefinite and no more than M: a motion without
/// inertia in A follows the others, however slow it is with M.
FrequencyEstimate lowest_frequency(const SparseMatrix& K, const SparseMatrix& A, const Mass& M,
                                   const SpectrumOptions& = {});
/// ω₁ by ARPACK in shift-invert about 0, and ω_max by ARPACK in shift-invert about the Gershgorin bound.
FrequencyEstimate omega_1_by_arpack(const SemiDiscrete& system, double t, ConstVec u, const SpectrumOptions& = {});
FrequencyEstimate omega_max_by_arpack(const SemiDiscrete& system, double t, ConstVec u, const SpectrumOptions& = {});

}  // namespace stillpoint
