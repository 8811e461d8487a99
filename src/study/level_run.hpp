// One run of a convergence study, and what is read of its end.
#pragma once

#include <stillpoint/converge.hpp>
#include <stillpoint/summary.hpp>

#include <string>
#include <utility>
#include <vector>

#include "study/common_places.hpp"

namespace stillpoint {

struct LevelRun {
  ConvergenceLevel level;
  bool is_there = false;                               // whether it came to the end that its scene asks for
  double floor = 0;                                    // relative size of errors that are not those of the level
  std::vector<std::pair<std::string, double>> norms;   // errors against the exact solution: "u_l2", …
  std::string no_energy;                               // why "u_energy" is none of them
  std::vector<std::pair<std::string, double>> probes;  // "tip.u.x" and its value at the end
  std::vector<double> probe_errors;                    // against the exact solution; NaN where there is none
  std::vector<double> u, stress, volume;               // of the points, by their numbers, or at the common places
  std::vector<std::string> notes;
};

/// Runs the scene by one thread. What goes wrong is told by the level's status. places: at which u and stress are read,
/// of a scene of one phase; null: at the material points.
LevelRun run_level(const Scene& scene, const CommonPlaces* places, const std::function<bool()>& interrupted);

/// Throws SceneError if the scene is refused once it is set up, as for a probe where no material is.
void check_set_up(const Scene& scene, const std::function<bool()>& interrupted);

}  // namespace stillpoint
