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

/// The right-hand side for integrators. It is repeatable, allocates nothing and counts its evaluations.
class RelaxationSystem {
 public:
  /// All arguments must outlive this object. fictitious: a mass for the motion towards an equilibrium that does not
  /// depend on mass; null: the system's mass. Throws std::invalid_argument if the mass is known by its inverse alone
  /// and the damping is not C = c M.
  RelaxationSystem(SemiDiscrete& system, const Damping& damping, const VectorSpace& vectors = {},
                   const Mass* fictitious = nullptr);
  ~RelaxationSystem();

  std::size_t size() const { return system_.size(); }  // n: free degrees of freedom
  SemiDiscrete& system() { return system_; }
  const SemiDiscrete& system() const { return system_; }
  const Damping& damping() const { return damping_; }
  const VectorSpace& vectors() const { return vectors_; }
  const Mass& mass() const { return mass_; }
  /// Whether y = [u; p] with the momentum p = M v, for a mass that is known by its inverse: u' = M⁻¹p, p' = Q − c p.
  bool keeps_momentum() const { return !mass_.has_product(); }

  /// ydot = f(t, y); y, ydot: (2n). False if the trial y cannot be evaluated: retry with a smaller step.
  bool operator()(double t, ConstVec y, Vec ydot);
  /// Q = F(t) − R(u) + contact forces (− inertia of moving supports), damping left out; u, Q: (n). False as above.
  bool out_of_balance(double t, ConstVec u, Vec Q);
  /// As above, with a = M⁻¹Q, (n), in the same pass over memory where possible.
  bool out_of_balance(double t, ConstVec u, Vec Q, Vec a);
  /// Q = F(t) − R(u) + D(v, F − R), with local damping, in one pass over memory where possible; u, v, Q: (n).
  bool damped_out_of_balance(double t, ConstVec u, ConstVec v, Vec Q);
  /// Q of the last evaluation as out_of_balance() gives it, at no cost, after contacts have opened or closed.
  void last_out_of_balance(double t, Vec Q) const;
  /// The reason why the last evaluation was refused, and the place.
  std::string refusal() const;
  bool went_too_far() const { return trial_->too_far; }
  /// Q += D(v, Q) of local damping, except where a contact holds; v, Q: (n), Q as from out_of_balance().
  void add_local_damping(ConstVec v, Vec Q) const;

  /// Keeps Q of the last evaluation as that of an accepted step, for local damping that uses the sign of dQ/dt.
  void remember_force();
  void forget_force() { force_remembered_ = false; }
  /// Sets the c of C = c M that moving supports and walls use [1/s], for a strategy that adapts it.
  void set_damping_rate(double c) { linear_.mass = c; }

  /// Commits an accepted step to (t, y), y: (2n): laws update their history, contacts open and close. force_is_current:
  /// whether the last evaluation was at (t, y). Returns what contacts changed in y.
  ContactChange accept(double t, Vec y, bool force_is_current);

  /// The relative residual ‖F − R‖/‖F‖ over the free degrees of freedom; if F = 0, relative to the largest reactions
  /// or, without any, to the largest internal force so far (ForceScale). 0 if there is no load.
  double residual(double t, ConstVec u);
  /// The relative residual of the last evaluation, at no cost, for integrators that end a step with one
  /// (force_is_current()).
  double last_residual();
  /// The relative residual of the last evaluation, whose ‖F − R‖ is known already [N].
  double relative_to_loads(double unbalanced);
  /// The error bound ‖M⁻¹Q‖_M/ω₁ with Q of the last residual() [√J]: in a linear system it is no less than ‖u − u*‖_K,
  /// since u − u* = −K⁻¹Q and no eigenvalue of M⁻¹K is below ω₁². M: the system's mass, or any other with its own ω₁.
  /// acceleration: M⁻¹Q, (n), if it is known; else empty.
  double energy_error(const Mass& M, double omega_1, ConstVec acceleration = {});
  /// ‖u‖_M [m √kg]; u: (n).
  double mass_norm(const Mass& M, const Vector& u);
  /// |F·u| + |R·u| of the last evaluation [J], the scale of the work done; u: (n).
  double work_scale(const Vector& u);
  /// R·u of the last evaluation [J]; u: (n).
  double internal_work(const Vector& u) const;
  /// Q·v [W]; v: the second half of y, Q: (n).
  double power(const Vector& v, const Vector& Q) { return keeps_momentum() ? motion(v, Q, {}).power : dot(Q, v); }
  struct Motion {
    double power;           // Q·v [W]
    double kinetic_energy;  // ½ vᵀ M v [J], without what was added to light nodes
  };
  /// Power and kinetic energy with the Q of the last residual(); v: the second half of y, (n). If that is the momentum
  /// p, takes one product with M⁻¹, or none if the velocity M⁻¹p, (n), is given.
  Motion motion(const Vector& v, ConstVec velocity = {}) { return motion(v, Q_, velocity); }
  /// F of the last evaluation, (n) [N].
  ConstVec last_external_force() const { return F_.span(); }
  double last_t() const { return last_t_; }
  /// Support reactions of the last evaluation [N], as in TrialState.
  ConstVec last_reactions() const { return trial_->reactions; }

  /// Saves or restores what is kept of earlier evaluations.
  void archive(const StateArchive& state);

  /// Force evaluations made by integrators (not by residual()).
  long evaluations() const { return evaluations_; }
  /// Adds the evaluations of a static solver, which evaluates system() itself.
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
  std::unique_ptr<TrialState> trial_;  // results of the last evaluation
  bool is_committed_ = false;          // whether trial_ is committed
  Vector F_, R_, Q_;
  std::optional<Vector> Q_last_;  // set by remember_force()
  bool force_remembered_ = false;
  std::optional<Vector> work_;  // work array of the norms, (n)
  double last_t_ = 0;
  bool loads_are_constant_, loads_are_known_ = false;
  std::optional<double> load_norm_;          // ‖F‖, if known [N]
  std::unique_ptr<ForceScale> force_scale_;  // for residual() and last_residual()
  long evaluations_ = 0;
};

}  // namespace stillpoint
