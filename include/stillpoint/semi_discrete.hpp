// The semi-discrete system M a + C v = F − R [Więckowski 2011, eq. 3], as the rest of the library sees it:
// discretised in space, continuous in time. LagrangianPhase is the one that MPM makes; a test may bring its own.
#pragma once

#include <stillpoint/damping.hpp>
#include <stillpoint/mass.hpp>
#include <stillpoint/types.hpp>

namespace stillpoint {

/// n free degrees of freedom. u: displacement since the phase began [m], forces in [N], t [s].
/// One virtual call does a whole evaluation, so none is inside a hot loop.
class SemiDiscrete {
 public:
  virtual ~SemiDiscrete() = default;

  virtual std::size_t size() const = 0;
  virtual const Mass& mass() const = 0;

  /// F_i = Σ_p N_ip m_p b(x_p, t) + tractions and point forces; F: (n).
  virtual void external_force(double t, Vec F) const = 0;
  /// R_i = Σ_p V_p P_p ∇N_ip from trial stresses; u, R: (n). Repeatable: the committed state is not touched.
  /// t places the moving supports. False where the trial cannot be evaluated (det f ≤ 0 or a non-finite stress).
  virtual bool internal_force(double t, ConstVec u, Vec R) const = 0;
  /// dR = K(u) du, the derivative of R at u along du; u, du, dR: (n). Where points remember it is consistent with what
  /// internal_force() does since the last commit.
  virtual void tangent(double t, ConstVec u, ConstVec du, Vec dR) const = 0;
  /// K(u) = ∂R/∂u assembled, (n × n). Unsymmetric where R has no potential.
  virtual SparseMatrix tangent_matrix(double t, ConstVec u) const = 0;
  /// The same of a body that does not yield, symmetric: frequencies and critical steps are those of K_e, since what
  /// yields only softens.
  virtual void elastic_tangent(double t, ConstVec u, ConstVec du, Vec dR) const { tangent(t, u, du, dR); }
  virtual SparseMatrix elastic_tangent_matrix(double t, ConstVec u) const { return tangent_matrix(t, u); }

  /// Accepts u: writes stress and history of every point. Once an accepted step where history_dependent().
  virtual void commit(double t, ConstVec u) = 0;
  /// The same for the state of the last internal_force(), at no cost.
  virtual void commit_last() {}
  /// Whether R(u) depends on what was committed, so that every accepted step has to commit.
  virtual bool history_dependent() const { return false; }

  /// Q −= M_fs (a_s(t) + c v_s(t)): what moving supports s do to the free degrees of freedom f. Nothing where none
  /// moves.
  virtual void add_support_inertia(double /*t*/, double /*c*/, Vec /*Q*/) const {}
  /// F += loads that follow the deformation; u, F: (n).
  virtual void add_following_force(double /*t*/, ConstVec /*u*/, Vec /*F*/) const {}
  /// ∂F/∂u of these at u, (n × n).
  virtual SparseMatrix following_tangent_matrix(double /*t*/, ConstVec /*u*/) const {
    const auto n = static_cast<Eigen::Index>(size());
    return SparseMatrix(n, n);
  }
  /// Whether something touches the body that may open or close.
  virtual bool has_contact() const { return false; }
  /// Q += contact forces for the damping C, Q: (n). What is closed only changes in update_contact().
  virtual void add_contact_force(double /*t*/, const LinearDamping& /*C*/, Vec /*Q*/) const {}
  /// Local damping, which acts on the sum of all other forces, must leave a closed contact to its wall: sets Q there as
  /// the last add_contact_force() did; Q: (n).
  virtual void hold_contact(Vec /*Q*/) const {}
  /// After an accepted step whose forces were the last ones evaluated: opens and closes contacts. True where v, (n),
  /// was changed by it.
  virtual bool update_contact(double /*t*/, ConstVec /*u*/, Vec /*v*/) { return false; }
  /// ‖reactions of the supports‖ at the last internal_force, the force scale where F = 0.
  virtual double reaction_norm() const { return 0; }
};

}  // namespace stillpoint
