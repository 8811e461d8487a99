#include <stillpoint/state_norms.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "system/force_scale.hpp"

namespace stillpoint {

double StateNorms::residual(double t, ConstVec u) {
  return system_.evaluate(t, u) ? last_residual() : std::numeric_limits<double>::quiet_NaN();
}

double StateNorms::last_residual() {
  system_.last_static_balance(Q_.span());
  return relative(norm(Q_), system_.force_scale());
}

// ‖M⁻¹Q‖_M² = Qᵀ M⁻¹ Q
double StateNorms::energy_error(const Mass& M, double omega_1, ConstVec acceleration) {
  if (acceleration.empty()) {
    M.solve(Q_.span(), work().span());
  } else {
    std::ranges::copy(acceleration, work().span().begin());
  }
  return std::sqrt(dot(Q_, work())) / omega_1;
}

double StateNorms::mass_norm(const Mass& M, const Vector& u) {
  M.apply(u.span(), work().span());
  return std::sqrt(dot(u, work()));
}

double StateNorms::work_scale(const Vector& u) const {
  return std::abs(dot(system_.last().F, u)) + std::abs(dot(system_.last().R, u));
}

// Computes Q·v and ½ vᵀ M v, or Q·M⁻¹p and ½ pᵀ M⁻¹ p if the momentum is kept.
StateNorms::Motion StateNorms::motion(const Vector& v, ConstVec velocity) {
  const Mass& M = system_.mass();
  if (system_.keeps_momentum()) {
    if (velocity.empty()) {
      M.solve(v.span(), work().span());
    } else {
      std::ranges::copy(velocity, work().span().begin());
    }
    return {.power = dot(Q_, work()), .kinetic_energy = 0.5 * dot(v, work())};
  }
  M.apply(v.span(), work().span());
  return {.power = dot(Q_, v), .kinetic_energy = 0.5 * dot(v, work()) - M.relative_energy(v.span())};
}

Vector& StateNorms::work() {
  if (!work_) work_ = system_.vectors().make(system_.size());
  return *work_;
}

}  // namespace stillpoint
