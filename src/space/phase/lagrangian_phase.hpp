// A Lagrangian phase of the material point method: the grid moves with the material, weights are frozen at the material
// points' positions when the phase began, and the unknown is the nodal displacement u since then.
//
//   f_p = I + Σ_i u_i ⊗ ∇N_ip,   R_i = Σ_p V_p P_p ∇N_ip,   F_i = Σ_p N_ip m_p b + tractions and point forces
//
// If the scene asks for it, a phase ends and the next begins: the points move on, and the grid is reset.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/semi_discrete.hpp>
#include <stillpoint/state_archive.hpp>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/memory_report.hpp"
#include "linalg/nodal_layout.hpp"
#include "parallel/ranks.hpp"
#include "space/boundary/condition_reports.hpp"
#include "space/phase/place_reader.hpp"
#include "space/points/carried_points.hpp"
#include "space/points/material_points.hpp"

namespace stillpoint {

/// The properties that all phases of a body share.
struct PhaseInfo {
  int dim = 0;
  int gradient_components = 0;  // number in a displacement gradient (material.hpp)
  int stress_components = 0;    // number in a Cauchy stress
  std::size_t points = 0;
  double total_mass = 0;                // Σ m_p [kg]
  std::vector<std::string> law_fields;  // of the laws' histories, beside the stress ("plastic_strain"), or of water
  bool updated_lagrangian = false;      // whether there will be further phases
  bool remembers = false;               // whether some law has a history
  bool nonlinear = false;               // whether K depends on u, so that frequencies change with it
  bool may_touch = false;               // whether rigid or other bodies may touch a body
  bool stiffens = false;  // whether a point can become stiffer than before, so that the critical step has to follow
  bool points_stiffen = false;   // by the material alone
  bool of_small_strain = false;  // whether all laws take a rotation for a strain
};

/// The discretisation of a phase, for `stillpoint check`.
struct Discretisation {
  std::vector<PointArray> arrays;
  std::size_t supported_degrees_of_freedom = 0;
  std::vector<int> grid_cells;  // number along each coordinate
  std::size_t occupied_cells = 0;
  QuadratureReport quadrature;

  /// The memory per point of all arrays together.
  double bytes_per_point() const {
    double total = 0;
    for (const PointArray& array : arrays) total += array.bytes_per_point;
    return total;
  }
};

/// The data of P points, in the order in which the body was first filled, in every phase.
struct PointData {
  std::vector<double> positions;          // when the phase began, (P × dim) [m]
  std::vector<double> initial_positions;  // when the run began, (P × dim) [m]
  std::vector<double> volumes;            // V_p when the phase began, (P) [m³]
  std::vector<double> masses;             // m_p, (P) [kg]
  std::vector<int> materials;             // index of each point's material, in the order of the names, (P)
  std::vector<int> bodies;                // index of each point's [[body]], (P)
};

/// Quantities at the points: displacement since the run began, (P × dim); velocity Σ_i N_ip v_i, (P × dim); strain
/// ∂u/∂x since the phase began, (P × gradient_components); Cauchy stress, (P × stress_components) [Pa], for a law with
/// history that of the last commit; volume V_p det f_p, for a law of small strain V_p, (P) [m³].
enum class PointQuantity { displacement, velocity, strain, stress, pore_pressure, volume };

/// The largest errors so far in the conservation of mass and momentum.
struct TransferErrors {
  double mass = 0;  // |Σ_i m_i − Σ_p m_p(0)|/Σ_p m_p(0)
  /// The error of Σ_p m_p v_p against the grid's momentum, and of its change over a phase against the impulse of the
  /// forces; in a body that nothing acts on, against the momentum at the start. Relative to Σ_p m_p |v_p|.
  double momentum = 0;
  /// The error of the angular momentum about the origin of a body that nothing acts on, relative to Σ_p m_p |x_p − x_c|
  /// |v_p|; empty if forces act.
  std::optional<double> angular_momentum;
  double added_mass = 0;  // inertia that nodes were given so that none shortens the step, as a share of Σ_p m_p
};

/// What has rested while other parts moved (phase.rest).
struct RestFigures {
  double points = 0;  // the share of the points at rest, on average over the time
  /// The forces that held what rested, Σ |Q|, as a share of those that pass through the body: half of the loads and
  /// reactions together. The largest of a phase.
  double held_force = 0;
  bool may_rest = true;  // whether loads and springs let parts rest now
};

/// The point whose committed stress exceeds its strength most, as that of a viscous law may for a while.
struct OverStress {
  double share = 0;       // f/(√J₂ − f), the yield function over the strength; NaN if it is not finite
  std::size_t point = 0;  // number of the point
};

/// A part of the body, which shares no function of the grid with the others, and an axis along which no support holds
/// it. Bodies that move on from phase to phase may meet, and count as one part.
struct FreePart {
  int axis = 0;
  bool is_whole = false;              // whether it is the whole body
  std::size_t point = 0;              // the number of one of its material points
  std::vector<std::size_t> unknowns;  // degrees of freedom that are 1 if the part moves by 1, those of the values
};

/// The gap between bodies a < b of a scene that reach the same functions of the grid and have no contact.
struct BodyGap {
  std::size_t a = 0, b = 0;
  double gap = 0;      // the smallest distance [m]; 0 if they touch
  double cells = 0;    // the same distance in cells
  bool bonded = true;  // whether they share these functions; otherwise each moves by its own, through the other
};

/// The axes along which a body is held.
using HeldAxes = std::array<bool, 3>;

/// The control of a body's phases: when a phase should end, and how the next one begins.
class PhaseControl {
 public:
  virtual ~PhaseControl() = default;
  /// The progress of the phase towards its end: 1 if it should end (phase.max_motion or phase.max_strain is reached).
  virtual double progress(double t, ConstVec u) = 0;
  /// Ends the phase at t with u and v, and begins the next, with other unknowns: size() and everything else may change.
  /// Returns v, (size()); u is 0. Throws PointLost if a point leaves the grid, and std::logic_error if the scene has a
  /// single phase, or if initial_velocity() has not begun the first one.
  virtual std::vector<double> begin_next(double t, ConstVec u, ConstVec v) = 0;
  virtual TransferErrors transfer_errors() const = 0;
  /// At t, in the state of an evaluation with these reactions, TrialState's.
  virtual RestFigures rest_figures(double t, ConstVec reactions) const = 0;
  /// Takes the pressures of contact at (t, u) as multipliers, which changes R there: the body may go on to where
  /// nothing penetrates. evenly: by changes smoothed over neighbouring patches, as often as one likes; otherwise by all
  /// that the grid's functions can tell, which comes nearer in few updates. R, (n), and of: an evaluation at (t, u), of
  /// which R and the reactions become those with the new multipliers.
  virtual void update_multipliers(double t, ConstVec u, bool evenly, Vec R, TrialState& of) = 0;
  /// Gives the points materials of the same laws and the same elasticity with other parameters, from the next
  /// evaluation on; stress and history stay. materials: by their names.
  virtual void change_materials(const std::map<std::string, MaterialSpec>& materials) = 0;
  /// Saves the phase as it is between two steps, or restores it, which also restores its unknowns.
  virtual void archive(const StateArchive& state) = 0;
};

/// A diagnosis that also locates material points, by their numbers from 0, and knows their laws.
class PhaseDiagnosis : public Diagnosis {
 public:
  virtual PlaceInBody of_point(std::size_t number) const = 0;
  /// What users should know of the laws as they are found so far: sentences.
  virtual std::vector<std::string> notes_of_laws() const = 0;
};

/// The fields of a phase, at its points and at positions of the body. P: the number of points.
class PhaseFields {
 public:
  virtual ~PhaseFields() = default;
  virtual PointData point_data() const = 0;
  /// Writes a quantity at the points. nodal: u, or v for the velocity, (n).
  virtual void point_field(PointQuantity quantity, double t, ConstVec nodal, Vec out) const = 0;
  /// Writes one of PhaseInfo::law_fields, (P), but for pore_pressure; 0 if the law of a point has no such variable.
  virtual void point_history(const std::string& name, Vec out) const = 0;
  /// Reads fields at positions of the body in its state (t, u, v).
  virtual std::unique_ptr<PlaceReader> read_places(double t, ConstVec u, ConstVec v) const = 0;
  /// The relative norm of the part of the points' Cauchy stresses that no function of the grid feels: their difference
  /// from their least-squares fit by the grid's functions, body by body, √(Σ V_p |σ_p − σ(x_p)|²/Σ V_p |σ_p|²).
  virtual double null_space_stress(double t, ConstVec u) const = 0;
  /// mass.factor Σ_p m_p N_ip N_jp, (n × n) [kg]: the inertia of the material alone, which is less than the mass of
  /// the motion, and next to nothing for functions that hardly reach the body.
  virtual SparseMatrix material_mass() const = 0;
  /// The largest stress beyond the strength; empty: no law is viscous.
  virtual std::optional<OverStress> over_stress() const = 0;

  std::vector<double> positions() const { return point_data().positions; }
  void point_displacement(double t, ConstVec u, Vec out) const { point_field(PointQuantity::displacement, t, u, out); }
  void point_velocity(double t, ConstVec v, Vec out) const { point_field(PointQuantity::velocity, t, v, out); }
  void point_strain(double t, ConstVec u, Vec out) const { point_field(PointQuantity::strain, t, u, out); }
  void point_stress(double t, ConstVec u, Vec out) const { point_field(PointQuantity::stress, t, u, out); }
};

/// What supports, walls and driven loads bear, and how they move. reactions: TrialState's, of an evaluation at (t, u).
class PhaseSupports {
 public:
  virtual ~PhaseSupports() = default;
  /// The reactions of walls in the last evaluation.
  virtual std::vector<WallReaction> wall_reactions(double t) const = 0;
  /// Displacements of the supports since the phase began, in the order of TrialState::reactions [m].
  virtual std::vector<double> support_displacements(double t) const = 0;
  /// The reactions of the supports that have a name.
  virtual std::vector<SupportReaction> support_reactions(double t, ConstVec u, ConstVec reactions) const = 0;
  /// The reports of the supports that hold by springs, at (t, u).
  virtual std::vector<WeakSupport> weak_supports(double t, ConstVec u) const = 0;
  /// What the rigid bodies of the scene exert at (t, u), in their order, followed by its contacts between bodies.
  virtual std::vector<ContactReport> contacts(double t, ConstVec u) const = 0;
  /// Whether a pressure acts in any of them at (t, u).
  virtual bool are_touched(double t, ConstVec u) const = 0;
  /// What has gone into slip with friction, against rigid bodies and between bodies, at all commits of this stage [J].
  virtual double friction_work() const = 0;
  /// How well the multipliers of contact fit at (t, u).
  virtual ContactState contact_state(double t, ConstVec u) const = 0;
  /// What lies in rigid bodies without being felt, at (t, u): at most one place of a kind for each.
  virtual std::vector<Intrusion> intrusions(double t, ConstVec u) const = 0;
  /// The longest way that a rigid body which is not free has gone between two times [cells].
  virtual double way_of_rigid_bodies(double before, double t) const = 0;
  /// What rigid bodies have gone right through between a time before and (t, u), by jumps of more than half a cell.
  virtual std::vector<Intrusion> passages(double before, double t, ConstVec u) const = 0;
  /// Whether a rigid body that is not free is ahead of a body that goes on along a unit vector, (dim), from (t, u).
  virtual bool is_rigid_body_ahead(std::size_t body, ConstVec direction, double t, ConstVec u) const = 0;
  /// The state of loads that a displacement drives, at (t, u); empty if there are none.
  virtual std::optional<LoadState> load_state(double t, ConstVec u) const = 0;
  /// For each body of the scene, the axes along which a support, a spring or a wall acts at a function that reaches it.
  virtual std::vector<HeldAxes> held_bodies() const = 0;
};

/// What a phase is made of.
class PhaseShape {
 public:
  virtual ~PhaseShape() = default;
  virtual Discretisation discretisation() const = 0;
  /// The lines of the grid along each axis [m].
  virtual std::vector<std::vector<double>> grid_lines() const = 0;
  /// The positions of the unknowns, at which the coefficients of a linear motion equal the motion; empty for a basis
  /// with slopes.
  virtual NodalLayout layout() const = 0;
  virtual std::vector<FreePart> free_parts() const = 0;
  /// The bodies of the scene that reach the same function of the grid and have no contact, pair by pair.
  virtual std::vector<BodyGap> body_gaps() const = 0;
};

/// The semi-discrete system of one phase, with what a user wants to see of it.
class LagrangianPhase : public SemiDiscrete {
 public:
  const PhaseInfo& info() const { return info_; }
  int dim() const { return info_.dim; }
  std::size_t points() const { return info_.points; }

  const PhaseFields& fields() const { return parts_.fields; }
  const PhaseSupports& supports() const { return parts_.supports; }
  const PhaseShape& shape() const { return parts_.shape; }
  const PhaseControl& control() const { return parts_.control; }
  PhaseControl& control() { return parts_.control; }
  const PhaseDiagnosis& diagnosis() const final { return parts_.diagnosis; }

  /// The u and v at time t that the scene's initial values project to, Σ_j M_ij u_j = Σ_p m_p N_ip u_0(x_p), (n).
  virtual std::vector<double> initial_displacement(double t) const = 0;
  virtual std::vector<double> initial_velocity(double t) = 0;
  /// Ends the phase at (t, u, v), and returns what its points hand on to another stage, or to another run; nothing more
  /// may be asked of this phase than its fields. Throws PointLost if a point leaves the grid.
  virtual std::unique_ptr<CarriedBody> hand_over(double t, ConstVec u, ConstVec v) = 0;
  /// The growth s of the highest frequency squared that a point's modulus would give its cell, the largest now over the
  /// largest when the run began: omega_max grows by √s. Infinite if u cannot be evaluated.
  virtual double stiffening(double t, ConstVec u) const = 0;

 protected:
  /// Parts of the derived object.
  struct Parts {
    const PhaseFields& fields;
    const PhaseSupports& supports;
    const PhaseShape& shape;
    PhaseControl& control;
    const PhaseDiagnosis& diagnosis;
  };
  explicit LagrangianPhase(const Parts& parts) : parts_(parts) {}

  PhaseInfo info_;

 private:
  Parts parts_;
};

/// Thrown if a material point has left the grid.
class PointLost : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// How the first phase of a run or of a stage begins.
struct PhaseBegin {
  const CarriedBody* carried = nullptr;  // what the points hand on that were there before; null: nothing, at the start
  double t = 0;                          // [s]
  const Ranks* ranks = nullptr;          // that share the points, and outlive the phase; null: this one has them all
};

/// Makes the first phase: places the bodies, evaluates and freezes the weights, assembles the mass. The instantiation
/// for the scene's kinematics and basis is chosen here, once. Throws SceneError for faults that only show now: a
/// support that no material reaches, a force where there is no material, a mass matrix that is not positive definite.
std::unique_ptr<LagrangianPhase> make_phase(const Problem& problem, const PhaseBegin& begin = {});
/// For a body that is handed on in a scene of this kinematics, to be restored.
std::unique_ptr<CarriedBody> make_carried_body(const Problem& problem);

}  // namespace stillpoint
