// The time from which on the loads and moving supports of a body have their final values.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/semi_discrete.hpp>

#include <memory>
#include <string>
#include <vector>

#include "scene/own_loads.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// Q(t) = F(t) − R(u = 0, t): loads and the force of displaced supports on the undeformed body, (n) [N].
std::vector<double> total_load_at(const SemiDiscrete& system, double t);

/// The time from which on all that acts on the body stays as it is at the end: before, balance is that of a plateau.
/// Formulas are looked at in 20 000 moments, those of the position in 2 000, at up to 32 of the points, and at the
/// moments at which their comparisons switch.
class LoadSchedule {
 public:
  /// phase: the first one; end: the end of the run [s]. If that is open (0), the end of formulas which settle is looked
  /// for, and for others every moment counts as the end. Throws SceneError if a formula is not a finite number in one
  /// of these moments, or a load of the program's own changes after it is said to have settled.
  LoadSchedule(const Problem& problem, const LagrangianPhase& phase, double end);

  bool settled(double t) const { return t >= settled_from_; }
  /// True if loads go on to depend on t, and no end is known.
  bool is_open() const { return is_open_; }
  /// True if loads are settled, and cannot change any more as they may if the end is open.
  bool settled_for_good(double t) const { return settled(t) && !is_open_; }
  /// The fault of a load of the program's own that is another one at t than when it settled; empty: there is none.
  std::string own_load_goes_on(double t) const;

 private:
  void look_at(const std::string& key, const Expression& formula, ConstVec x, int moments, double end);
  void look_at_own(const Problem& problem, const LagrangianPhase& phase, double end);

  std::shared_ptr<const OwnLoadRow> own_;  // null: there is none
  int dim_ = 0;
  std::vector<double> x_;          // positions at the start, (points × dim) [m]
  std::vector<double> b_settled_;  // b at these positions once it has settled [m/s²]
  double settled_from_ = 0;        // [s]
  bool is_open_ = false;
};

}  // namespace stillpoint
