// Supports where the basis does not interpolate, or for which a scene gives a stiffness: springs hold the body, see
// springs.hpp, and move with it from phase to phase.
//
// A spring is about as stiff as the body is for the functions at its position when the run begins: with G_a ≥ Σ_b
// |K_ab| (stiffness_bound)
//
//   k = β / Σ_a (w_a²/G_a)   at a position,
//   k = κ A                  for each piece A of a face, with one κ for all, the mean of β Σ_a w_a² / Σ_a (w_a²/G_a)
//                            over the cells' shares of the face.
//
// Then k wᵀM⁻¹w ≤ β max_a G_a/M_a, however little mass functions have, and as no mass is in k the answer does not
// depend on mass scaling. With β = 1, about 8 (λ + 2μ)/(ρ h²) (wᵀM⁻¹w)⁻¹, the critical step falls to no less than 0.6
// of its value without springs, and the gap on a face is about a tenth of h/L of the displacement, L the body's length:
// it is of first order in h. A position in the plane gives way by a share that hardly falls with h, as the body itself
// does there: under a point force its displacement has no limit. The stiffness is kept in later phases, so that the
// forces continue from one phase to the next; growth() reports where the functions of a later phase move less inertia.
#pragma once

#include <stillpoint/material.hpp>
#include <stillpoint/problem.hpp>

#include <algorithm>
#include <memory>
#include <vector>

#include "space/boundary/boundary_condition.hpp"
#include "space/boundary/carried_point.hpp"
#include "space/boundary/condition_reports.hpp"
#include "space/boundary/springs.hpp"
#include "space/boundary/stiffness_at.hpp"

namespace stillpoint {

template <Kinematics K>
class WeakSupports {
  static constexpr int dim = dimensions(K);
  using GridOf = Grid<dim>;
  using Parts = PhaseParts<dim>;

 public:
  static constexpr double beta = 1;

  /// The problem must outlive this object; grid: that of the first phase; time_scale: see PrescribedMotion.
  WeakSupports(const Problem& problem, const GridOf& grid, double time_scale);

  bool empty() const { return held_.empty(); }
  const Springs& springs() const { return springs_; }
  /// Whether one of them moves with time.
  bool move() const { return std::ranges::any_of(motions_, &PrescribedMotion::moves); }
  /// The support of spring s, and the component that it holds.
  std::size_t owner(std::size_t s) const { return held_[s].support; }
  int component(std::size_t s) const { return held_[s].component; }
  /// The position that spring s holds, at u over the grid's functions [m].
  Point<dim> place(std::size_t s, const double* u) const;
  /// The largest ratio of a spring's k wᵀM⁻¹w to that of the first phase, at least 1: omega_max² grows by no more.
  double growth() const { return growth_; }

  /// Sets the springs of the phase. Throws SceneError if a support has nothing to hold.
  void begin_phase(const Parts& phase, const StiffnessBound& stiffness_bound);
  /// Moves the positions at the end of a phase; u: over the grid's functions.
  /// in_place: of a stage of small strain, whose points stay where they are.
  void end_phase(const double* u, bool in_place);
  void archive(const StateArchive& state);

  /// The report of each of these supports at (t, u), u over the grid's functions.
  std::vector<WeakSupport> report(double t, const double* u) const;

 private:
  struct Held {
    std::size_t support;  // number in the scene
    int component;
    CarriedPoint<dim> at;
    double area;           // undeformed area of a piece of a face [m²]; 1 at a position
    double share;          // share of the cell's part of the face; 1 at a position
    double stiffness = 0;  // k [N/m]
    double moved = 0;      // displacement in earlier phases [m]
    double frequency = 0;  // k wᵀM⁻¹w in the first phase, if the mass is lumped [1/s²]
    std::shared_ptr<const PrescribedMotion> motion{};  // the motion at its undeformed position, if the formula depends
                                                       // on position
  };

  void add(std::size_t support, int component, const Point<dim>& x, double area, double share);
  void cut_face(std::size_t s, const GridOf& grid);
  const PrescribedMotion& motion_of(const Held& held) const;
  void drop_what_lies_outside(const Parts& phase);
  void choose_stiffness(const Parts& phase, const std::vector<double>& G);
  static std::vector<Springs::Weight> weights_of(const Held& held, const DegreesOfFreedom& dofs);
  static double square_of_frequency(double k, const std::vector<Springs::Weight>& weights, const Parts& phase);

  const Problem& problem_;
  std::vector<PrescribedMotion> motions_;  // a motion at rest, followed by that of each support
  std::vector<Held> held_;                 // grouped by support
  Springs springs_;                        // springs of the present phase, in the order of held_
  double growth_ = 1;
  bool has_begun_ = false;  // whether the first phase has begun
};

}  // namespace stillpoint
