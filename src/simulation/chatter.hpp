// Whether a body in many phases goes anywhere: points that cross cells can shake it for ever, its residual never small.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

class Chatter {
 public:
  /// After a change of phase, of which the last took the nodes by `way` cells, under loads that stay: what to say if
  /// the points have gone nowhere since the residual was last so large, as far as they have been on their way. cell:
  /// the largest side of the grid's cells [m].
  std::optional<std::string> observe(const LagrangianPhase& phase, double way, double residual, double cell);

  /// coordinates: P × dim.
  void archive(const StateArchive& state, std::size_t coordinates) {
    state("way", way_);
    state("residual", residual_);
    state.none_or(coordinates, "position", position_);
    state("phases", phases_);
  }

 private:
  double way_ = 0;                // since then [cells]
  double residual_ = 0;           // then
  std::vector<double> position_;  // of the points then, (P × dim) [m]
  long phases_ = 0;
};

}  // namespace stillpoint
