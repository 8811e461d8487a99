// The kinetic energy beside the work that was done on the body: it tells if a quasi-static answer depends on speed.
#pragma once

#include <string>
#include <vector>

#include "scene/dimensions.hpp"
#include "simulation/phase_motion.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// W = ∫ F · du + ∫ R_s · du_s + work of the moving walls, by the trapezoidal rule from row to row and phase to phase,
/// R_s the reactions of the supports s. It is the work that is done on the free unknowns and stored as strain: without
/// damping, and if the mass is lumped, W = kinetic energy + strain energy. A support that is displaced from the start
/// did half of R_s · u_s to get there. With a static solver, which lets loads and supports come on in shares, it is the
/// work along the equilibria on its way. In one dimension nothing is watched.
class EnergyBalance {
 public:
  explicit EnergyBalance(const LagrangianPhase& phase)
      : phase_(phase), watches_(dimension_info(phase.dim()).watches_work) {}

  bool watches() const { return watches_; }
  std::vector<std::string> columns() const;  // "inertia.<figure>"
  /// The figures in the order of columns(), for the present kinetic energy [J]; its ratio to no work is NaN.
  std::vector<double> values(double kinetic_energy) const;
  double external_work() const { return work_; }  // [J]

  /// Goes on to t and the displacements of then, at which the system was evaluated last.
  void advance(double t, const PhaseMotion& motion);
  /// A phase has begun at t, with u = 0, and was evaluated.
  void begin_phase(double t, const RelaxationSystem& system);

  /// A stage has begun at t, in which the system was evaluated; work: so far [J]; now: t, or with a static solver the
  /// end of the stage [s].
  void go_on(double work, double t, double now, const RelaxationSystem& system);

  void archive(const StateArchive& state);

 private:
  double wall_power(double t) const;
  void advance(double t, const Stepper::Way& way);

  /// Forces, and the displacements along which they do work, since the phase began.
  struct Forces {
    std::vector<double> F, u;                // free unknowns
    std::vector<double> reactions, support;  // supports
  };

  const LagrangianPhase& phase_;
  bool watches_;
  double work_ = 0, t_ = 0, power_ = 0;
  double earlier_work_ = 0;  // in the phases before [J]
  Forces last_;
};

}  // namespace stillpoint
