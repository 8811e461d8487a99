#include "simulation/energy_balance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "base/parallel_loop.hpp"

namespace stillpoint {
namespace {

// ½ (f₀ + f₁) · (u₁ − u₀)
double work_between(ConstVec f0, ConstVec f1, ConstVec u0, ConstVec u1) {
  return sum_over(u1.size(), [=](std::size_t i) { return 0.5 * (f0[i] + f1[i]) * (u1[i] - u0[i]); });
}

std::vector<double> copy_of(ConstVec values) { return {values.begin(), values.end()}; }

}  // namespace

std::vector<std::string> EnergyBalance::columns() const {
  if (!watches_) return {};
  return {"inertia.external_work", "inertia.kinetic_over_work"};
}

std::vector<double> EnergyBalance::values(double kinetic_energy) const {
  if (!watches_) return {};
  const double none = kinetic_energy > 0 ? std::numeric_limits<double>::quiet_NaN() : 0;
  return {work_, work_ != 0 ? kinetic_energy / std::abs(work_) : none};
}

void EnergyBalance::advance(double t, const PhaseMotion& motion) {
  if (!watches_) return;
  if (const auto way = motion.stepper->way()) return advance(t, *way);
  const RelaxationSystem& system = motion.system;
  const ConstVec F = system.last().F.span(), reactions = system.last().trial->reactions, u = motion.u();
  const std::vector<double> support = phase_.supports().support_displacements(t);
  if (last_.u.empty())  // the start of the run: nothing has moved yet but supports, from where nothing is deformed
    last_ = {copy_of(F), copy_of(u), std::vector(reactions.size(), 0.0), std::vector(support.size(), 0.0)};
  work_ += work_between(last_.F, F, last_.u, u);
  work_ += work_between(last_.reactions, reactions, last_.support, support);
  const double power = wall_power(t);
  work_ += 0.5 * (power_ + power) * (t - t_);
  last_ = {copy_of(F), copy_of(u), copy_of(reactions), support};
  power_ = power;
  t_ = t;
}

// Supports of the first phase have gone all the way from where nothing is deformed; there is no last_ then.
void EnergyBalance::advance(double t, const Stepper::Way& way) {
  const std::vector<double> support = phase_.supports().support_displacements(t);
  work_ = earlier_work_ + way.of_loads;
  for (std::size_t s = 0; s < std::min(support.size(), way.reactions.size()); ++s)
    work_ += way.reactions[s] * (support[s] - (s < last_.support.size() ? last_.support[s] : 0));
  t_ = t;
}

void EnergyBalance::begin_phase(double t, const RelaxationSystem& system) {
  if (!watches_) return;
  earlier_work_ = work_;
  last_ = {copy_of(system.last().F.span()), std::vector(system.size(), 0.0), system.last().trial->reactions,
           phase_.supports().support_displacements(t)};
}

void EnergyBalance::go_on(double work, double t, double now, const RelaxationSystem& system) {
  work_ = work;
  t_ = now;
  if (!watches_) return;
  power_ = wall_power(now);
  begin_phase(t, system);
}

void EnergyBalance::archive(const StateArchive& state) {
  state("work", work_, "t", t_, "power", power_, "earlier_work", earlier_work_);
  state.none_or(phase_.size(), "u", last_.u);
  const std::size_t n = last_.u.size(), supports = n > 0 ? phase_.supports().support_displacements(t_).size() : 0;
  last_.F.resize(n);
  last_.reactions.resize(supports);
  last_.support.resize(supports);
  state("F", Vec(last_.F));
  state("reactions", Vec(last_.reactions));
  state("support", Vec(last_.support));
}

double EnergyBalance::wall_power(double t) const {
  double power = 0;
  for (const WallReaction& wall : phase_.supports().wall_reactions(t)) power += wall.power;
  return power;
}

}  // namespace stillpoint
