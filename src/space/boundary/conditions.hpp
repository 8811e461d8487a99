// All conditions on a body in the present phase: supports, walls and loads (boundary_condition.hpp), the springs of
// supports and of driven loads, contact with rigid bodies and between bodies, and the axis of symmetry.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/semi_discrete.hpp>

#include <memory>
#include <optional>
#include <vector>

#include "space/boundary/axis_of_symmetry.hpp"
#include "space/boundary/boundary_conditions.hpp"
#include "space/boundary/condition_reports.hpp"
#include "space/boundary/fading_force.hpp"
#include "space/boundary/load_control.hpp"
#include "space/boundary/weak_supports.hpp"
#include "space/points/surface_depths.hpp"

namespace stillpoint {

template <Kinematics K>
class RigidContact;  // rigid_contact.hpp
template <Kinematics K>
class RigidFaces;  // rigid_faces.hpp
template <Kinematics K>
class BodyContact;  // body_contact.hpp

template <Kinematics K>
class Conditions {
  static constexpr int dim = dimensions(K);

 public:
  using Parts = PhaseParts<dim>;

  /// problem: the scene without the loads that a displacement drives, which are in `whole`; must outlive this object.
  /// grid, body: as placed; origin: see SurfaceDepths; time_scale: see PrescribedMotion.
  Conditions(const Problem& problem, const Problem& whole, const Grid<dim>& grid, const Body<K>& body,
             const std::vector<double>& origin, double time_scale);
  ~Conditions();
  Conditions(const Conditions&) = delete;
  Conditions& operator=(const Conditions&) = delete;

  // --- a phase begins, in this order ---------------------------------------------------------------
  HeldUnknowns hold(double t, const GridFunctions<dim>& functions, const MaterialPoints<dim>& points,
                    const PointFunctions<dim>& weights, const std::vector<char>& reached, const Ranks* ranks);
  /// F += the forces that depend on neither t nor u, (n). Throws SceneError, see WeakSupports and LoadControl.
  void begin_phase(const Parts& phase, double t, const StiffnessBound& stiffness_bound, Vec F);
  /// Changes initial velocities of the phase that would go through a wall; v: (n).
  void begin_motion(const Parts& phase, double t, Vec v);
  /// Whether material reaches the axis of symmetry, which then holds it.
  bool act_on_axis() const { return axis_.acts(); }

  // --- forces at (t, u), u over the grid's functions -----------------------------------------------
  bool loads_are_constant() const;
  bool loads_follow() const;
  /// F += the forces that depend on t alone.
  void add_loads(const Parts& phase, double t, Vec F) const;
  /// F += the forces that depend on u.
  void add_following_loads(const Parts& phase, double t, const double* u, Vec F) const;
  /// ∂F/∂u of the forces that depend on u, (n × n).
  SparseMatrix tangent_of_loads(const Parts& phase, double t, const double* u) const;

  /// The number of reactions beside those of supports that prescribe unknowns: of springs and of rigid bodies.
  std::size_t other_reactions() const;
  /// R += the forces of springs and of contact, (n); reactions: of the supports that prescribe unknowns, followed
  /// by those of the springs, and those of the rigid bodies.
  void add_force(double t, const double* u, Vec R, Vec reactions) const;
  /// dR += the derivative of these forces along du.
  void add_product(Tangent kind, double t, const double* u, const double* du, Vec dR) const;
  /// matrix += the derivative; without that of driven loads, which would be a full matrix: static solvers have none.
  void add_matrix(Tangent kind, double t, const double* u, SparseMatrix& matrix) const;
  /// Whether these forces depend on the state at the last commit.
  bool remember() const;
  void commit(double t, const double* u);
  /// Whether a support holds by springs, whether bodies may be touched, and the factor by which omega_max² may have
  /// grown through either since the first phase.
  bool hold_by_springs() const { return !weak_supports_.empty(); }
  bool may_touch() const { return problem_.may_touch(); }
  double growth_of_springs() const;
  /// Whether a spring of a support acts on an unknown of the grid, (unknowns).
  std::vector<char> are_sprung(std::size_t unknowns) const;

  // --- during a phase, and at its end ---------------------------------------------------------------
  /// As RigidContact::move_on().
  bool move_rigid_bodies_on(double share);
  Contact* contact() const { return contact_; }
  /// Whether loads stay what they are and springs where they are, so that nothing but motions in the body can put out
  /// of balance what rests at t.
  bool let_parts_rest(double t) const;
  /// As PhaseControl's; reactions: as in add_force().
  void update_multipliers(double t, const double* u, bool evenly, Vec R, Vec reactions);
  bool ask_for_next_phase(ConstVec u) const;
  void end_phase(double t, const double* u);
  /// As RigidContact::faces().
  RigidFaces<K> faces_of_rigid_bodies(double t, const double* u) const;
  /// As BoundaryCondition::renumber().
  void renumber(const std::vector<int>& now_of, int functions) {
    for (const auto& condition : all_) condition->renumber(now_of, functions);
  }
  /// As end_phase() at the end of a stage of small strain, whose points stay where they are.
  void end_phase_in_place(double t, const double* u);
  void archive(const StateArchive& state);

  // --- from stage to stage --------------------------------------------------------------------------
  /// Before the first phase: takes over what the conditions of the stage before remember, as archive() saved it.
  void take_over(const SavedState& from_stage);
  /// Moves the loads that begin with a stage to where the borders of bodies are that have moved before.
  void place_new_loads(const CarriedBodyOf<K>& carried, const Grid<dim>& grid);
  /// Moves the borders of bodies that are loaded or may be touched to where another run has left them.
  void leave_placed(const CarriedBodyOf<K>& carried, const Grid<dim>& grid);
  /// Balances the force that a stage puts out of balance, F − R at its begin, (n) [N], and lets that fade until the
  /// time `over` [s].
  void let_fade(const Parts& phase, double t, double over, ConstVec out_of_balance) {
    fading_.begin(phase, t, over, out_of_balance);
  }

  // --- reactions and displacements; the argument `reactions` as in add_force() --------------------
  std::vector<WallReaction> wall_reactions(double t) const;
  std::vector<double> support_displacements(const HeldUnknowns& held, double t) const;
  /// Whether a support of the scene has a name.
  bool name_supports() const;
  std::vector<SupportReaction> support_reactions(const Parts& phase, double t, const double* u,
                                                 ConstVec reactions) const;
  std::vector<WeakSupport> weak_supports(double t, const double* u) const { return weak_supports_.report(t, u); }
  std::vector<ContactReport> contacts(double t, const double* u) const;
  bool are_touched(double t, const double* u) const;
  double friction_work() const;
  ContactState contact_state(const Parts& phase, double t, const double* u) const;
  std::vector<Intrusion> intrusions(const Parts& phase, double t, const double* u) const;
  bool rigid_bodies_jump(double before, double t) const;
  double way_of_rigid_bodies(double before, double t) const;
  std::vector<Intrusion> passages(const Parts& phase, double before, double t, const double* u) const;
  bool is_ahead(std::size_t body, const Point<dim>& direction, double t, const double* u) const;
  bool are_driven() const { return load_control_.acts(); }
  LoadState load_state(double t, const double* u) const { return load_control_.state(t, u); }

 private:
  /// The part of add_force() that is of contact.
  void add_contact(double t, const double* u, Vec R, Vec reactions) const;
  std::size_t springs() const { return weak_supports_.springs().size() + load_control_.springs().size(); }

  const Problem& problem_;
  SurfaceDepths<dim> depths_;
  BoundaryConditions<dim> all_;
  AxisOfSymmetry<K> axis_;
  WeakSupports<K> weak_supports_;
  LoadControl<K> load_control_;
  FadingForce<dim> fading_;
  std::unique_ptr<RigidContact<K>> rigid_contact_;
  std::unique_ptr<BodyContact<K>> body_contact_;
  Contact* contact_ = nullptr;  // contact of one of the conditions; null if there is none
};

extern template class Conditions<Kinematics::line>;
extern template class Conditions<Kinematics::plane>;
extern template class Conditions<Kinematics::axisymmetric>;
extern template class Conditions<Kinematics::space>;

}  // namespace stillpoint
