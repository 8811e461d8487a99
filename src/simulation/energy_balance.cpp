#include "simulation/energy_balance.hpp"

#include <cmath>

namespace stillpoint {

std::vector<std::string> EnergyBalance::columns() const {
  if (!watches_) return {};
  return {"inertia.external_work", "inertia.kinetic_over_work"};
}

std::vector<double> EnergyBalance::values(double kinetic_energy) const {
  if (!watches_) return {};
  return {work_, kinetic_energy > 0 ? kinetic_energy / std::abs(work_) : 0};
}

void EnergyBalance::advance(double t, ConstVec F, ConstVec u) {
  if (!watches_) return;
  if (u_.empty()) {  // the start of the run
    u_.assign(u.begin(), u.end());
    F_.assign(F.begin(), F.end());
  }
  for (std::size_t i = 0; i < u_.size(); ++i) work_ += 0.5 * (F_[i] + F[i]) * (u[i] - u_[i]);
  const double power = wall_power(t);
  work_ += 0.5 * (power_ + power) * (t - t_);
  u_.assign(u.begin(), u.end());
  F_.assign(F.begin(), F.end());
  power_ = power;
  t_ = t;
}

void EnergyBalance::begin_phase(ConstVec F) {
  if (!watches_) return;
  u_.assign(F.size(), 0);
  F_.assign(F.begin(), F.end());
}

double EnergyBalance::wall_power(double t) const {
  double power = 0;
  for (const WallReaction& wall : phase_.wall_reactions(t)) power += wall.power;
  return power;
}

}  // namespace stillpoint
