// The exact solutions that the program knows: each has a file of its own, and a row here.
#pragma once

#include <stillpoint/catalogue.hpp>
#include <stillpoint/exact_solution.hpp>

#include <memory>
#include <vector>

namespace stillpoint {

struct KnownSolution {
  SolutionInfo about;
  /// Makes the solution for a scene whose parameters have been checked.
  std::unique_ptr<ExactSolution> (*make)(const Problem& problem);
};

template <class Solution>
std::unique_ptr<ExactSolution> make_solution(const Problem& problem) {
  return std::make_unique<Solution>(problem);
}

const std::vector<KnownSolution>& known_solutions();

// The rows:
KnownSolution column_solution();
KnownSolution lame_cylinder_solution();
KnownSolution kirsch_solution();
KnownSolution strip_load_solution();
KnownSolution elastica_solution();
KnownSolution vortex_solution();
KnownSolution radial_mode_solution();
KnownSolution torsion_solution();
KnownSolution flexure_solution();

}  // namespace stillpoint
