// Convergence studies: one scene on ever finer levels, its errors, and their observed orders.
#pragma once

#include <stillpoint/problem.hpp>
#include <stillpoint/study_progress.hpp>
#include <stillpoint/summary.hpp>

#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stillpoint {

/// What becomes finer from level to level.
enum class Refinement {
  h,       // grid.cells along all axes
  points,  // points per cell along all axes
  step,    // integrator.step, or integrator.step_fraction
  rtol,    // integrator.rtol
  motion   // phase.max_motion
};
std::string to_string(Refinement refinement);
/// Empty if there is none of this name.
std::optional<Refinement> refinement_of(std::string_view name);

struct ConvergeOptions {
  std::vector<Refinement> refine{Refinement::h};  // all of them from level to level; errors are set against the first
  int levels = 4;                                 // 2 at least
  double ratio = 2;                               // of sizes from level to level, above 1
  bool finds_dominant = true;                     // whether runs are spent on which error is the largest
  int threads = 0;                                // levels side by side; 0: as many as OpenMP would take
  std::filesystem::path keep{};                   // folder in which finished runs are kept; empty: nowhere
  bool resumes = false;                           // whether runs that are kept there are taken, and not made again
  std::function<bool()> interrupted{};
  std::function<void(const StudyProgress&)> progress{};
};

/// A key of the scene, and its values: a series of levels with each of them.
struct Variation {
  std::string key;
  std::vector<std::string> values;  // as for --set
};
/// Of "grid.basis=linear,quadratic". Throws SceneError.
Variation variation_of(const std::string& text);

struct ConvergenceLevel {
  std::vector<std::string> set;  // what the scene is given for it, "key=value"
  double size = 0;  // of what is refined first: h [m], 1/points per cell, step [s], rtol or share of a cell
  double h = 0;     // the longest side of a cell [m]
  double step = 0;  // the last [s]
  std::size_t points = 0, dofs = 0;
  long evaluations = 0;
  double wall_s = 0;
  RunStatus status = RunStatus::interrupted;
  int exit_status = 3;
  std::string reason;
};

/// With its 95 % interval, NaN of two levels.
struct ObservedOrder {
  double order = 0;
  double low = std::numeric_limits<double>::quiet_NaN(), high = low;
  std::size_t first = 0, last = 0;  // of the levels that it is of, from 0
};

/// One figure on all levels.
struct StudiedQuantity {
  std::string name;              // "u_l2", "u_max", "u_energy", "stress_l2", or "probe.field"
  std::vector<double> values{};  // errors, or the values of a probe; NaN where a level has none, (levels)
  std::vector<double> errors{};  // against the reference; likewise
  std::optional<ObservedOrder> order{};
  std::optional<double> theory{};        // the order that the basis or the method has for smooth solutions
  std::optional<double> extrapolated{};  // of a probe: Richardson's
};

/// How far a quantity moves if one thing alone is refined, at the finest level but one.
struct ErrorSource {
  std::string name;  // "space", "quadrature", "time", "phases", "the relaxation's stop"
  double change = 0;
};

struct ConvergenceStudy {
  std::string scene, title;
  std::string scene_text;              // of its file
  std::vector<std::string> overrides;  // laid over it in all series
  std::vector<std::string> varied;     // what the series is given beside the overrides, "key=value"
  std::vector<Refinement> refined;
  double ratio = 2;
  std::string reference;  // what errors are measured against
  std::vector<ConvergenceLevel> levels;
  std::vector<StudiedQuantity> quantities;
  std::string source_quantity;       // the quantity that the sources are found by
  std::vector<ErrorSource> sources;  // the largest first; empty: not looked for
  std::vector<std::string> notes;
  bool interrupted = false;
  std::size_t runs = 0, finished_runs = 0;  // of levels and of sources
};

/// Runs the scene on each level. Where h or points are refined errors are those against the scene's exact solution, and
/// without one those against the finest level at the same places, and of the probes against Richardson's extrapolation;
/// where points stay the same from level to level, those against the finest level. Throws SceneError if the scene is
/// wrong, or has nothing of what is to be refined.
ConvergenceStudy converge(const std::filesystem::path& scene, const std::vector<std::string>& overrides,
                          const ConvergeOptions& options = {});

/// The same for each value that is varied, or each pair of values of two keys, one series after the other. Throws
/// SceneError before anything runs if one of them cannot be, and StateError if a run that is kept is not one of these.
std::vector<ConvergenceStudy> converge_varied(const std::filesystem::path& scene,
                                              const std::vector<std::string>& overrides,
                                              const std::vector<Variation>& varied,
                                              const ConvergeOptions& options = {});

/// converge.csv, converge.json and report.html in a folder.
void write_study(const ConvergenceStudy& study, const std::filesystem::path& folder);
/// Of all series: with a column for each varied key, and a list of series.
void write_studies(const std::vector<ConvergenceStudy>& series, const std::filesystem::path& folder);

}  // namespace stillpoint
