// Loads that keep their proportion and are driven by a displacement, so that a body can be followed to its limit load
// and beyond, where no larger load has an equilibrium.
//
//   load = λ F,   q = F·u/P,   P = Σ_a |F_a| over the functions a
//
// F: the reference loads, as the scene gives them. Their mean displacement q is prescribed, q = q(t), and the factor λ
// is what that takes: a spring with the weights w = F/P (springs.hpp) gives k (q(t) − w·u) w, so that
//
//   λ = k (q(t) − w·u)/P.
//
// The path is that of displacement control [Batoz and Dhatt 1979], whatever the loads are: it goes on where λ falls. q
// lags behind q(t) by λ P/k; what belongs to λ is the q that there is.
#pragma once

#include <stillpoint/material.hpp>
#include <stillpoint/problem.hpp>

#include <vector>

#include "space/boundary/boundary_conditions.hpp"
#include "space/boundary/load_state.hpp"
#include "space/boundary/springs.hpp"
#include "space/boundary/weak_supports.hpp"

namespace stillpoint {

template <Kinematics K>
class LoadControl {
  static constexpr int dim = dimensions(K);
  using Parts = PhaseParts<dim>;

 public:
  /// grid: the first one; time_scale: of PrescribedMotion.
  LoadControl(const Problem& problem, const Grid<dim>& grid, double time_scale);
  LoadControl(const LoadControl&) = delete;  // loads_ knows where reference_ is
  LoadControl& operator=(const LoadControl&) = delete;

  bool acts() const { return !motion_.empty(); }
  const Springs& springs() const { return springs_; }

  /// Throws SceneError if the loads act on nothing that is free.
  void begin_phase(const Parts& phase, const StiffnessBound& stiffness_bound);
  /// The phase ends with u, over the grid's functions.
  void end_phase(const double* u);
  void archive(const StateArchive& state);
  /// F_s += λ F at the prescribed degrees of freedom, at (t, u).
  void add_load_on_supports(const Parts& phase, double t, const double* u, Vec F_s) const;
  /// At (t, u), u over the grid's functions.
  LoadState state(double t, const double* u) const;

 private:
  const Problem reference_;  // the scene with these loads alone
  BoundaryConditions<dim> loads_;
  std::vector<PrescribedMotion> motion_;  // q(t); none: nothing is driven
  Springs springs_;                       // one, of the present phase
  double total_ = 0;                      // P [N]
  double stiffness_ = 0;                  // k [N/m]
  double moved_ = 0;                      // q when the phase began [m]
};

}  // namespace stillpoint
