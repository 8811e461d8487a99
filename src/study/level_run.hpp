// One run of a convergence study with the results that are read at its end, and what the study makes of its levels.
#pragma once

#include <stillpoint/converge.hpp>
#include <stillpoint/scene.hpp>
#include <stillpoint/summary.hpp>

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "study/common_places.hpp"

namespace stillpoint {

struct LevelRun {
  ConvergenceLevel level;
  bool is_there = false;                               // the run reached the end that its scene asks for
  double floor = 0;                                    // relative size of errors that are not those of the level
  std::vector<std::pair<std::string, double>> norms;   // errors relative to the exact solution: "u_l2", …
  std::string no_energy;                               // reason why "u_energy" is missing there
  std::vector<std::pair<std::string, double>> probes;  // "tip.u.x" or "load.factor" and its value at the end
  std::vector<double> probe_errors;                    // relative to the exact solution; NaN if there is none
  std::vector<double> u, stress, volume;               // at the points, in order, or at the common places
  std::vector<std::string> notes;
};

/// Runs the scene with one thread. A failure is reported by the level's status. places: the places at which u and
/// stress are read, in a scene of one phase, or of an exact stress its error; null: at the material points.
LevelRun run_level(const Scene& scene, const CommonPlaces* places, const std::function<bool()>& interrupted);

/// Throws SceneError if the scene is refused during its set-up, for example for a probe at a place without material.
void check_set_up(const Scene& scene, const std::function<bool()>& interrupted);

/// Whether all levels have the same material points.
bool has_same_points(const std::vector<Refinement>& refine);

/// Fills quantities and reference, and adds notes; runs: one for each level of the study, in the order of its levels.
void gather_quantities(const Problem& problem, const std::vector<LevelRun>& runs, ConvergenceStudy& study);

/// The name of the quantity by which sources of error are compared: the error in u, or the first probe, or the change
/// of u itself.
std::string figure_of_sources(const std::vector<Refinement>& refine, const LevelRun& run);
/// The change of that quantity from one run to another; NaN if either has no value.
double change(const std::string& figure, const LevelRun& a, const LevelRun& b);

}  // namespace stillpoint
