// A body that yields in a single phase, whose grid and weights are those of its start: beyond its limit load no
// equilibrium is left, and the residual ends at the share of the load that it does not bear; but the frozen grid
// stiffens as it is squeezed, and bears any load in the end. So the strain tells how far the answer can be trusted. A
// hyperelastic body is computed rightly at any strain in one phase.
#pragma once

#include "simulation/watcher.hpp"

namespace stillpoint {

class SinglePhase : public Watcher {
 public:
  /// Takes an equilibrium back if the body has gone nearly as far as its own size, and doubts one that goes some way.
  void confirm(RunState& run, Verdict& verdict) override;
  void fill_state(Summary& summary, RunState& run) override;
};

}  // namespace stillpoint
