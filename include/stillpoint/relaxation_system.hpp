// Dynamic relaxation of R(u) = F as a first-order ODE [Więckowski 2011, eqs. 3 and 4]:
//   M a + C v = F(t) − R(u),   y = [u; v],   y' = [ v ; M⁻¹ (F − R − C v) ].
#pragma once

#include <stillpoint/damping.hpp>
#include <stillpoint/semi_discrete.hpp>
#include <stillpoint/state_archive.hpp>
#include <stillpoint/vector.hpp>

#include <memory>
#include <optional>
#include <string>

namespace stillpoint {

class ForceScale;

/// The right-hand side that integrators see. Repeatable, allocates nothing, counts its evaluations.
class RelaxationSystem {
 public:
  /// All outlive this object. fictitious: the mass of the motion, on the way to an equilibrium that no mass has a part
  /// in; null: that of the system. Throws std::invalid_argument if it is known by its inverse alone and the damping is
  /// not C = c M.
  RelaxationSystem(SemiDiscrete& system, const Damping& damping, const VectorSpace& vectors = {},
                   const Mass* fictitious = nullptr);
  ~RelaxationSystem();

  std::size_t size() const { return system_.size(); }  // n: free degrees of freedom
  SemiDiscrete& system() { return system_; }
  const SemiDiscrete& system() const { return system_; }
  const Damping& damping() const { return damping_; }
  const VectorSpace& vectors() const { return vectors_; }
  const Mass& mass() const { return mass_; }
  /// Whether y = [u; p] with the momentum p = M v, of a mass that is known by its inverse: u' = M⁻¹p, p' = Q − c p.
  bool keeps_momentum() const { return !mass_.has_product(); }

  /// ydot = f(t, y); y, ydot: (2n). False if the trial y cannot be evaluated: retry with a smaller step.
  bool operator()(double t, ConstVec y, Vec ydot);
  /// Q = F(t) − R(u) + contact forces (− inertia of moving supports), damping left out; u, Q: (n). False as above.
  bool out_of_balance(double t, ConstVec u, Vec Q);
  /// And a = M⁻¹Q, (n), in the same pass over memory where it can be.
  bool out_of_balance(double t, ConstVec u, Vec Q, Vec a);
  /// Q = F(t) − R(u) + D(v, F − R), with local damping, in one pass over memory where it can be; u, v, Q: (n).
  bool damped_out_of_balance(double t, ConstVec u, ConstVec v, Vec Q);
  /// The same as out_of_balance() from the last evaluation, at no cost, after contacts have opened or closed.
  void last_out_of_balance(double t, Vec Q) const;
  /// Why the last evaluation was refused, and where.
  std::string refusal() const;
  bool went_too_far() const { return trial_->too_far; }
  /// Q += D(v, Q) of local damping, except if a contact holds; v, Q: (n), Q as the two above leave it.
  void add_local_damping(ConstVec v, Vec Q) const;

  /// Q of the last evaluation is that of an accepted step: for local damping by the sign of dQ/dt.
  void remember_force();
  void forget_force() { force_remembered_ = false; }
  /// The c of C = c M from now on, if a strategy finds it on the way: what moving supports and walls see [1/s].
  void set_damping_rate(double c) { linear_.mass = c; }

  /// After an accepted step to (t, y), y: (2n): laws remember, contacts open and close. force_is_current: whether the
  /// last evaluation was there. What contacts changed in y.
  ContactChange accept(double t, Vec y, bool force_is_current);

  /// ‖F − R‖/‖F‖ over the free degrees of freedom; if F = 0 over the largest reactions or, without any, the largest
  /// internal force so far (ForceScale). 0 if there is no load.
  double residual(double t, ConstVec u);
  /// The same from the last evaluation, at no cost, for integrators that end a step with one (force_is_current()).
  double last_residual();
  /// The same of the last evaluation, whose ‖F − R‖ is known already [N].
  double relative_to_loads(double unbalanced);
  /// ‖M⁻¹Q‖_M/ω₁ with Q of the last residual() [√J]: in a linear system no less than ‖u − u*‖_K, since u − u* = −K⁻¹Q
  /// and no eigenvalue of M⁻¹K is below ω₁². M: that of the system, or any other with its own ω₁. acceleration: M⁻¹Q,
  /// (n), if it is known; else empty.
  double energy_error(const Mass& M, double omega_1, ConstVec acceleration = {});
  /// ‖u‖_M [m √kg]; u: (n).
  double mass_norm(const Mass& M, const Vector& u);
  /// |F·u| + |R·u| of the last evaluation [J], the scale of the work that is done; u: (n).
  double work_scale(const Vector& u);
  /// R·u of the last evaluation [J]; u: (n).
  double internal_work(const Vector& u) const;
  /// Q·v [W]; v: the second half of y, Q: (n).
  double power(const Vector& v, const Vector& Q) { return keeps_momentum() ? motion(v, Q, {}).power : dot(Q, v); }
  struct Motion {
    double power;           // Q·v [W]
    double kinetic_energy;  // ½ vᵀ M v [J], without what was added to light nodes
  };
  /// With the Q of the last residual(); v: the second half of y, (n). If v is p, by one M⁻¹, or by the velocity M⁻¹p,
  /// (n), if it is known.
  Motion motion(const Vector& v, ConstVec velocity = {}) { return motion(v, Q_, velocity); }
  /// F of the last evaluation, (n) [N].
  ConstVec last_external_force() const { return F_.span(); }
  double last_t() const { return last_t_; }
  /// Reactions of the supports of the last evaluation [N], as in TrialState.
  ConstVec last_reactions() const { return trial_->reactions; }

  /// Saves what is kept of earlier evaluations, or restores it.
  void archive(const StateArchive& state);

  /// Force evaluations made by integrators (not by residual()).
  long evaluations() const { return evaluations_; }
  /// Those of a static solver, which evaluates system() itself.
  void count_evaluations(long count) { evaluations_ += count; }

 private:
  Motion motion(const Vector& v, const Vector& Q, ConstVec velocity);
  bool evaluate(double t, ConstVec u);
  bool balance(double t, ConstVec u, Vec Q);
  bool is_sum_of_its_own() const;
  void add_local_damping(std::size_t begin, ConstVec v, Vec Q) const;

  SemiDiscrete& system_;
  const Damping& damping_;
  const Mass& mass_;
  LinearDamping linear_;
  VectorSpace vectors_;
  std::unique_ptr<TrialState> trial_;  // of the last evaluation
  bool is_committed_ = false;          // it
  Vector F_, R_, Q_;
  std::optional<Vector> Q_last_;  // of remember_force()
  bool force_remembered_ = false;
  std::optional<Vector> work_;  // of norms, (n)
  double last_t_ = 0;
  bool loads_are_constant_, loads_are_known_ = false;
  std::optional<double> load_norm_;          // ‖F‖, if known [N]
  std::unique_ptr<ForceScale> force_scale_;  // of residual() and last_residual()
  long evaluations_ = 0;
};

}  // namespace stillpoint
