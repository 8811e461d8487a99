// Chatter of a body in many phases: points that cross cells can shake it for ever, its residual never small, while it
// goes nowhere.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulation/watcher.hpp"

namespace stillpoint {

class Chatter : public Watcher {
 public:
  void observe(RunState& run) override;
  Verdict begin_phase(RunState& run) override;
  /// After a change of phase under loads that stay: what to say if the points have gone nowhere, beside the way that
  /// they have been on, since the residual was last so large. way: that of the nodes in the phase before [cells];
  /// residual: at the end of that phase; cell: a side of the smallest of the grid's cells [m].
  std::optional<std::string> take(const LagrangianPhase& phase, double way, double residual, double cell);

  void archive(const StateArchive& state, RunState& run) override;

 private:
  std::optional<double> residual_at_end_;  // the residual at the end of the phase that is just over; empty: none is
  // The present comparison, which has begun when the residual was last so large:
  double way_ = 0;                // the way of the nodes since then [cells]
  double residual_ = 0;           // the residual of then
  std::vector<double> position_;  // the positions of the points then, (P × dim) [m]
  long phases_ = 0;               // the phases since then
};

}  // namespace stillpoint
