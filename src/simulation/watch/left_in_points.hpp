// The traces that a violent way to rest in many phases leaves in the points: stresses and positions that no function of
// the grid feels, and that no motion after it takes away.
#pragma once

#include "simulation/watcher.hpp"

namespace stillpoint {

class LeftInPoints : public Watcher {
 public:
  /// Takes an equilibrium back if a wall has pushed a part of the body out of itself at once, by a good part of a cell;
  /// doubts it if much of the stresses is not felt by the grid.
  void confirm(RunState& run, Verdict& verdict) override;
  void fill_state(Summary& summary, RunState& run) override;
};

}  // namespace stillpoint
