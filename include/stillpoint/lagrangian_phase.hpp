// One Lagrangian phase of the material point method: the grid moves with the material, weights are frozen at the
// material points' places when the phase began, and the unknown is the nodal displacement u since then.
//
//   f_p = I + Σ_i u_i ⊗ ∇N_ip,   R_i = Σ_p V_p P_p ∇N_ip,   F_i = Σ_p N_ip m_p b + tractions and point forces
#pragma once

#include <stillpoint/material_points.hpp>
#include <stillpoint/scene.hpp>
#include <stillpoint/semi_discrete.hpp>

#include <memory>
#include <string>
#include <vector>

namespace stillpoint {

/// An array that a phase keeps for its points.
struct PointArray {
  std::string name;
  double bytes_per_point;
};

/// The semi-discrete system of one phase, with what a user wants to see of its points. P points.
class LagrangianPhase : public SemiDiscrete {
 public:
  virtual int dim() const = 0;
  virtual std::size_t points() const = 0;
  virtual std::vector<double> place(std::size_t p) const = 0;  // (dim) [m]
  virtual ConstVec volumes() const = 0;                        // V_p, (P) [m³]
  virtual double total_mass() const = 0;                       // Σ m_p [kg]

  /// Values at the points: displacement and velocity Σ_i N_ip u_i, (P × dim); strain ∂u/∂x, (P × dim²).
  virtual void point_displacement(double t, ConstVec u, Vec out) const = 0;
  virtual void point_velocity(double t, ConstVec v, Vec out) const = 0;
  virtual void point_strain(double t, ConstVec u, Vec out) const = 0;
  /// Cauchy stress as of the last commit, (P × dim²) [Pa].
  virtual ConstVec point_stress() const = 0;

  /// u and v at time t that the scene's initial values project to, Σ_j M_ij u_j = Σ_p m_p N_ip u_0(x_p), (n).
  virtual std::vector<double> initial_displacement(double t) const = 0;
  virtual std::vector<double> initial_velocity(double t) const = 0;

  /// What is modelled, for `stillpoint check`.
  virtual std::vector<PointArray> point_arrays() const = 0;
  virtual std::size_t supported_degrees_of_freedom() const = 0;
  virtual std::size_t occupied_cells() const = 0;
  virtual QuadratureReport quadrature() const = 0;
  /// Whether K depends on u, so that frequencies and the critical step change with it.
  virtual bool nonlinear() const = 0;
  /// s with K(u) ≤ s K(0), the largest ratio of a point's modulus to the undeformed one: omega_max grows by √s at most.
  /// Infinite where u cannot be evaluated.
  virtual double stiffening(double t, ConstVec u) const = 0;
};

/// Places the body, evaluates and freezes the weights, assembles the mass. The instantiation for the scene's dimension,
/// basis and law is chosen here, once. Throws SceneError on what only shows now: a support where the basis does not
/// interpolate, a force where there is no material, a mass matrix that is not positive definite.
std::unique_ptr<LagrangianPhase> make_phase(const Scene& scene);

}  // namespace stillpoint
