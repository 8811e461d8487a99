// The base of the static iterations: u ← u + α p for a direction p that leads downhill, Q·p > 0, with α by a line
// search.
//
// A step is a new iterate, v is 0, and a pseudo-time advances by the step given so that output rows and limits work as
// for marches. The load comes in increments (LoadIncrements): the out-of-balance force is
//
//   Q_s(u) = Q(u) − (1 − s) Q(u₀),   Q = F − R,   s from 0 at u₀, the state at the start, to 1
//
// Supports go the same share of their way: otherwise the cells beside them would be strained by all of it at once,
// which points remember. Material laws see one increment, from the state last committed to the equilibrium at the next
// s, which is then committed: the implicit increment of a static step. If the points have a history, an increment that
// the line search cannot follow, or that makes no progress in many times the steps of the first one, is begun again at
// half its size.
#pragma once

#include "solvers/integrators/trial_stepper.hpp"
#include "solvers/statics/line_search.hpp"
#include "solvers/statics/load_increments.hpp"
#include "solvers/statics/static_methods.hpp"
#include "solvers/statics/static_way.hpp"
#include "solvers/statics/without_time.hpp"

namespace stillpoint {

class StaticIteration : public WithoutTime<TrialStepper> {
 public:
  void take_changed_forces(double t) final { start(t, state()); }
  Known known() const final {
    return {.force = true, .acceleration = is_admissible() && load_.to() >= 1 ? z_.span() : ConstVec()};
  }
  std::optional<Way> way() const final;

 protected:
  /// Throws std::invalid_argument if the body has contact.
  StaticIteration(const StaticMethodOptions& options, RelaxationSystem& system, LineSearch::Accuracy sigma);

  /// Forgets the earlier steps of the method.
  virtual void forget() = 0;
  /// Called when Q() belongs to another load, at the same u.
  virtual void load_changed() { forget(); }
  /// Computes p from Q() and M⁻¹Q, (n); returns the α to try first.
  virtual double direction(Vec p) = 0;
  /// Called after the step α p: the force is Q(), the force before it last_Q().
  virtual void moved(double alpha) = 0;

  /// Archives what the method itself remembers.
  virtual void archive_method(const StateArchive& state) = 0;

  const Vector& Q() const { return Q_; }
  const Vector& z() const { return z_; }            // M⁻¹Q
  const Vector& last_Q() const { return next_Q_; }  // in moved() only
  const Vector& p() const { return p_; }
  /// An α that is safe along M⁻¹Q, 1/ω_max², from the step given [s²].
  double shortest() const { return options().max_step * options().max_step / 4; }

 private:
  bool begin(double t, const Vector& y) final;
  Attempt attempt(double t, Vector& y, double h, double t_stop, Vector& trial) final;
  void accepted() final;
  void archive_memory(const StateArchive& state) final;

  bool move_supports_on(double share);
  double share_of_supports() const { return supports_set_out_ ? load_.to() : 1; }
  bool evaluate(double t, ConstVec u, Vector& Q);
  void add_to(Vector& Q, double share) const;
  bool search(double t, Vec u_new);
  bool begin_increment(double t, double s, ConstVec u);
  void end_increment();
  bool makes_no_way() const;
  bool is_as_good_as_balanced() const;
  bool begin_half(double t, Vec u_new);
  std::string failure();

  LineSearch::Accuracy sigma_;
  double tolerance_;
  LoadIncrements load_;
  StaticWay way_;  // up to the beginning of the increment
  Vector Q_, z_, next_Q_, p_;
  Vector u_begin_, Q_begin_;  // u at the beginning of the increment; Q(u₀)
  double alpha_ = 0;
  double unbalanced_at_begin_ = 0;               // ‖Q_s‖ at the same place [N]
  long steps_of_first_ = 0, steps_of_this_ = 0;  // steps of the first increment (0 before its end) and of this one
  bool supports_set_out_ = false;                // they had gone none of their way when it began
  bool is_lost_ = false;                         // an increment could not be begun
  std::string refusal_;         // why the first state of this step's searches that could not be evaluated was refused
  bool went_downhill_ = false;  // the last attempt: neither was it in balance to the last bit, nor did it go back
};

}  // namespace stillpoint
