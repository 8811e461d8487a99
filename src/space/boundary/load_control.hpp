// Loads in fixed proportion that are driven by a displacement, so that a body can be followed to its limit load and
// beyond, where no larger load has an equilibrium.
//
//   load = λ F,   q = F·u/P,   P = Σ_a |F_a| over the functions a
//
// F: the reference loads, as the scene gives them. Their mean displacement q is prescribed, q = q(t), and the factor λ
// is found: a spring with the weights w = F/P (springs.hpp) gives k (q(t) − w·u) w, so that
//
//   λ = k (q(t) − w·u)/P.
//
// The path is that of displacement control [Batoz and Dhatt 1979], whatever the loads are: it goes on where λ falls. q
// lags behind q(t) by λ P/k; the q that belongs to λ is the actual one.
#pragma once

#include <stillpoint/material.hpp>
#include <stillpoint/problem.hpp>

#include <vector>

#include "space/boundary/boundary_conditions.hpp"
#include "space/boundary/condition_reports.hpp"
#include "space/boundary/springs.hpp"
#include "space/boundary/weak_supports.hpp"

namespace stillpoint {

template <Kinematics K>
class LoadControl {
  static constexpr int dim = dimensions(K);
  using Parts = PhaseParts<dim>;

 public:
  /// grid: that of the first phase; time_scale: see PrescribedMotion.
  LoadControl(const Problem& problem, const Grid<dim>& grid, double time_scale);
  LoadControl(const LoadControl&) = delete;  // loads_ knows where reference_ is
  LoadControl& operator=(const LoadControl&) = delete;

  bool acts() const { return !motion_.empty(); }
  const Springs& springs() const { return springs_; }

  /// Sets the spring of the phase. Throws SceneError if the loads act on no free degree of freedom.
  void begin_phase(const Parts& phase, const StiffnessBound& stiffness_bound);
  /// Moves the loads at the end of a phase; in_place: of a stage of small strain, whose points stay where they are. u:
  /// over the grid's functions.
  void end_phase(const double* u, bool in_place);
  /// Before the first phase of a run that begins with the points of another one.
  void leave_placed(const WaysSincePlaced<dim>& ways) {
    for (const auto& load : loads_) load->leave_placed(ways);
  }
  void archive(const StateArchive& state);
  /// F_s += λ F at the prescribed degrees of freedom, at (t, u).
  void add_load_on_supports(const Parts& phase, double t, const double* u, Vec F_s) const;
  /// The state at (t, u), u over the grid's functions.
  LoadState state(double t, const double* u) const;

 private:
  const Problem reference_;  // the scene with the driven loads alone
  BoundaryConditions<dim> loads_;
  std::vector<PrescribedMotion> motion_;  // q(t); empty: nothing is driven
  Springs springs_;                       // the one spring of the present phase
  double total_ = 0;                      // P [N]
  double stiffness_ = 0;                  // k [N/m]
  double moved_ = 0;                      // q when the phase began [m]
};

}  // namespace stillpoint
