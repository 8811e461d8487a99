#include <stillpoint/relaxation_system.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "base/parallel_loop.hpp"
#include "system/force_scale.hpp"

namespace stillpoint {

RelaxationSystem::RelaxationSystem(SemiDiscrete& system, const Damping& damping, const VectorSpace& vectors,
                                   const Mass* fictitious)
    : system_(system),
      damping_(damping),
      mass_(fictitious ? *fictitious : system.mass()),
      linear_(damping.linear()),
      vectors_(vectors),
      trial_(system.make_trial()),
      F_(vectors_.make(system.size())),
      R_(vectors_.make(system.size())),
      Q_(vectors_.make(system.size())),
      loads_are_constant_(system.loads_are_constant()),
      force_scale_(std::make_unique<ForceScale>()) {
  if (keeps_momentum() && (damping.is_local() || linear_.identity != 0)) {
    throw std::invalid_argument("a mass that is known by its inverse takes a damping of C = c M, or none");
  }
  if (damping.uses_last_force()) Q_last_ = vectors_.make(system.size());
}

RelaxationSystem::~RelaxationSystem() = default;

// y' = [ v ; M⁻¹ (F − R + D(v, F − R) − c_i v) − c_m v ]  for  C = c_m M + c_i I, or [ M⁻¹p ; F − R − c_m p ]
bool RelaxationSystem::operator()(double t, ConstVec y, Vec ydot) {
  const ConstVec u = first_half(y), v = second_half(y);
  const Vec u_dot = first_half(ydot), v_dot = second_half(ydot);
  const std::size_t n = u.size();

  if (!damped_out_of_balance(t, u, v, v_dot)) return false;
  if (linear_.identity != 0) {
    for_each_index(n, [=, c = linear_.identity](std::size_t i) { v_dot[i] -= c * v[i]; });
  }
  if (keeps_momentum()) {
    mass_.solve(v, u_dot);
  } else {
    mass_.solve(v_dot, v_dot);
    std::ranges::copy(v, u_dot.begin());
  }
  for_each_index(n, [=, c = linear_.mass](std::size_t i) { v_dot[i] -= c * v[i]; });
  return true;
}

bool RelaxationSystem::out_of_balance(double t, ConstVec u, Vec Q) {
  ++evaluations_;
  return balance(t, u, Q);
}

bool RelaxationSystem::out_of_balance(double t, ConstVec u, Vec Q, Vec a) {
  ++evaluations_;
  if (!mass_.is_diagonal() || !is_sum_of_its_own()) {
    if (!balance(t, u, Q)) return false;
    mass_.solve(Q, a);
    return true;
  }
  if (!evaluate(t, u)) return false;
  for_each_index(Q.size(), [=, F = F_.span().data(), R = R_.span().data(), m = mass_.diagonal().data()](std::size_t i) {
    Q[i] = F[i] - R[i];
    a[i] = Q[i] / m[i];
  });
  return true;
}

bool RelaxationSystem::damped_out_of_balance(double t, ConstVec u, ConstVec v, Vec Q) {
  ++evaluations_;
  if (!is_sum_of_its_own() || !damping_.goes_by_pieces()) {
    if (!balance(t, u, Q)) return false;
    add_local_damping(v, Q);
    return true;
  }
  if (!evaluate(t, u)) return false;
  for_each_piece(Q.size(), [=, this](std::size_t begin, std::size_t count) {
    const ConstVec F = F_.span().subspan(begin, count), R = R_.span().subspan(begin, count);
    const Vec piece = Q.subspan(begin, count);
    for_each_index(count, [=](std::size_t i) { piece[i] = F[i] - R[i]; });
    add_local_damping(begin, v.subspan(begin, count), piece);
  });
  return true;
}

// Whether Q = F − R holds at each degree of freedom by itself: no contact, and a lumped mass, which has no support
// inertia.
bool RelaxationSystem::is_sum_of_its_own() const { return system_.mass().is_lumped() && !system_.contact(); }

// Evaluates F and R.
bool RelaxationSystem::evaluate(double t, ConstVec u) {
  if (!std::exchange(loads_are_known_, loads_are_constant_)) {
    system_.external_force(t, u, F_.span());
    load_norm_.reset();
  }
  last_t_ = t;
  is_committed_ = false;
  return system_.internal_force(t, u, R_.span(), *trial_);
}

// Evaluates Q = F − R − M_fs (a_s + c_m v_s) + contact forces.
bool RelaxationSystem::balance(double t, ConstVec u, Vec Q) {
  if (!evaluate(t, u)) return false;
  last_out_of_balance(t, Q);
  return true;
}

void RelaxationSystem::last_out_of_balance(double t, Vec Q) const {
  const ConstVec F = F_.span(), R = R_.span();
  for_each_index(Q.size(), [=](std::size_t i) { Q[i] = F[i] - R[i]; });
  system_.add_support_inertia(t, linear_.mass, Q);
  if (const Contact* contact = system_.contact()) contact->add_force(t, linear_, Q);
}

std::string RelaxationSystem::refusal() const { return system_.diagnosis().refusal(*trial_); }

void RelaxationSystem::add_local_damping(ConstVec v, Vec Q) const {
  add_local_damping(0, v, Q);
  if (const Contact* contact = damping_.is_local() ? system_.contact() : nullptr) contact->hold(Q);
}

// v, Q: values at the degrees of freedom from `begin` on.
void RelaxationSystem::add_local_damping(std::size_t begin, ConstVec v, Vec Q) const {
  if (damping_.uses_last_force()) {
    // At the first evaluation dQ/dt is unknown.
    damping_.add_local_since(v, force_remembered_ ? Q_last_->span().subspan(begin, Q.size()) : Q, Q);
  } else if (damping_.is_local()) {
    damping_.add_local(v, Q);
  }
}

void RelaxationSystem::remember_force() {
  if (!Q_last_) return;
  last_out_of_balance(last_t_, Q_last_->span());
  force_remembered_ = true;
}

ContactChange RelaxationSystem::accept(double t, Vec y, bool force_is_current) {
  Contact* contact = system_.contact();
  if (!system_.history_dependent() && !contact) return ContactChange::nothing;
  const Vec u = first_half(y);
  if (!force_is_current && !balance(t, u, Q_.span())) throw std::logic_error("an accepted state cannot be evaluated");
  if (!std::exchange(is_committed_, true)) system_.commit(*trial_);
  return contact ? contact->update(t, u, second_half(y)) : ContactChange::nothing;
}

double RelaxationSystem::residual(double t, ConstVec u) {
  if (!balance(t, u, Q_.span())) return std::numeric_limits<double>::quiet_NaN();
  return last_residual();
}

double RelaxationSystem::last_residual() {
  const ConstVec F = F_.span(), R = R_.span();
  const Vec Q = Q_.span();
  for_each_index(Q.size(), [=](std::size_t i) { Q[i] = F[i] - R[i]; });
  if (const Contact* contact = system_.contact()) contact->add_force(last_t_, linear_, Q);
  return relative_to_loads(norm(Q_));
}

double RelaxationSystem::relative_to_loads(double unbalanced) {
  if (!load_norm_) load_norm_ = norm(F_);
  return relative(unbalanced, force_scale_->of(*load_norm_, R_, *trial_, system_.contact()));
}

// ‖M⁻¹Q‖_M² = Qᵀ M⁻¹ Q
double RelaxationSystem::energy_error(const Mass& M, double omega_1, ConstVec acceleration) {
  if (!work_) work_ = vectors_.make(size());
  if (acceleration.empty()) {
    M.solve(Q_.span(), work_->span());
  } else {
    std::ranges::copy(acceleration, work_->span().begin());
  }
  return std::sqrt(dot(Q_, *work_)) / omega_1;
}

double RelaxationSystem::mass_norm(const Mass& M, const Vector& u) {
  if (!work_) work_ = vectors_.make(size());
  M.apply(u.span(), work_->span());
  return std::sqrt(dot(u, *work_));
}

void RelaxationSystem::archive(const StateArchive& state) {
  state("rate", linear_.mass);
  state("F", F_.span());
  state("R", R_.span());
  state("Q", Q_.span());
  state("reactions", Vec(trial_->reactions));
  state("t", last_t_);
  state("force_remembered", force_remembered_);
  if (Q_last_) state("last_Q", Q_last_->span());
  state("evaluations", evaluations_);
  force_scale_->archive(state);
}

double RelaxationSystem::work_scale(const Vector& u) { return std::abs(dot(F_, u)) + std::abs(dot(R_, u)); }

double RelaxationSystem::internal_work(const Vector& u) const { return dot(R_, u); }

// Computes Q·v and ½ vᵀ M v, or Q·M⁻¹p and ½ pᵀ M⁻¹ p if the momentum is kept.
RelaxationSystem::Motion RelaxationSystem::motion(const Vector& v, const Vector& Q, ConstVec velocity) {
  if (!work_) work_ = vectors_.make(size());
  if (keeps_momentum()) {
    if (velocity.empty()) {
      mass_.solve(v.span(), work_->span());
    } else {
      std::ranges::copy(velocity, work_->span().begin());
    }
    return {.power = dot(Q, *work_), .kinetic_energy = 0.5 * dot(v, *work_)};
  }
  const double power = dot(Q, v);
  mass_.apply(v.span(), work_->span());
  return {.power = power, .kinetic_energy = 0.5 * dot(v, *work_) - mass_.relative_energy(v.span())};
}

}  // namespace stillpoint
