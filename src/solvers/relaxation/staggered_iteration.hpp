// The base of the dynamic strategies: one force evaluation a step, in leapfrog's staggered form with variable
// coefficients,
//
//   v⁺ = β v⁻ + γ k M⁻¹Q(u_n),   u_{n+1} = u_n + h v⁺,   v⁻ at t_n − h⁻/2,  v⁺ at t_n + h/2,  k = (h⁻ + h)/2.
//
// A start from a velocity that is known at t_n has h⁻ = 0, which gives half a kick, as in leapfrog's first step. With
//
//   β = (1 − c k/2)/(1 + c k/2),   γ = 1/(1 + c k/2)
//
// this is leapfrog with C = c M: the same displacements as its synchronised form. It is also the heavy ball
// [Polyak 1964]: u_{n+1} = u_n + β (u_n − u_{n−1}) + γ h² M⁻¹Q. The second half of y is v⁺, half a step behind u. A
// step ends with the force at its end.
//
// If y = [u; p] with the momentum p = M v, of a mass of which only the inverse is known, v is kept beside y: both obey
// the same recurrence, p⁺ = β p⁻ + γ k Q, so that no step takes more than one product with M⁻¹, and vᵀMv = v·p.
#pragma once

#include <stillpoint/relaxation.hpp>

#include <vector>

#include "solvers/integrators/march.hpp"

namespace stillpoint {

class StaggeredIteration : public March {
 public:
  Known known() const override;
  CarriedOver carried_over() const final {
    return {.last_step = last_step_, .rate = rate(), .step_share = step_share()};
  }

 protected:
  StaggeredIteration(const RelaxationOptions& options, RelaxationSystem& system);

  struct Coefficients {
    double beta, gamma;
  };
  /// β and γ of leapfrog with C = c M, for the kick k.
  static Coefficients leapfrog(double c, double k) { return {(1 - c * k / 2) / (1 + c * k / 2), 1 / (1 + c * k / 2)}; }

  /// Writes the trial of a step h from the present state to u_new and v_new, (n). Has to be repeatable: a trial that
  /// cannot be evaluated is made again with a shorter step. If the momentum is kept, v_new has to be that of
  /// kick_and_drift(), unless moved() calls stop().
  virtual void propose(double h, Vec u_new, Vec v_new) = 0;
  /// Whether the step leaves v unchanged, so that propose() does not write v_new.
  virtual bool keeps_v() const { return false; }
  /// Called after the trial could be evaluated; Q, a: values there. Says whether the trial is finite if that costs
  /// nothing.
  virtual std::optional<bool> tried(const Vector& /*Q*/, const Vector& /*a*/) { return std::nullopt; }
  /// Called after the trial has become the state: the force there is Q(), the force before the step last_Q().
  virtual void moved(double h) = 0;
  /// Begins afresh from the state, or after a contact has changed its v.
  virtual void on_restart() {}

  /// Archives what the strategy itself remembers.
  virtual void archive_strategy(const StateArchive& /*state*/) {}

  /// The damping c [1/s] that the strategy has found so far, if it determines one.
  virtual std::optional<double> rate() const { return std::nullopt; }
  /// The share of the step given that the strategy takes, if it chooses one, else 0.
  virtual double step_share() const { return 0; }

  /// Writes v⁺ = β v⁻ + γ k M⁻¹Q and u⁺ = u + h v⁺.
  void kick_and_drift(Coefficients coefficients, double k, double h, Vec u_new, Vec v_new);
  double kick(double h) const { return (last_step_ + h) / 2; }  // kick length k [s]
  /// vᵀMv of the state, and of a trial that kick_and_drift() has made.
  double energy();
  double trial_energy(ConstVec v_new);
  /// Sets v = 0, so that the next step is half a kick.
  void stop();
  /// Sets the damping rate c [1/s] in force; moving supports and walls use it.
  void set_rate(double c, double h);

  // The present state, (n) each; valid from on_restart() on.
  Vector& u() { return *u_; }
  Vector& v() { return *v_; }
  const Vector& Q() const { return Q_; }            // out-of-balance force [N]
  const Vector& a() const { return a_; }            // M⁻¹Q [m/s²]
  const Vector& last_Q() const { return next_Q_; }  // force before the step, under the present loads; in moved() only
  double last_step() const { return last_step_; }   // h⁻
  /// xᵀMx; x: (n). Not available if the momentum is kept: only the inverse of M is known then.
  double mass_norm_squared(ConstVec x);
  /// Temporary work space, (n): mass_norm_squared() writes to it as well.
  Vector& work() { return work_; }
  double t() const { return t_; }
  const RelaxationOptions& relaxation() const { return relaxation_; }

 private:
  bool begin(double t, const Vector& y) final;
  bool restart(double t, const Vector& y) final;
  bool evaluate_anew(double t, const Vector& y) final;
  Attempt attempt(double t, Vector& y, double h, double t_stop, Vector& trial) final;
  void accepted() final;
  void archive_memory(const StateArchive& state) final;
  void remember_loads();

  RelaxationOptions relaxation_;
  std::optional<Vector> u_, v_;                // the halves of y, in place; with momentum v_ is apart from y
  std::optional<Vector> p_, next_p_, next_v_;  // with momentum: second halves of y and of the trial; the trial's v
  Vector Q_, a_, next_Q_, next_a_, Mx_, work_;
  std::vector<double> F_;  // the loads in Q_, if they depend on t [N]
  double t_ = 0, trial_t_ = 0;
  double last_step_ = 0, trial_step_ = 0;
};

}  // namespace stillpoint
