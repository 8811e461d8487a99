// Convergence studies: one scene on ever finer levels, its errors, and their observed orders.
#pragma once

#include <stillpoint/scene.hpp>
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

/// The quantity that becomes finer from level to level.
enum class Refinement {
  h,       // grid.cells along all axes, or those of each of their pieces
  points,  // points per cell along all axes
  step,    // integrator.step, or integrator.step_fraction
  rtol,    // integrator.rtol
  motion   // phase.max_motion
};
std::string to_string(Refinement refinement);
/// The refinement of this name; empty if there is none.
std::optional<Refinement> refinement_of(std::string_view name);

struct ConvergeOptions {
  std::vector<Refinement> refine{Refinement::h};  // all of them change from level to level; errors are plotted against
                                                  // the first
  int levels = 4;                                 // at least 2
  double ratio = 2;                               // ratio of sizes from level to level, above 1
  bool finds_dominant = true;                     // whether extra runs find which error is the largest
  int threads = 0;                                // threads for levels side by side; 0: as many as OpenMP would take
  std::filesystem::path keep{};                   // folder in which finished runs are kept; empty: nowhere
  bool resumes = false;                           // whether runs that `keep` holds are reused
  std::function<bool()> interrupted{};
  std::function<void(const StudyProgress&)> progress{};
};

/// A scene for a series of levels.
struct VariedScene {
  Scene scene;
  std::vector<std::string> varied;  // the last of its overrides: those that differ from series to series
};
/// A key of the scene and the values that it takes, each of which gives a series of levels.
struct Variation {
  std::string key;
  std::vector<std::string> values;  // as for --set
};
/// Reads a variation such as "grid.basis=linear,quadratic". Throws SceneError.
Variation variation_of(const std::string& text);
/// The settings of each series, "key=value" as for --set: one for each value of the variation, or for each pair of
/// values of two. Throws SceneError.
std::vector<std::vector<std::string>> settings_of_series(const std::vector<std::string>& vary);

struct ConvergenceLevel {
  std::vector<std::string> set;  // settings of the scene on this level, "key=value"
  double size = 0;  // size of the first refined quantity: h [m], 1/points per cell, step [s], rtol or share of a cell
  double h = 0;     // the longest side of a cell; of an axis of unequal ones, of their mean [m]
  double step = 0;  // length of the last step [s]
  std::size_t points = 0, dofs = 0;
  long evaluations = 0;
  double wall_s = 0;
  RunStatus status = RunStatus::interrupted;
  int exit_status = 3;
  std::string reason;
};

/// An observed order of convergence with its 95 % interval, which is NaN if only two levels are known.
struct ObservedOrder {
  double order = 0;
  double low = std::numeric_limits<double>::quiet_NaN(), high = low;
  std::size_t first = 0, last = 0;  // first and last level that it is observed on, counted from 0
};

/// One quantity, on all levels. Names: "u_l2", "u_max", "u_energy", "stress_l2" of the points' stress, "stress_read_l2"
/// of that which probes read, or "probe.field".
struct StudiedQuantity {
  std::string name;
  std::vector<double> values{};  // errors, or the values of a probe; NaN where a level has none, (levels)
  std::vector<double> errors{};  // errors against the reference; NaN where a level has none, (levels)
  std::optional<ObservedOrder> order{};
  std::optional<double> theory{};        // the order that the basis or the method has for smooth solutions
  std::optional<double> extrapolated{};  // Richardson's extrapolation of a probe
};

/// The change of a quantity if one source of error alone is refined, at the last level but one.
struct ErrorSource {
  std::string name;  // "space", "quadrature", "time", "phases", "the relaxation's stop"
  double change = 0;
};

struct ConvergenceStudy {
  std::string scene, title;
  std::string scene_text;              // contents of the scene's file
  std::vector<std::string> overrides;  // laid over the scene in all series
  std::vector<std::string> varied;     // settings of this series beside the overrides, "key=value"
  std::vector<Refinement> refined;
  double ratio = 2;
  std::string reference;  // name of what errors are measured against
  std::vector<ConvergenceLevel> levels;
  std::vector<StudiedQuantity> quantities;
  std::string source_quantity;       // the quantity by which the sources are found
  std::vector<ErrorSource> sources;  // the largest first; empty: not looked for
  std::vector<std::string> notes;
  bool interrupted = false;
  std::size_t runs = 0, finished_runs = 0;  // of levels and of sources of error
};

/// Runs the scene on each level. Where h or points are refined, errors are measured against the scene's exact solution
/// or, without one, against the finest level at the same places, and those of the probes against Richardson's
/// extrapolation; where the points stay the same from level to level, errors are measured against the finest level.
/// Throws SceneError if the scene lacks the quantity that is to be refined, and std::invalid_argument if an option is
/// out of its range.
ConvergenceStudy converge(const Scene& scene, const ConvergeOptions& options = {});

/// Runs converge() for each scene, one series after the other. Throws likewise, before anything runs, if one of the
/// series is impossible, and StateError if a kept run belongs to none of them.
std::vector<ConvergenceStudy> converge_varied(const std::vector<VariedScene>& scenes,
                                              const ConvergeOptions& options = {});

/// The text of converge.json: all series, as a list if something varies.
std::string to_json(const std::vector<ConvergenceStudy>& series);
/// Writes converge.csv, converge.json and report.html into a folder.
void write_study(const ConvergenceStudy& study, const std::filesystem::path& folder);
/// Writes all series, with a column for each varied key and a list of series.
void write_studies(const std::vector<ConvergenceStudy>& series, const std::filesystem::path& folder);

}  // namespace stillpoint
