#include "simulation/error_bound.hpp"

#include <stillpoint/spectrum.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <Eigen/SparseCore>

#include "base/parallel_loop.hpp"

namespace stillpoint {

ErrorBound::ErrorBound(const LagrangianPhase& phase, std::optional<double> omega_1, std::optional<VolumeNorm> volume)
    : phase_(phase), omega_1_(phase.info().updated_lagrangian ? std::nullopt : omega_1), volume_(std::move(volume)) {}

std::optional<double> ErrorBound::distance(StateNorms& norms, const Vector& u, ConstVec acceleration) {
  beside_largest_.reset();
  if (!omega_1_) return std::nullopt;
  const Mass& M = norms.system().mass();
  const Mass& V = volume_ ? volume_->V : M;
  by_strain_ = !V.has_product();
  const double omega_V = this->omega_V();
  energy_error_ = norms.energy_error(M, *omega_1_, acceleration);
  if (volume_) energy_error_ = std::min(energy_error_, norms.energy_error(V, omega_V));
  const double error = energy_error_ / omega_V;
  size_ = by_strain_ ? strain_norm(norms.system().last(), u) : norms.mass_norm(V, u);
  largest_ = std::max(largest_, std::min(size_, most_));
  const bool rests = std::max({error, size_, largest_}) <= (by_strain_ ? 0 : rounding_norm(norms, V, u.size()));
  const auto beside = [&](double length) { return error == 0 || rests ? 0 : error / length; };
  constexpr double negligible = 0.01;  // share of the largest ‖u‖_V so far
  beside_largest_ = beside(size_ > negligible * largest_ ? size_ : largest_);
  return beside(size_);
}

// ‖δ‖_V of a motion by the rounding of positions: ground that is at rest from the beginning has no u to be small
// beside.
double ErrorBound::rounding_norm(StateNorms& norms, const Mass& V, std::size_t unknowns) {
  if (rounding_norm_) return *rounding_norm_;
  double furthest = 0;
  for (const double x : phase_.fields().positions()) furthest = std::max(furthest, std::abs(x));
  Vector delta = norms.system().vectors().make(unknowns);
  std::ranges::fill(delta.span(), std::numeric_limits<double>::epsilon() * furthest);
  rounding_norm_ = norms.mass_norm(V, delta);
  return *rounding_norm_;
}

double ErrorBound::omega_V() const { return by_strain_ ? 1 : volume_ ? volume_->omega_1 : *omega_1_; }

// ‖u‖_K² = uᵀK u over free unknowns and supports: u·R + u_s·R_s.
double ErrorBound::strain_norm(const Evaluation& last, const Vector& u) const {
  const std::vector<double> support = phase_.supports().support_displacements(last.t);
  const ConstVec reactions = last.trial->reactions;
  const double of_supports =
      sum_over(std::min(support.size(), reactions.size()), [&](std::size_t s) { return support[s] * reactions[s]; });
  return std::sqrt(std::abs(dot(last.R, u) + of_supports));
}

// ‖u‖_V ≤ ‖u_s‖_V + ‖u − u*‖_V + ‖u_s − u*‖_V,  ω_V² ‖u − u*‖_V² ≤ ‖u − u*‖_K² ≤ ‖u_s − u*‖_K² + ‖v_s‖_M²
void ErrorBound::loads_have_settled(double kinetic_energy) {
  if (!omega_1_ || phase_.info().nonlinear || std::isfinite(most_)) return;
  const double omega_V = this->omega_V();
  most_ = size_ + 2 * std::sqrt(energy_error_ * energy_error_ + 2 * kinetic_energy) / omega_V;
}

bool ErrorBound::refresh(double t, ConstVec u, double residual) {
  constexpr double reduction = 0.25;  // of the residual, after which the tangent is looked at again
  if (!omega_1_ || by_strain_ || !phase_.info().nonlinear || !(residual < reduction * refreshed_at_)) return false;
  // The consistent tangent is that of the body at u, yielding included.
  const SparseMatrix K = phase_.tangents().matrix(Tangent::consistent, t, u), K_transposed = K.transpose();
  const SparseMatrix symmetric = 0.5 * (K + K_transposed);
  const auto frequency = [&](const Mass& mass) {
    const FrequencyEstimate lowest = lowest_frequency(symmetric, mass);
    return lowest.converged ? std::optional(lowest.omega) : std::nullopt;
  };
  const std::optional<double> of_mass = frequency(phase_.mass());
  const std::optional<double> of_volume = of_mass && volume_ ? frequency(volume_->V) : std::nullopt;
  refreshed_at_ = residual;
  omega_1_ = of_mass;
  if (!omega_1_ || !volume_) return true;
  if (!of_volume) omega_1_.reset();
  volume_->omega_1 = of_volume.value_or(0);
  return true;
}

}  // namespace stillpoint
