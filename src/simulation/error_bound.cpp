#include "simulation/error_bound.hpp"

#include <stillpoint/spectrum.hpp>

#include <algorithm>

namespace stillpoint {

ErrorBound::ErrorBound(const LagrangianPhase& phase, std::optional<double> omega_1)
    : phase_(phase), omega_1_(phase.info().updated_lagrangian ? std::nullopt : omega_1) {}

std::optional<double> ErrorBound::distance(RelaxationSystem& relaxation, const Vector& u) {
  beside_largest_.reset();
  if (!omega_1_) return std::nullopt;
  const double error = relaxation.error_norm(*omega_1_), size = relaxation.mass_norm(u);
  largest_ = std::max(largest_, size);
  const auto beside = [&](double length) { return error == 0 ? 0 : error / length; };
  beside_largest_ = beside(largest_);
  return beside(size);
}

bool ErrorBound::refresh(double t, ConstVec u, double residual) {
  constexpr double much_nearer = 0.25;
  if (!omega_1_ || !phase_.info().nonlinear || !(residual < much_nearer * refreshed_at_)) return false;
  refreshed_at_ = residual;
  const FrequencyEstimate lowest = omega_1_of_tangent(phase_, t, u);
  omega_1_ = lowest.converged ? std::optional(lowest.omega) : std::nullopt;
  return true;
}

}  // namespace stillpoint
