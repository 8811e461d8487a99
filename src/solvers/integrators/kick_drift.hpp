// The kick and the drift of the staggered schemes, v⁺ = v + k a, u⁺ = u + h v⁺.
//
// If y = [u; p] with the momentum p = M v, of a mass of which only the inverse is known, the momentum is kicked as the
// velocity of a unit mass would be, p' = Q − c p, and v is kept beside it, v' = M⁻¹Q − c v: both obey the same
// recurrence, so that a step takes one product with M⁻¹.
#pragma once

#include <stillpoint/relaxation_system.hpp>
#include <stillpoint/state_archive.hpp>
#include <stillpoint/stepper.hpp>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "base/parallel_loop.hpp"

namespace stillpoint {

/// The velocity that belongs to a momentum, at the present state and at the trial of the next; (n) each.
class VelocityOfMomentum {
 public:
  VelocityOfMomentum(const Mass& mass, const VectorSpace& vectors)
      : v(vectors.make(mass.size())),
        next_v(vectors.make(mass.size())),
        b(vectors.make(mass.size())),
        next_b(vectors.make(mass.size())),
        a(vectors.make(mass.size())),
        next_a(vectors.make(mass.size())),
        mass_(mass) {}

  /// Begins at momentum p and force Q, (n) both; a is undamped as yet.
  void begin(ConstVec p, ConstVec Q) {
    mass_.solve(p, v.span());
    mass_.solve(Q, b.span());
    std::ranges::copy(std::as_const(b).span(), a.span().begin());
  }
  /// Takes the force Q at the trial, (n), into b and a, which is undamped as yet: the one product with M⁻¹ of a step.
  void take_force(ConstVec Q) {
    mass_.solve(Q, next_b.span());
    std::ranges::copy(std::as_const(next_b).span(), next_a.span().begin());
  }
  /// The trial becomes the state.
  void accept() {
    std::swap(v, next_v);
    std::swap(b, next_b);
    std::swap(a, next_a);
  }
  void archive(const StateArchive& state) {
    state("v", v.span());
    state("b", b.span());
    state("a_of_v", a.span());
  }

  Vector v, next_v;  // M⁻¹p [m/s]
  Vector b, next_b;  // M⁻¹Q of the force there [m/s²]
  Vector a, next_a;  // b less its damping: what the next kick takes [m/s²]

 private:
  const Mass& mass_;
};

class KickDrift {
 public:
  /// The system has to outlive this object.
  explicit KickDrift(const RelaxationSystem& system) : mass_(system.mass()) {
    if (!system.keeps_momentum()) return;
    unit_ = Mass::lumped(std::vector<double>(system.size(), 1.0));
    velocity_.emplace(mass_, system.vectors());
  }

  /// The mass by which Q is divided to give the a of the kick.
  const Mass& mass_of_kick() const { return unit_ ? *unit_ : mass_; }
  /// What is kept beside a momentum; null if y holds the velocity itself.
  VelocityOfMomentum* velocity() { return velocity_ ? &*velocity_ : nullptr; }
  /// What a stepper knows at its state. is_at_state: whether the last force evaluation was there.
  Stepper::Known known(bool is_at_state) const {
    Stepper::Known known{.force = is_at_state};
    if (velocity_) known.velocity = velocity_->v.span();
    if (velocity_ && is_at_state) known.acceleration = velocity_->b.span();
    return known;
  }

  /// The trial becomes the state.
  void accept() {
    if (velocity_) velocity_->accept();
  }
  void archive(const StateArchive& state) {
    if (velocity_) velocity_->archive(state);
  }

  /// Kicks v by k a into v_new and drifts u by h into u_new. v, v_new: velocities or momenta; all (n). With a momentum
  /// its velocity is kicked by k velocity()->a, into next_v.
  void operator()(double k, ConstVec a, double h, ConstVec u, ConstVec v, Vec u_new, Vec v_new) {
    if (velocity_) {
      for_each_index(u.size(), [=](std::size_t i) { v_new[i] = v[i] + k * a[i]; });
      a = velocity_->a.span();
      v = velocity_->v.span();
      v_new = velocity_->next_v.span();
    }
    for_each_index(u.size(), [=](std::size_t i) {
      v_new[i] = v[i] + k * a[i];
      u_new[i] = u[i] + h * v_new[i];
    });
  }

 private:
  const Mass& mass_;
  std::optional<Mass> unit_;
  std::optional<VelocityOfMomentum> velocity_;
};

}  // namespace stillpoint
