// Runs a scene: relaxes it, watches it, writes what was asked.
#pragma once

#include <stillpoint/scene.hpp>

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "simulation/monitor.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {

/// What a run tells while it works.
struct Progress {
  double t = 0, end_time = 0;  // [s]; end_time 0: open
  long steps = 0;
  double residual = 0, residual_goal = 0;  // residual_goal 0: not asked for
  double wall_s = 0;
};

struct RunOptions {
  std::filesystem::path out{};                      // folder for summary.json and history.csv; empty: no files
  int threads = 0;                                  // 0: as many as OpenMP would take
  std::function<bool()> interrupted{};              // asked after every step; true ends the run in good order
  std::function<void(const Progress&)> progress{};  // told a few times a second
  /// Shown where the run ended: the phase, t, u and v.
  std::function<void(const LagrangianPhase&, double, ConstVec, ConstVec)> at_end{};
};

/// A moment at which all fields were written.
struct Snapshot {
  double t = 0;            // [s]
  double slope_angle = 0;  // of the free surface [degrees]; NaN where there is no slope
};

/// Error against the scene's exact solution, over the material points with weights V_p.
struct ExactError {
  double u_rel_l2 = 0, u_rel_max = 0;
  std::optional<double> stress_rel_l2;
};

/// summary.json, as data. Empty: not computed.
struct Summary {
  std::string scene, title;
  RunStatus status = RunStatus::running;
  std::string reason;   // the inequality that ended the run
  int exit_status = 4;  // 0 as asked, 3 not in equilibrium within the limits, 4 diverged or failed
  double t = 0;         // [s]
  long steps = 0, rejected_steps = 0, rhs_evaluations = 0;
  int phases = 1;
  std::size_t points = 0, dofs = 0;
  int threads = 1;
  double wall_s = 0, ns_per_point_step = 0;
  double bytes_per_point = 0;
  double residual = 0, kinetic_energy = 0;
  std::optional<double> distance;  // from equilibrium, certified, relative; of one phase with a known omega_1
  std::optional<double> omega_1;
  double omega_max = 0;
  std::optional<double> c;
  double dt = 0;  // the last step [s]
  std::optional<double> critical_step;
  std::string integrator, damping;
  std::vector<std::string> notes;          // of Model
  std::optional<TransferErrors> transfer;  // of a body that moves on
  std::optional<double> external_work;     // [J]
  std::optional<double> slope_angle;       // at the end, where a probe asks for it [degrees]
  std::vector<Snapshot> snapshots;
  std::optional<ExactError> error;
  std::map<std::string, std::vector<double>>
      probe_positions;  // of each probe's material point when the phase began [m]
  std::map<std::string, std::vector<std::pair<std::string, double>>> probes;  // name → (field, last value)
};

/// Relaxes the scene. Throws SceneError where it cannot be set up (nothing is written then), std::filesystem_error
/// where files cannot be written. A run that goes wrong returns its status, with what it had until then in the files.
Summary run(const Scene& scene, const RunOptions& options = {});

/// The summary as JSON text (DESIGN section 7); figures that are not finite or not computed are null.
std::string to_json(const Summary& summary);

}  // namespace stillpoint
