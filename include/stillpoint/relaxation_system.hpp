// Dynamic relaxation of R(u) = F as a first-order ODE [Więckowski 2011, eqs. 3 and 4]:
//   M a + C v = F(t) − R(u),   y = [u; v],   y' = [ v ; M⁻¹ (F − R − C v) ].
#pragma once

#include <stillpoint/damping.hpp>
#include <stillpoint/semi_discrete.hpp>
#include <stillpoint/state_archive.hpp>
#include <stillpoint/vector.hpp>

#include <functional>
#include <memory>
#include <optional>

namespace stillpoint {

class ForceScale;

/// What the last evaluation of a system left. Forces of contacts are not in it: they may change after it.
struct Evaluation {
  double t = 0;                       // [s]
  Vector F, R;                        // external and internal forces, (n) [N]
  std::unique_ptr<TrialState> trial;  // with the support reactions
};

/// The right-hand side for steppers. It is repeatable, allocates nothing and counts its evaluations. Norms of its
/// states: StateNorms.
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
  /// Evaluates no more than F and R at (t, u), for last(), and does not count it. False as above.
  bool evaluate(double t, ConstVec u);
  const Evaluation& last() const { return last_; }
  /// Lets the last evaluation take over forces that have changed at its state: change(R, trial), which changes R, (n),
  /// and the reactions.
  void change_last(const std::function<void(Vec R, TrialState& trial)>& change) {
    change(last_.R.span(), *last_.trial);
  }
  /// Q of the last evaluation as out_of_balance() gives it, at no cost, after contacts have opened or closed.
  void last_out_of_balance(double t, Vec Q) const;
  /// The same without the inertia of moving supports: what is out of balance at rest.
  void last_static_balance(Vec Q) const;
  /// The force [N] beside which that is small: ‖F‖ of the last evaluation over the free degrees of freedom; if F = 0,
  /// the largest reactions or, without any, the largest internal force so far (ForceScale).
  double force_scale();
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

  /// Saves or restores what is kept of earlier evaluations.
  void archive(const StateArchive& state);

  /// Force evaluations made by steps.
  long evaluations() const { return evaluations_; }
  /// Adds the evaluations of a static solver, which evaluates system() itself.
  void count_evaluations(long count) { evaluations_ += count; }

 private:
  bool balance(double t, ConstVec u, Vec Q);
  bool is_sum_of_its_own() const;
  void add_local_damping(std::size_t begin, ConstVec v, Vec Q) const;

  SemiDiscrete& system_;
  const Damping& damping_;
  const Mass& mass_;
  LinearDamping linear_;
  VectorSpace vectors_;
  Evaluation last_;
  bool is_committed_ = false;     // whether last_.trial is committed
  std::optional<Vector> work_;    // of accept(), (n)
  std::optional<Vector> Q_last_;  // set by remember_force()
  bool force_remembered_ = false;
  bool loads_are_constant_, loads_are_known_ = false;
  std::optional<double> load_norm_;  // ‖F‖, if known [N]
  std::unique_ptr<ForceScale> force_scale_;
  long evaluations_ = 0;
};

}  // namespace stillpoint
