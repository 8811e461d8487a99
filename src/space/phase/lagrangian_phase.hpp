// A Lagrangian phase of the material point method: the grid moves with the material, weights are frozen at the material
// points' places when the phase began, and the unknown is the nodal displacement u since then.
//
//   f_p = I + Σ_i u_i ⊗ ∇N_ip,   R_i = Σ_p V_p P_p ∇N_ip,   F_i = Σ_p N_ip m_p b + tractions and point forces
//
// Where the scene asks for it a phase ends and the next begins: the points move on, the grid starts afresh.
#pragma once

#include <stillpoint/scene.hpp>
#include <stillpoint/semi_discrete.hpp>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "base/memory_report.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint {

/// What a rigid wall feels from the body: along its outward normal, and along the face's coordinate [N].
struct WallReaction {
  std::string name;
  double normal = 0, shear = 0;
  double power = 0;  // of the wall on the body [W]
};

/// How well masses and momenta went from the points to the grid and back, the worst so far.
struct TransferErrors {
  double mass = 0;        // |Σ_i m_i − Σ_p m_p(0)|/Σ_p m_p(0)
  double momentum = 0;    // of both directions, relative to Σ_p m_p |v_p|
  double added_mass = 0;  // mass that nodes were given so that none shortens the step, as a share of Σ_p m_p
};

/// The semi-discrete system of one phase, with what a user wants to see of its points. P points; arrays of values are
/// in the order in which the body was first filled, whatever the phase.
class LagrangianPhase : public SemiDiscrete {
 public:
  virtual int dim() const = 0;
  virtual int gradient_components() const = 0;  // of a displacement gradient (material.hpp)
  virtual int stress_components() const = 0;    // of a Cauchy stress
  virtual std::size_t points() const = 0;
  virtual std::vector<double> positions() const = 0;          // when the phase began, (P × dim) [m]
  virtual std::vector<double> initial_positions() const = 0;  // when the run began, likewise
  virtual std::vector<double> volumes() const = 0;            // V_p when the phase began, (P) [m³]
  virtual std::vector<int> materials() const = 0;             // number of each point's material, by name, (P)
  virtual double total_mass() const = 0;                      // Σ m_p [kg]

  /// Values at the points: displacement since the run began, (P × dim); velocity Σ_i N_ip v_i, (P × dim); strain
  /// ∂u/∂x since the phase began, (P × gradient_components); Cauchy stress, (P × stress_components) [Pa], where the law
  /// has a history as of the last commit.
  virtual void point_displacement(double t, ConstVec u, Vec out) const = 0;
  virtual void point_velocity(double t, ConstVec v, Vec out) const = 0;
  virtual void point_strain(double t, ConstVec u, Vec out) const = 0;
  virtual void point_stress(double t, ConstVec u, Vec out) const = 0;
  /// What laws remember beside the stress, by name ("plastic_strain"), (P); 0 where a point's law does not.
  virtual std::vector<std::string> history_names() const = 0;
  virtual void point_history(const std::string& name, Vec out) const = 0;

  /// u and v at time t that the scene's initial values project to, Σ_j M_ij u_j = Σ_p m_p N_ip u_0(x_p), (n).
  virtual std::vector<double> initial_displacement(double t) const = 0;
  virtual std::vector<double> initial_velocity(double t) = 0;

  /// Whether there will be more phases than this one.
  virtual bool updated_lagrangian() const = 0;
  /// How far the phase has come: 1 where it should end (phase.max_motion or phase.max_strain is reached).
  virtual double phase_progress(double t, ConstVec u) const = 0;
  /// Ends the phase at t with u and v, and begins the next, with other unknowns: size() and everything else may change.
  /// Returns v, (size()); u is 0. Throws PointLost.
  virtual std::vector<double> begin_next_phase(double t, ConstVec u, ConstVec v) = 0;
  virtual TransferErrors transfer_errors() const = 0;

  /// Of the last evaluation.
  virtual std::vector<WallReaction> wall_reactions(double t) const = 0;

  /// What is modelled, for `stillpoint check`.
  virtual std::vector<PointArray> point_arrays() const = 0;
  /// Of all of them together.
  double bytes_per_point() const {
    double total = 0;
    for (const PointArray& array : point_arrays()) total += array.bytes_per_point;
    return total;
  }
  virtual std::size_t supported_degrees_of_freedom() const = 0;
  virtual std::vector<int> grid_cells() const = 0;  // along each coordinate
  virtual std::size_t occupied_cells() const = 0;
  virtual QuadratureReport quadrature() const = 0;
  /// Whether K depends on u, so that frequencies change with it.
  virtual bool nonlinear() const = 0;
  /// Whether a point can become stiffer than it was, so that the critical step has to follow.
  virtual bool stiffens() const = 0;
  /// s with K(u) ≤ s K(0), the largest ratio of a point's modulus to the undeformed one: omega_max grows by √s at most.
  /// Infinite where u cannot be evaluated.
  virtual double stiffening(double t, ConstVec u) const = 0;
};

/// A material point has left the grid.
class PointLost : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Places the bodies, evaluates and freezes the weights, assembles the mass. The instantiation for the scene's
/// kinematics and basis is chosen here, once. Throws SceneError on what only shows now: a support where the basis does
/// not interpolate, a force where there is no material, a mass matrix that is not positive definite.
std::unique_ptr<LagrangianPhase> make_phase(const Scene& scene);

}  // namespace stillpoint
