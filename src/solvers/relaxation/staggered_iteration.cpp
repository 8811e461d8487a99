#include "solvers/relaxation/staggered_iteration.hpp"

#include <algorithm>
#include <utility>

#include "base/parallel_loop.hpp"

namespace stillpoint {

StaggeredIteration::StaggeredIteration(const RelaxationOptions& options, RelaxationSystem& system)
    : March({.max_step = options.max_step}, system),
      relaxation_(options),
      Q_(system.vectors().make(system.size())),
      a_(system.vectors().make(system.size())),
      next_Q_(system.vectors().make(system.size())),
      next_a_(system.vectors().make(system.size())),
      Mx_(system.vectors().make(system.size())),
      work_(system.vectors().make(system.size())) {}

Stepper::Known StaggeredIteration::known() const {
  Known known{.force = is_at_state()};
  if (p_) known.velocity = v_->span();
  if (p_ && known.force) known.acceleration = a_.span();
  return known;
}

bool StaggeredIteration::begin(double t, const Vector& y) {
  u_.emplace(system().vectors().view(first_half(state().span())));
  if (system().keeps_momentum()) {
    p_.emplace(system().vectors().view(second_half(state().span())));
    if (!v_) v_ = system().vectors().make(system().size()), next_v_ = system().vectors().make(system().size());
    system().mass().solve(p_->span(), v_->span());
  } else {
    v_.emplace(system().vectors().view(second_half(state().span())));
  }
  t_ = t;
  last_step_ = relaxation().from.last_step;
  system().set_damping_rate(relaxation().from.rate.value_or(0));
  return evaluate_anew(t, y);
}

bool StaggeredIteration::restart(double t, const Vector& /*y*/) {
  system().last_out_of_balance(t, Q_.span());
  system().mass().solve(Q_.span(), a_.span());
  remember_loads();
  on_restart();
  return true;
}

bool StaggeredIteration::evaluate_anew(double t, const Vector& /*y*/) {
  const bool is_admissible = system().out_of_balance(t, u_->span(), Q_.span(), a_.span());
  remember_loads();
  if (is_admissible) on_restart();
  return is_admissible;
}

void StaggeredIteration::remember_loads() {
  if (relaxation_.steady) return;
  const ConstVec F = system().last().F.span();
  F_.assign(F.begin(), F.end());
}

TrialStepper::Attempt StaggeredIteration::attempt(double t, Vector& /*y*/, double h, double /*t_stop*/, Vector& trial) {
  const Vec u_new = first_half(trial.span());
  if (p_ && !next_p_) next_p_.emplace(system().vectors().view(second_half(trial.span())));
  propose(h, u_new, p_ ? next_v_->span() : second_half(trial.span()));
  if (!system().out_of_balance(t + h, u_new, next_Q_.span(), next_a_.span()))
    return {.status = StepReport::Status::inadmissible, .h = h};
  trial_step_ = h;
  trial_t_ = t + h;
  return {.h = h, .keeps_v = keeps_v(), .is_finite = tried(next_Q_, next_a_)};
}

void StaggeredIteration::accepted() {
  std::swap(Q_, next_Q_);
  std::swap(a_, next_a_);
  if (p_ && !keeps_v()) std::swap(v_, next_v_);
  last_step_ = trial_step_;
  t_ = trial_t_;
  if (!relaxation_.steady) {
    // The stiffness answers a step by ΔR = Q_before + ΔF − Q: a jump of the load F has to be left out of it.
    const ConstVec F = system().last().F.span();
    for_each_index(F.size(), [Q = next_Q_.span().data(), now = F.data(), before = F_.data()](std::size_t i) {
      Q[i] += now[i] - before[i];
    });
    remember_loads();
  }
  moved(trial_step_);
}

void StaggeredIteration::archive_memory(const StateArchive& state) {
  state("Q", Q_.span());
  state("a", a_.span());
  state("last_step", last_step_);
  if (p_) state("v", v_->span());
  if (!relaxation_.steady) state("F", F_);
  archive_strategy(state);
}

void StaggeredIteration::kick_and_drift(Coefficients coefficients, double k, double h, Vec u_new, Vec v_new) {
  const double beta = coefficients.beta, kick = coefficients.gamma * k;
  for_each_index(u_new.size(), [=, u = u_->span().data(), v = v_->span().data(), a = a_.span().data()](std::size_t i) {
    v_new[i] = beta * v[i] + kick * a[i];
    u_new[i] = u[i] + h * v_new[i];
  });
  if (!p_) return;
  for_each_index(u_new.size(), [=, p_new = next_p_->span().data(), p = p_->span().data(),
                                Q = Q_.span().data()](std::size_t i) { p_new[i] = beta * p[i] + kick * Q[i]; });
}

double StaggeredIteration::energy() {
  if (p_) return dot(*v_, *p_);
  system().mass().apply(v_->span(), Mx_.span());
  return dot(Mx_, *v_);
}

double StaggeredIteration::trial_energy(ConstVec v_new) {
  return p_ ? dot(*next_v_, *next_p_) : mass_norm_squared(v_new);
}

void StaggeredIteration::stop() {
  std::ranges::fill(v_->span(), 0.0);
  if (p_) std::ranges::fill(p_->span(), 0.0);
  last_step_ = 0;
}

// The estimate of c has no bound if the force has nothing to do with the motion, as when a support begins to move: c is
// at most 2 ω of the highest mode.
void StaggeredIteration::set_rate(double c, double h) {
  system().set_damping_rate(std::min(c, 4 / h));
  // Contact forces, and forces of a moving support through a consistent mass, depend on c.
  if (!system().system().contact() && system().system().mass().is_lumped()) return;
  system().last_out_of_balance(t_, Q_.span());
  system().mass().solve(Q_.span(), a_.span());
}

// The product goes to Mx_, as x may be work_.
double StaggeredIteration::mass_norm_squared(ConstVec x) {
  system().mass().apply(x, Mx_.span());
  std::ranges::copy(x, work_.span().begin());
  return dot(Mx_, work_);
}

}  // namespace stillpoint
