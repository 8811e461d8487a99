// Comparison of the ways to equilibrium on one scene: speed against error, measured against the exact discrete
// equilibrium and against the Chebyshev estimate ½ √κ ln(2/ε).
#pragma once

#include <stillpoint/scene.hpp>
#include <stillpoint/study_progress.hpp>

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace stillpoint {

struct CompareOptions {
  std::vector<std::string> integrators{};   // empty: leapfrog and a few of ARKODE's
  std::vector<std::string> strategies{};    // damping strategies and static solvers, also "auto:multigrid"; empty: all
  std::vector<double> step_fractions{0.9};  // shares of the critical step, for fixed steps
  std::vector<double> tolerances{1e-3};     // rtol, for adaptive steps
  double goal = 1e-6;                       // relative error at which evaluations and time are read
  double limit = 50;                        // largest number of evaluations, in Chebyshev estimates
  double seconds = 30;                      // largest wall time of one run [s]
  int repeats = 3;                          // timed runs of each combination, in random order
  unsigned seed = 1;                        // seed of that order
  bool overshoot = false;                   // also measure the distance from a slow ramp of the load
  int threads = 0;                          // 0: as many as OpenMP would take, or one where that is quicker
  std::function<bool()> interrupted{};      // asked between runs whether to stop
  std::function<void(const StudyProgress&)> progress{};
};

enum class ComparedStatus {
  converged,   // stayed within the goal; for a transient: reached stop.time with an error below 1
  stalled,     // the error fell by less than a half over the last half of its evaluations
  unfinished,  // not yet within the goal at the limit of evaluations or time
  inaccurate,  // a transient at stop.time with an error as large as the displacement
  diverged,    // a state that cannot be evaluated, or an integrator that gave up
  refused,     // the scene does not go with the combination
  interrupted  // not run
};
std::string to_string(ComparedStatus status);

/// A sample of a run's history, all relative: error ‖u − u*‖_M/‖u*‖_M, residual ‖F − R‖/‖F‖, distance as certified.
struct ComparedSample {
  long evaluations = 0;
  double error = 0, residual = 0;
  std::optional<double> distance;
};

struct Spread {
  double median = 0, least = 0, most = 0;
};

/// One combination of strategy and integrator, and its result.
struct ComparedRun {
  std::string strategy, integrator;
  std::string mass;  // "multigrid"; empty: the mass that the scene names
  std::optional<double> step_fraction, rtol;
  ComparedStatus status = ComparedStatus::refused;
  std::string reason;
  long steps = 0, evaluations = 0;  // until the error reached the goal and stayed there; otherwise all
  long first_evaluations = 0;       // until the error first reached the goal; 0: never
  long estimating = 0;              // evaluations among them that are products K x for the spectrum that the method
                                    // itself needs
  double setup_s = 0;               // time before the first step, as if the run were alone: body, spectrum, factors
  std::vector<std::pair<std::string, double>> setup_parts;  // the parts of setup_s, by name [s]
  std::optional<Spread> wall_s;                             // time of the steps [s]; if it converged
  // At the end of the run; NaN if it did not run.
  double error = std::numeric_limits<double>::quiet_NaN(), residual = std::numeric_limits<double>::quiet_NaN();
  std::optional<double> distance;
  std::optional<double> overshoot;  // ‖u − u_ramp‖_M/‖u_ramp‖_M
  std::size_t memory_bytes = 0;     // of unknowns and points and, in Newton's method, of matrix and factor
  std::vector<ComparedSample> samples;
  std::string label() const;  // "kinetic", "viscous, erk:rk4 0.9", "auto:multigrid"
  /// The time that a user waits for, set-up and steps [s]; empty if the run did not converge.
  std::optional<double> total_s() const { return wall_s ? std::optional(setup_s + wall_s->median) : std::nullopt; }
};

struct Comparison {
  std::string scene, title;
  std::string scene_text;              // contents of the scene's file
  std::vector<std::string> overrides;  // laid over the scene
  std::size_t dofs = 0, points = 0;
  int threads = 1;
  bool chooses_threads = false;  // each run took all threads or one, whichever it found quicker
  bool transient = false;        // error in time at stop.time, against `reference`
  bool by_residual = false;      // with history or friction the goal is one of the residual, since equilibria differ
  double goal = 0;
  std::optional<double> omega_1, omega_max, kappa, chebyshev_estimate;
  std::string reference;  // name of the method that u* comes from
  double reference_residual = 0;
  std::optional<double> ramp_difference;  // distance of the reference, found in one load step, from the slow ramp
  std::vector<ComparedRun> runs;          // in the order in which the options list their names
  std::vector<std::string> notes;
  double wall_s = 0, timed_s = 0;  // time of the whole comparison, and of the timed runs in it

  /// Evaluations of a run over the Chebyshev estimate; empty if there is no estimate, or the run made no evaluation.
  std::optional<double> over_chebyshev_estimate(const ComparedRun& run) const;
};

/// Evaluations that the best polynomial iteration needs at worst for an error ε in a linear system of condition number
/// κ: ½ √κ ln(2/ε) [Axelsson 1994, §13.2]. It is no bound for a given load: a load that excites few modes takes fewer.
double chebyshev_estimate(double kappa, double error);

/// Runs the scene once for each combination to count evaluations, and those that reach the goal `repeats` times to time
/// them, one at a time. Runs of small bodies are counted side by side and then timed; a run of a large body is timed as
/// it is counted, its steps alone. A set-up that several runs share is made once, and counts for each of them. A
/// combination that the scene refuses is a row with the reason. Throws SceneError if a name in the options, written as
/// for --set, is unknown.
Comparison compare(const Scene& scene, const CompareOptions& options = {});

/// The text of compare.json.
std::string to_json(const Comparison& comparison);
/// Writes compare.csv, compare.json and report.html into a folder.
void write_comparison(const Comparison& comparison, const std::filesystem::path& folder);

}  // namespace stillpoint
