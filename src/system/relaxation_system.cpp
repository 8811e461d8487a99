#include <stillpoint/relaxation_system.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/parallel_loop.hpp"
#include "system/force_scale.hpp"

namespace stillpoint {
namespace {

// Q = F − R
void take_difference(const Evaluation& of, Vec Q) {
  for_each_index(Q.size(), [=, F = of.F.span().data(), R = of.R.span().data()](std::size_t i) { Q[i] = F[i] - R[i]; });
}

}  // namespace

RelaxationSystem::RelaxationSystem(SemiDiscrete& system, const Damping& damping, const VectorSpace& vectors,
                                   const Mass* fictitious)
    : system_(system),
      damping_(damping),
      mass_(fictitious ? *fictitious : system.mass()),
      linear_(damping.linear()),
      vectors_(vectors),
      last_{.F = vectors_.make(system.size()), .R = vectors_.make(system.size()), .trial = system.make_trial()},
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
  for_each_index(Q.size(),
                 [=, F = last_.F.span().data(), R = last_.R.span().data(), m = mass_.diagonal().data()](std::size_t i) {
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
    const ConstVec F = last_.F.span().subspan(begin, count), R = last_.R.span().subspan(begin, count);
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
    system_.external_force(t, u, last_.F.span());
    load_norm_.reset();
  }
  last_.t = t;
  const bool good = system_.internal_force(t, u, last_.R.span(), *last_.trial);
  is_committed_ = !good;  // what cannot be evaluated is never committed
  return good;
}

// Evaluates Q = F − R − M_fs (a_s + c_m v_s) + contact forces.
bool RelaxationSystem::balance(double t, ConstVec u, Vec Q) {
  if (!evaluate(t, u)) return false;
  last_out_of_balance(t, Q);
  return true;
}

void RelaxationSystem::last_out_of_balance(double t, Vec Q) const {
  take_difference(last_, Q);
  system_.add_support_inertia(t, linear_.mass, Q);
  if (const Contact* contact = system_.contact()) contact->add_force(t, linear_, Q);
}

void RelaxationSystem::last_static_balance(Vec Q) const {
  take_difference(last_, Q);
  if (const Contact* contact = system_.contact()) contact->add_force(last_.t, linear_, Q);
}

double RelaxationSystem::force_scale() {
  if (!load_norm_) load_norm_ = norm(last_.F);
  return force_scale_->of(*load_norm_, last_.R, *last_.trial, system_.contact());
}

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
  last_out_of_balance(last_.t, Q_last_->span());
  force_remembered_ = true;
}

ContactChange RelaxationSystem::accept(double t, Vec y, bool force_is_current) {
  Contact* contact = system_.contact();
  if (!system_.history_dependent() && !contact) return ContactChange::nothing;
  const Vec u = first_half(y);
  if (!force_is_current) {  // contacts read the forces in Q as well
    if (!work_) work_ = vectors_.make(size());
    if (!balance(t, u, work_->span())) throw std::logic_error("an accepted state cannot be evaluated");
  }
  if (!std::exchange(is_committed_, true)) system_.commit(*last_.trial);
  return contact ? contact->update(t, u, second_half(y)) : ContactChange::nothing;
}

void RelaxationSystem::archive(const StateArchive& state) {
  state("rate", linear_.mass);
  state("F", last_.F.span());
  state("R", last_.R.span());
  state("reactions", Vec(last_.trial->reactions));
  state("t", last_.t);
  state("force_remembered", force_remembered_);
  if (Q_last_) state("last_Q", Q_last_->span());
  state("evaluations", evaluations_);
  force_scale_->archive(state);
}

}  // namespace stillpoint
