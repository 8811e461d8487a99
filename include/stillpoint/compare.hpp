// Many ways to rest on one scene, side by side: speed against error, measured against the exact discrete equilibrium
// and against the Chebyshev estimate ½ √κ ln(2/ε).
#pragma once

#include <stillpoint/problem.hpp>
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
  std::vector<std::string> strategies{};    // of damping, and static solvers, also "auto:multigrid"; empty: all
  std::vector<double> step_fractions{0.9};  // of the critical step, for fixed steps
  std::vector<double> tolerances{1e-3};     // rtol, for adaptive steps
  double goal = 1e-6;                       // relative error at which evaluations and time are read
  double limit = 50;                        // evaluations at most, in Chebyshev estimates
  double seconds = 30;                      // wall time at most of one run
  int repeats = 3;                          // timed ones, in random order
  unsigned seed = 1;                        // of that order
  bool overshoot = false;                   // also the distance from a slow ramp of the load
  int threads = 0;                          // 0: as many as OpenMP would take, or one where that is quicker
  std::function<bool()> interrupted{};      // asked between runs
  std::function<void(const StudyProgress&)> progress{};
};

enum class ComparedStatus {
  converged,   // to the goal, and stayed there; of a transient: at stop.time with an error below 1
  stalled,     // its error fell by less than a half over the last half of its evaluations
  unfinished,  // still on the way at the limit
  inaccurate,  // a transient at stop.time with an error as large as the displacement
  diverged,    // a state that cannot be evaluated, or an integrator that gave up
  refused,     // the scene does not go with it
  interrupted  // not run
};
std::string to_string(ComparedStatus status);

/// A point of a run's way. Each is relative: error ‖u − u*‖_M/‖u*‖_M, residual ‖F − R‖/‖F‖, distance as certified.
struct ComparedSample {
  long evaluations = 0;
  double error = 0, residual = 0;
  std::optional<double> distance;
};

struct Spread {
  double median = 0, least = 0, most = 0;
};

/// One way to rest, and how it went.
struct ComparedRun {
  std::string strategy, integrator;
  std::string mass;  // "multigrid"; empty: that of the scene
  std::optional<double> step_fraction, rtol;
  ComparedStatus status = ComparedStatus::refused;
  std::string reason;
  long steps = 0, evaluations = 0;  // until the error had reached the goal and stayed there; otherwise all
  long first_evaluations = 0;       // until it first was at the goal; 0: never
  long estimating = 0;              // products K x spent on the spectrum that the method itself needs, of evaluations
  double setup_s = 0;               // everything before the first step, as if it were alone: body, spectrum, factors
  std::vector<std::pair<std::string, double>> setup_parts;  // what of it takes time, by name [s]
  std::optional<Spread> wall_s;                             // of those steps; if it converged
  // At the end; NaN if it did not run.
  double error = std::numeric_limits<double>::quiet_NaN(), residual = std::numeric_limits<double>::quiet_NaN();
  std::optional<double> distance;
  std::optional<double> overshoot;  // ‖u − u_ramp‖_M/‖u_ramp‖_M
  std::size_t memory_bytes = 0;     // of unknowns, points and, of Newton's method, matrix and factor
  std::vector<ComparedSample> samples;
  std::string label() const;  // "kinetic", "viscous, erk:rk4 0.9", "auto:multigrid"
  /// What a user waits for: set-up and steps; if it converged [s].
  std::optional<double> total_s() const { return wall_s ? std::optional(setup_s + wall_s->median) : std::nullopt; }
};

struct Comparison {
  std::string scene, title;
  std::string scene_text;              // of its file
  std::vector<std::string> overrides;  // laid over it
  std::size_t dofs = 0, points = 0;
  int threads = 1;
  bool chooses_threads = false;  // each run took all of them or one, whichever it found quicker
  bool transient = false;        // error in time at stop.time, against `reference`
  bool by_residual = false;      // history or friction: the goal is one of the residual, since equilibria differ
  double goal = 0;
  std::optional<double> omega_1, omega_max, kappa, chebyshev_estimate;
  std::string reference;  // what u* is from
  double reference_residual = 0;
  std::optional<double> ramp_difference;  // of the reference, one load step, from the slow ramp
  std::vector<ComparedRun> runs;          // in the order of their names' lists
  std::vector<std::string> notes;
  double wall_s = 0, timed_s = 0;  // all of it, and what of it the timed runs took

  /// Evaluations of a run over the Chebyshev estimate; nothing if there is none, or if it made none.
  std::optional<double> over_chebyshev_estimate(const ComparedRun& run) const;
};

/// Evaluations that the best polynomial iteration needs at worst for an error ε in a linear system of condition number
/// κ: ½ √κ ln(2/ε) [Axelsson 1994, §13.2]. No bound for a given load: one that excites few modes takes fewer.
double chebyshev_estimate(double kappa, double error);

/// Runs the scene once for each combination to count, and those that reach the goal `repeats` times to time them, one
/// at a time: small bodies' runs are counted side by side and then timed, a large one's is timed as it is counted, its
/// steps alone. What their set-ups have in common is made once, and counts for each. A combination that the scene
/// refuses is a row with the reason. Throws SceneError if the scene itself is wrong, or a name in the options is none
/// (in the words of --set).
Comparison compare(const std::filesystem::path& scene, const std::vector<std::string>& overrides,
                   const CompareOptions& options = {});

/// compare.csv, compare.json and report.html in a folder.
void write_comparison(const Comparison& comparison, const std::filesystem::path& folder);

}  // namespace stillpoint
