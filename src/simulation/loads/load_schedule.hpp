// What acts on a body over time: loads and moving supports, and when they have done all that they do.
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

/// From when on nothing changes that acts on the body, up to the end: before, balance is that of a plateau, not of the
/// end. Formulas are looked at in 20 000 moments, those of the position in 2 000, at up to 32 of the points, and where
/// their comparisons switch.
class LoadSchedule {
 public:
  /// phase: the first; end: of the run [s], 0 if it is open: then that of formulas which settle is looked for, and of
  /// others every moment counts as the end. Throws SceneError if a formula is not a finite number in one of these
  /// moments, or a load of the program's own changes after it is said to have settled.
  LoadSchedule(const Problem& problem, const LagrangianPhase& phase, double end);

  bool settled(double t) const { return t >= settled_from_; }
  /// Whether loads go on to depend on t, and no end is known.
  bool is_open() const { return is_open_; }
  /// Not where the end is open: there they may still change.
  bool settled_for_good(double t) const { return settled(t) && !is_open_; }
  /// What is wrong with a load of the program's own that is another one at t than when it settled; empty: nothing.
  std::string own_load_goes_on(double t) const;

 private:
  void look_at(const std::string& key, const Expression& formula, ConstVec x, int moments, double end);

  void look_at_own(const Problem& problem, const LagrangianPhase& phase, double end);

  std::shared_ptr<const OwnLoadRow> own_;  // null: there is none
  int dim_ = 0;
  std::vector<double> x_, b_settled_;  // at the start, (points × dim) [m], and b there once it has settled [m/s²]
  double settled_from_ = 0;            // [s]
  bool is_open_ = false;
};

}  // namespace stillpoint
