// The semi-discrete system M a + C v = F − R [Więckowski 2011, eq. 3], as the rest of the library sees it:
// discretised in space, continuous in time. LagrangianPhase is the one that MPM makes; a test may bring its own.
#pragma once

#include <stillpoint/damping.hpp>
#include <stillpoint/mass.hpp>
#include <stillpoint/place_in_body.hpp>
#include <stillpoint/types.hpp>

#include <memory>
#include <string>
#include <vector>

namespace stillpoint {

/// The result of an evaluation of R(u), which the system does not keep: made by make_trial(), filled by
/// internal_force(), accepted by commit(). A system derives from it to add the history of its points.
class TrialState {
 public:
  virtual ~TrialState() = default;

  double t = 0;                   // time of the evaluation [s]
  bool too_far = false;           // refused as a motion too far for one phase, though each point could be evaluated
  std::vector<double> reactions;  // support reactions: R at the prescribed degrees of freedom, then forces of springs
                                  // [N]
};

/// consistent: the derivative of R(u). elastic: as if no point yielded, symmetric; frequencies and critical steps are
/// those of K_e, since yielding only softens. stable: K_e without the directions in which stresses make a point
/// unstable, positive semi-definite unless the dilatation is averaged: for a fictitious inertia, by matrix() alone.
/// stiffest: K_e with all contacts closed that may close, at least as large as K_e whichever do: for critical steps.
enum class Tangent { consistent, elastic, stable, stiffest };

/// The tangent stiffness K(u) = ∂R/∂u of internal_force() since the last commit, at t.
class Tangents {
 public:
  virtual ~Tangents() = default;
  /// dR = K(u) du; u, du, dR: (n).
  virtual void apply(Tangent kind, double t, ConstVec u, ConstVec du, Vec dR) const = 0;
  /// K(u) assembled, (n × n). The consistent one is unsymmetric if R has no potential.
  virtual SparseMatrix matrix(Tangent kind, double t, ConstVec u) const = 0;
  /// The consistent K(u), but with the stresses that K(from) predicts at u in the place of the law's, where the system
  /// can tell them apart; from: (n). For Newton's method, whose long steps stretch what they are to bend.
  virtual SparseMatrix matrix_ahead(double t, ConstVec u, ConstVec from) const;
  /// ∂F/∂u of the loads that follow u, (n × n); without entries if no load does.
  virtual SparseMatrix of_loads(double t, ConstVec u) const;
};

/// The quantities that an opening or closing contact changed: velocities, or displacements too where it corrected a
/// penetration.
enum class ContactChange { nothing, velocity, displacement };

/// Unilateral contact of the body. Contacts open and close only in update(), between accepted steps, so that within a
/// step the motion stays a smooth ODE.
class Contact {
 public:
  virtual ~Contact() = default;
  /// Q += contact forces, with the damping C; Q: (n).
  virtual void add_force(double t, const LinearDamping& C, Vec Q) const = 0;
  /// Overwrites Q at closed contacts with the values that the last add_force() set, since local damping acts on the sum
  /// of all other forces and must not act on a closed contact; Q: (n).
  virtual void hold(Vec Q) const = 0;
  /// Called after an accepted step whose forces were the last ones evaluated: opens and closes contacts, and corrects
  /// penetrations; u, v: (n).
  virtual ContactChange update(double t, Vec u, Vec v) = 0;
  /// Whether the obstacles are where they are to be, and no longer on their way.
  virtual bool is_settled() const { return true; }
  /// Returns sum + Σ (contact forces)² of the last add_force() [N²].
  virtual double squared_forces(double sum) const = 0;
};

/// Explains a failure. It may cost passes over all points, so only a run that ends calls it.
class Diagnosis {
 public:
  virtual ~Diagnosis() = default;
  /// The reason why internal_force() refused the trial: which quantity, where, and what to try.
  virtual std::string refusal(TrialState& trial) const;
  /// The place of free degree of freedom k.
  virtual PlaceInBody of_unknown(std::size_t k) const;
};

/// A semi-discrete system with n free degrees of freedom. u: displacement since the phase began [m], forces in [N], t
/// [s].
/// One virtual call does a whole evaluation, so none is inside a hot loop.
class SemiDiscrete {
 public:
  virtual ~SemiDiscrete() = default;

  virtual const Mass& mass() const = 0;
  std::size_t size() const { return mass().size(); }

  /// F_i = Σ_p N_ip m_p b(x_p, t) + tractions and point forces, including those that follow the deformation; u, F: (n).
  virtual void external_force(double t, ConstVec u, Vec F) const = 0;
  virtual std::unique_ptr<TrialState> make_trial() const { return std::make_unique<TrialState>(); }
  /// R_i = Σ_p V_p P_p ∇N_ip from trial stresses; u, R: (n). Repeatable: the committed state is not touched.
  /// t places the moving supports. trial: made by this system for this phase; its last contents do not matter.
  /// False if the trial cannot be evaluated (det f ≤ 0, a non-finite stress, a motion too far for one phase).
  virtual bool internal_force(double t, ConstVec u, Vec R, TrialState& trial) const = 0;
  /// For static solvers, which divide a load: moves supports on a share of their way since the phase began, from then
  /// on; all of it at first. True if some support has a way to go.
  virtual bool move_supports_on(double /*share*/) { return false; }
  /// Accepts the state that internal_force() has put into the trial: the trial histories of the points become the
  /// committed ones. Called once an accepted step if history_dependent(); throws std::logic_error if the trial is not
  /// of this phase, or not evaluated since the last commit.
  virtual void commit(TrialState& /*trial*/) {}
  virtual const Tangents& tangents() const = 0;
  virtual const Diagnosis& diagnosis() const;

  /// Q −= M_fs (a_s(t) + c v_s(t)), the inertia and damping forces of moving supports s on the free degrees of freedom
  /// f; no change if no support moves.
  virtual void add_support_inertia(double /*t*/, double /*c*/, Vec /*Q*/) const {}

  /// Whether F is the same at every t and u.
  bool loads_are_constant() const { return loads_are_constant_; }
  /// Whether R(u) depends on the committed state, so that every accepted step has to commit.
  bool history_dependent() const { return history_dependent_; }
  /// Null if nothing touches the body.
  const Contact* contact() const { return contact_; }
  Contact* contact() { return contact_; }

 protected:
  bool loads_are_constant_ = false, history_dependent_ = false;
  Contact* contact_ = nullptr;
};

}  // namespace stillpoint
