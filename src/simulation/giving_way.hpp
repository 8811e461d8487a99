// Whether a body gives way: points that yield, and walls whose friction is used up.
#pragma once

#include <stillpoint/problem.hpp>

#include <cstddef>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

class GivingWay {
 public:
  /// The phase, the first or any, outlives it.
  GivingWay(const Problem& problem, const LagrangianPhase& phase);

  /// Whether anything can: a law that remembers its path, or a wall with a friction that has an end.
  bool is_possible() const { return remembers_ || has_friction_; }
  /// Whether there is a plastic strain to tell by, or friction; otherwise a law remembers what nobody here knows.
  bool shows() const { return yields_ || has_friction_ || !remembers_; }
  /// Σ_p V_p γᵖ_p, with the volumes of the start; it only grows [m³]. 0 where laws have none.
  double plastic_strain() const;
  /// The walls along which the body slides at t: of the last evaluation, |T| = friction |N|.
  std::vector<std::size_t> sliding_walls(double t) const;

 private:
  const LagrangianPhase& phase_;
  std::vector<double> friction_;  // of each wall
  bool remembers_, yields_, has_friction_;
  std::vector<double> volumes_;  // (P) [m³]
};

}  // namespace stillpoint
