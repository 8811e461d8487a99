#include "study/level_run.hpp"

#include <stillpoint/exact_solution.hpp>
#include <stillpoint/simulation.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "output/exact_error.hpp"
#include "output/point_fields.hpp"
#include "simulation/parts.hpp"
#include "space/phase/lagrangian_phase.hpp"

namespace stillpoint {
namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

// The exact value of a field's component; NaN unless it is a displacement or a known stress.
double exact_value(const ExactSolution* exact, const LagrangianPhase& phase, const std::string& field, ConstVec x,
                   double t) {
  const auto [name, component, components] = find_point_field(phase, field);
  const bool is_stress = name == "stress";
  if (!exact || !(name == "u" || (is_stress && exact->has_stress()))) return not_known;
  std::vector<double> values(components, not_known);
  if (is_stress) {
    exact->stress(x, t, values);
  } else {
    exact->displacement(x, t, values);
  }
  return values[component];
}

// Fields at the places in a single phase only: shape functions belong to positions at the beginning of a phase.
std::optional<FieldsAtPlaces> fields_at(const CommonPlaces& places, Simulation& simulation) {
  const LagrangianPhase& phase = simulation.parts().phase;
  if (phase.info().updated_lagrangian) return std::nullopt;
  const auto reader = phase.fields().read_places(simulation.t(), simulation.u(), simulation.v());
  return read_at(places, *reader, static_cast<std::size_t>(phase.info().stress_components));
}

// ‖σ_h − σ‖/‖σ‖ of the stress that probes read, over the places.
double error_of_read_stress(const CommonPlaces& places, const std::vector<double>& stress, const ExactSolution& exact,
                            double t) {
  const std::size_t components = stress.size() / places.size(), dim = places.x.size() / places.size();
  std::vector<double> sigma(components);
  double difference = 0, size = 0;
  for (std::size_t k = 0; k < places.size(); ++k) {
    exact.stress({places.x.data() + dim * k, dim}, t, sigma);
    size += places.volume[k] * contracted(sigma);
    for (std::size_t i = 0; i < components; ++i) sigma[i] -= stress[components * k + i];
    difference += places.volume[k] * contracted(sigma);
  }
  return std::sqrt(difference / size);
}

void read_end(const Scene& scene, Simulation& simulation, const Summary& s, const CommonPlaces* places, LevelRun& run) {
  if (s.error) {
    run.norms = {{"u_l2", s.error->u_rel_l2}, {"u_max", s.error->u_rel_max}};
    const EnergyError energy = energy_error(scene, simulation.parts().phase, s.t, simulation.u());
    if (energy.relative) run.norms.emplace_back("u_energy", *energy.relative);
    run.no_energy = energy.why_not;
    if (s.error->stress_rel_l2) run.norms.emplace_back("stress_l2", *s.error->stress_rel_l2);
  }
  const auto exact = exact_solution(scene);
  for (const auto& [name, fields] : s.probes) {
    const auto at = s.probe_positions.find(name);
    for (const auto& [field, value] : fields) {
      run.probes.emplace_back(fmt::format("{}.{}", name, field), value);
      run.probe_errors.push_back(
          at == s.probe_positions.end()
              ? not_known
              : std::abs(value - exact_value(exact.get(), simulation.parts().phase, field, at->second, s.t)));
    }
  }
  if (s.load) {
    run.probes.emplace_back("load.factor", s.load->factor);
    run.probe_errors.push_back(not_known);
  }
  if (places && exact) {
    if (!s.error || !exact->has_stress()) return;
    if (const auto fields = fields_at(*places, simulation))
      run.norms.emplace_back("stress_read_l2", error_of_read_stress(*places, fields->stress, *exact, s.t));
    return;
  }
  if (places) {
    auto fields = fields_at(*places, simulation);
    if (!fields) return;
    run.u = std::move(fields->u);
    run.stress = std::move(fields->stress);
    run.volume = places->volume;
    return;
  }
  const auto copy = [&](const char* name) {
    const ConstVec field = simulation.field(name);
    return std::vector<double>(field.begin(), field.end());
  };
  run.u = copy("u");
  run.stress = copy("stress");
  run.volume = simulation.parts().phase.fields().point_data().volumes;
}

// The relative error from other sources than the level: rounding, amplified in an equilibrium by its condition number
// κ = (ω_max/ω₁)², and the residual: a solver that stops at a residual r is off by about as much, and by several times
// more in soft modes.
double floor_of(const Scene& scene, const Summary& s) {
  constexpr double rounding = 1e-13, of_unknown_condition = 1e-12, times_more = 10;
  if (!scene.solve.is_static() && !scene.stop.wants_equilibrium()) return rounding;
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  const double condition = s.omega_1 && *s.omega_1 > 0 ? s.omega_max / *s.omega_1 * (s.omega_max / *s.omega_1) : 0;
  return std::max(condition > 0 ? std::max(rounding, epsilon * condition) : of_unknown_condition,
                  times_more * s.residual);
}

// Removes output files and output rows that the steps would have to land on, as a study needs neither.
Scene without_files(Scene scene) {
  scene.output.snapshots.clear();
  scene.output.fields_every = 0;
  scene.checkpoint = {};
  if (!scene.stop.wants_equilibrium() && scene.stop.time > 0) scene.output.every = scene.stop.time;
  return scene;
}

}  // namespace

LevelRun run_level(const Scene& scene, const CommonPlaces* places, const std::function<bool()>& interrupted) {
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
    run.floor = floor_of(own, s);
    level.wall_s = watch.seconds();  // reading the results is not included
    if (run.is_there) read_end(own, simulation, s, places, run);
  } catch (const SetUpStopped& stopped) {
    level.status = stopped.status();
    level.exit_status = 3;
    level.reason = stopped.what();
  } catch (const SceneError& error) {  // for example on a level that needs more memory than there is
    level.status = RunStatus::failed;
    level.exit_status = 2;
    level.reason = error.problems().front().message;
  } catch (const std::exception& error) {
    level.status = RunStatus::failed;
    level.exit_status = 4;
    level.reason = error.what();
  }
  if (level.wall_s == 0) level.wall_s = watch.seconds();
  return run;
}

void check_set_up(const Scene& scene, const std::function<bool()>& interrupted) {
  try {
    const Simulation simulation(without_files(scene), {.threads = 1, .interrupted = interrupted});
  } catch (const SceneError&) {
    throw;
  } catch (const std::exception&) {
    // for example an interrupt, or a frequency that is not found: the run of the level reports it
  }
}

}  // namespace stillpoint
