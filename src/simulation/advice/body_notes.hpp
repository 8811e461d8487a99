// Notes on bodies: on those that the grid moves as one though they do not touch, and on laws as they are found.
#pragma once

#include <stillpoint/problem.hpp>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// Functions of the grid that reach two bodies carry forces from one to the other before they touch. Each pair is told
/// once: at the start, and in phases when they have come so near. So is what a law turns out to be.
class BodyNotes {
 public:
  /// Throws SceneError if equilibrium is asked for and nothing but such functions holds a body.
  std::vector<std::string> at_start(const Problem& problem, const LagrangianPhase& phase);
  /// Notes on a phase that has begun.
  std::vector<std::string> later(const Problem& problem, const LagrangianPhase& phase);

 private:
  std::vector<std::string> of_laws(const LagrangianPhase& phase);

  std::set<std::pair<std::size_t, std::size_t>> known_;
  std::set<std::string> told_;
};

}  // namespace stillpoint
