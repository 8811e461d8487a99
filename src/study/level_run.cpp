#include "study/level_run.hpp"

#include <stillpoint/simulation.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <gsl/gsl_deriv.h>

#include "base/stopwatch.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

struct ExactAlongLine {
  const Expression& u;
  double t;
};

double displacement_at(double x, void* exact) {
  const auto& [u, t] = *static_cast<const ExactAlongLine*>(exact);
  return u({&x, 1}, t);
}

// ∂u/∂x of the exact solution, by central differences.
double exact_strain(const Expression& u, double x, double t, double length) {
  ExactAlongLine exact{u, t};
  const gsl_function function{&displacement_at, &exact};
  double slope = not_known, error = 0;
  gsl_deriv_central(&function, x, 1e-4 * length, &slope, &error);
  return slope;
}

// (Σ V (σ_h − σ)(ε_h − ε)/Σ V σ ε)^½ over the points, of a linear body on a line whose exact stress is known.
double energy_error(const Scene& scene, Simulation& simulation) {
  const LagrangianPhase& phase = simulation.phase();
  if (scene.dim != 1 || !scene.exact_stress || phase.info().nonlinear || phase.info().updated_lagrangian)
    return not_known;
  const double t = simulation.t(), length = scene.grid.max[0] - scene.grid.min[0];
  const PointData points = phase.point_data();
  const ConstVec stress_field = simulation.field("stress");
  const std::vector<double> stress(stress_field.begin(), stress_field.end());
  const ConstVec strain = simulation.field("strain");
  double difference = 0, exact = 0;
  for (std::size_t p = 0; p < points.volumes.size(); ++p) {
    const double x = points.positions[p], V = points.volumes[p];
    const double sigma = (*scene.exact_stress)({&x, 1}, t), epsilon = exact_strain(scene.exact_u[0], x, t, length);
    difference += V * (stress[p] - sigma) * (strain[p] - epsilon);
    exact += V * sigma * epsilon;
  }
  return exact > 0 ? std::sqrt(std::max(0.0, difference) / exact) : not_known;
}

// Of "u", "u.x", "u.y" where the displacement is known, and of "stress" on a line.
double exact_value(const Scene& scene, const std::string& field, ConstVec x, double t) {
  const std::size_t axis = field == "u.y" ? 1 : 0;
  const bool is_u = field == "u" || field == "u.x" || field == "u.y";
  if (is_u && axis < scene.exact_u.size()) return scene.exact_u[axis](x, t);
  if (field == "stress" && scene.dim == 1 && scene.exact_stress) return (*scene.exact_stress)(x, t);
  return not_known;
}

void read_end(const Scene& scene, Simulation& simulation, const Summary& s, LevelRun& run) {
  if (s.error) {
    run.norms = {{"u_l2", s.error->u_rel_l2}, {"u_max", s.error->u_rel_max}};
    if (const double energy = energy_error(scene, simulation); std::isfinite(energy))
      run.norms.emplace_back("u_energy", energy);
    if (s.error->stress_rel_l2) run.norms.emplace_back("stress_l2", *s.error->stress_rel_l2);
  }
  for (const auto& [name, fields] : s.probes) {
    const auto at = s.probe_positions.find(name);
    for (const auto& [field, value] : fields) {
      run.probes.emplace_back(fmt::format("{}.{}", name, field), value);
      run.probe_errors.push_back(
          at == s.probe_positions.end() ? not_known : std::abs(value - exact_value(scene, field, at->second, s.t)));
    }
  }
  const auto copy = [&](const char* name) {
    const ConstVec field = simulation.field(name);
    return std::vector<double>(field.begin(), field.end());
  };
  run.u = copy("u");
  run.stress = copy("stress");
  run.volume = simulation.phase().point_data().volumes;
}

// Files, and rows that steps land on, are none of a study's.
Scene without_files(Scene scene) {
  scene.output.snapshots.clear();
  scene.output.fields_every = 0;
  scene.checkpoint = {};
  if (!scene.stop.wants_equilibrium() && scene.stop.time > 0) scene.output.every = scene.stop.time;
  return scene;
}

}  // namespace

LevelRun run_level(const Scene& scene, const std::function<bool()>& interrupted) {
  const Stopwatch watch;
  LevelRun run;
  ConvergenceLevel& level = run.level;
  try {
    const Scene own = without_files(scene);
    Simulation simulation(own, {.threads = 1, .interrupted = interrupted});
    simulation.run();
    const Summary s = simulation.summary();
    level.status = s.status;
    level.exit_status = s.exit_status;
    level.reason = s.reason;
    level.step = s.dt;
    level.points = s.points;
    level.dofs = s.dofs;
    level.evaluations = s.rhs_evaluations;
    run.notes = s.notes;
    run.is_there = s.exit_status == 0;
    if (run.is_there) read_end(own, simulation, s, run);
  } catch (const SetUpStopped& stopped) {
    level.status = stopped.status();
    level.exit_status = 3;
    level.reason = stopped.what();
  } catch (const SceneError& error) {  // as on a level that needs more memory than there is
    level.status = RunStatus::failed;
    level.exit_status = 2;
    level.reason = error.problems().front().message;
  } catch (const std::exception& error) {
    level.status = RunStatus::failed;
    level.exit_status = 4;
    level.reason = error.what();
  }
  level.wall_s = watch.seconds();
  return run;
}

}  // namespace stillpoint
