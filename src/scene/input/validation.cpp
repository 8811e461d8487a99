#include "scene/input/validation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scene/input/keys.hpp"
#include "scene/input/scene_check.hpp"

namespace stillpoint {
namespace {

void check_mass(SceneCheck& check) {
  const MassSpec& mass = check.scene().mass;
  const bool scaled = mass.scaling == MassScaling::gershgorin || mass.factor != 1;
  if (scaled && mass.kind != MassKind::lumped && check.sound("mass.kind"))
    check.add("mass.scaling", "needs mass.kind = \"lumped\"");
}

/// What a mass that only M⁻¹ is known of cannot do.
void check_multigrid(SceneCheck& check) {
  const Scene& scene = check.scene();
  if (scene.mass.kind != MassKind::multigrid || !check.sound("mass.kind")) return;
  const std::string key = "mass.kind";
  const auto refuse = [&](const std::string& why) { check.add(key, "'multigrid' " + why); };
  if (!scene.stop.wants_equilibrium() || loads_vary(scene)) {
    refuse(
        "is a fictitious inertia, whose motion means nothing: take it where equilibrium under steady loads is all "
        "that is asked for");
  }
  if (scene.grid.basis == BasisKind::hermite) refuse("needs a basis of values alone; take linear, quadratic or cubic");
  if (!scene.initial_v.empty()) refuse("has no velocities to begin with; leave out initial.v");
  if (scene.solve.is_static()) {
    const StaticMethodInfo* const method = check.catalogue().static_method(scene.solve.method);
    if (method && method->factorises)
      refuse("has no part in a method that factorises K; take solve.method = \"newton-cg\", \"cg\" or \"lbfgs\"");
    return;
  }
  const StrategyInfo* const strategy = check.catalogue().strategy(scene.damping.strategy);
  if (!strategy) return;
  if (strategy->is_local || strategy->is_identity)
    refuse(fmt::format("couples all degrees of freedom, and damping '{}' takes each by itself; take viscous or auto",
                       strategy->name));
  if (strategy->is_relaxation && !strategy->takes_inverse_mass)
    refuse(fmt::format("has no products with M, which '{}' needs; take viscous, kinetic, adaptive or auto",
                       strategy->name));
  if (strategy->uses("quotient") && scene.damping.quotient == Quotient::diagonal)
    check.add("damping.quotient", "'diagonal' needs products with M, which mass.kind = \"multigrid\" has none of");
  if (scene.integrator.rtol) refuse("has no velocities to be accurate in; leave out integrator.rtol");
}

void check_integrator(SceneCheck& check) {
  const Scene& scene = check.scene();
  const IntegratorSpec& spec = scene.integrator;
  if (spec.step_fraction > 1 && spec.unstable_reason.empty())
    check.add("integrator.step_fraction",
              fmt::format("{} of the critical step is unstable; say in unstable_reason why you want it, or stay at or "
                          "below 1",
                          spec.step_fraction));
  if (spec.step) check.refuse("integrator", {"step_fraction"}, "give either step or step_fraction, not both");
  const MethodInfo* const method = check.catalogue().method(spec.method);
  if (!method || !check.sound("integrator.method")) return;
  const auto& treatments = method->treatments;
  const bool fits = std::ranges::find(treatments, spec.treatment) != treatments.end();
  if (!fits) {
    std::vector<std::string> names;
    for (const DampingTreatment one : treatments) names.emplace_back(kTreatments[static_cast<std::size_t>(one)]);
    check.add("integrator.damping", fmt::format("this treatment does not go with method '{}', which takes {}",
                                                spec.method, names.size() > 1 ? either(names) : names[0] + " only"));
  }
  const StrategyInfo* const strategy = check.catalogue().strategy(scene.damping.strategy);
  if (fits && spec.treatment == DampingTreatment::exact && strategy && strategy->is_identity &&
      scene.mass.kind == MassKind::consistent)
    check.add("integrator.damping",
              "'exact' needs C and M diagonal together: take mass.kind = \"lumped\" or damping.strategy = \"viscous\"");
  if (spec.rtol && !method->adaptive)
    check.add("integrator.rtol", fmt::format("method '{}' has no error estimate; leave rtol out", spec.method));
  if (!spec.rtol && !method->fixed_step)
    check.add("integrator.method", fmt::format("method '{}' has no fixed step: give integrator.rtol", spec.method));
}

/// What goes with a way to rest in time.
void check_strategy(SceneCheck& check) {
  const Scene& scene = check.scene();
  const StrategyInfo* const found = check.catalogue().strategy(scene.damping.strategy);
  if (!found || !check.sound("damping.strategy")) return;
  const StrategyInfo& info = *found;
  for (const char* key : {"c", "alpha", "peak", "quotient"}) {
    if (info.takes(key)) continue;
    std::vector<std::string> owners;
    for (const StrategyInfo& other : check.catalogue().strategies)
      if (std::ranges::find(other.keys, key) != other.keys.end()) owners.push_back(fmt::format("\"{}\"", other.name));
    check.refuse("damping", {key}, fmt::format("goes with strategy = {}, not with '{}'", either(owners), info.name));
  }
  const std::string& method = scene.integrator.method;
  if (check.sound("integrator.method") && !info.goes_with(method)) {
    check.add(check.written("integrator.method") ? "integrator.method" : "damping.strategy",
              fmt::format("damping '{}' does not go with method '{}'; it goes with {}", info.name, method,
                          fmt::join(info.integrators, ", ")));
    return;
  }
  if (!info.is_relaxation) return;
  if (scene.integrator.treatment != DampingTreatment::automatic)
    check.add("integrator.damping", fmt::format("damping '{}' is no C v to be treated; leave this out", info.name));
  if (info.has_own_step)
    check.refuse("integrator", {"step", "step_fraction"},
                 fmt::format("damping '{}' has its own step; leave this out", info.name));
  const auto moves = [](const WallSpec& wall) { return wall.motion.uses('t'); };
  if (info.resets_velocity && std::ranges::any_of(scene.walls, moves))
    check.add("damping.strategy",
              fmt::format("'{}' sets velocities to zero, also those that a moving wall gives; take viscous, adaptive, "
                          "auto or a local damping",
                          info.name));
}

/// What a solver without time cannot do.
void check_static_solver(SceneCheck& check, const StaticMethodInfo& info) {
  const Scene& scene = check.scene();
  const std::string key = "solve.method";
  for (const std::string_view table : kTablesOfMotion)
    for (const auto& [path, where] : scene.where)
      if (path.starts_with(std::string(table) + "."))
        check.add(path, fmt::format("has no part in a static solution; leave it out, or take solve.method = \"{}\"",
                                    SolveSpec().method));
  if (!scene.walls.empty())
    check.add(key, fmt::format("'{}' is a static solver, in which no wall can open or close; take \"{}\"", info.name,
                               SolveSpec().method));
  if (!scene.initial_v.empty())
    check.add("initial.v", fmt::format("'{}' is a static solver, which has no velocity", info.name));
  if (!loads_vary(scene)) return;
  if (!info.takes_end_of_loads) {
    check.add(key, fmt::format("'{}' is a static solver, which has no time: loads and supports must not depend on t",
                               info.name));
  } else if (scene.stop.time == 0) {
    check.add(key, fmt::format("'{}' is a static solver, which has no time: loads and supports depend on t, so give "
                               "stop.time, at which it takes them",
                               info.name));
  }
}

void check_stop(SceneCheck& check) {
  const StopSpec& stop = check.scene().stop;
  // The default number of steps guards against endless runs; it is no aim that a scene may rely on.
  const bool limited =
      (check.given("stop.steps", stop.steps != StopSpec().steps) && stop.steps > 0) || stop.wall_time > 0;
  if (!stop.wants_equilibrium() && stop.time == 0 && !limited)
    check.add("stop.residual", "nothing would ever stop this run: set residual, distance, time, steps or wall_time");
}

}  // namespace

bool check_grid(SceneCheck& check) {
  const Scene& scene = check.scene();
  const GridSpec& grid = scene.grid;
  if (scene.dim == 3 && grid.basis == BasisKind::hermite)
    check.add("grid.basis", "'hermite' is a basis of the line and the plane; in space take \"cubic\"");
  if (scene.state == StressState::axisymmetric && !grid.min.empty() && grid.min[0] < 0)
    check.add("grid.min[0]", fmt::format("is a radius in an axisymmetric scene, at least 0, not {}", grid.min[0]));
  const GridFault fault = fault_of_grid(scene);
  if (fault.empty()) return true;
  const std::string key = fault.key.empty() ? "grid" : "grid." + fault.key;
  const bool was_reported = fault.key.empty() && !check.problems().empty();  // where it was read
  if (!was_reported)
    check.add(fault.axis < 0 ? key : check.axis_key(key, static_cast<std::size_t>(fault.axis)), fault.message);
  return false;
}

void validate(const Scene& scene, const std::vector<FileMistake>& files, Reading& reading, const Catalogue& catalogue) {
  SceneCheck check(scene, reading, catalogue);
  const bool grid = check_grid(check);
  const std::optional<BodyBox> body = check_bodies(check, grid, files);
  check_mass(check);
  check_multigrid(check);
  check_supports_and_walls(check, grid);
  check_loads(check, body);
  check_exact(check, body.has_value());
  check_phases(check, grid);
  check_output(check, body);
  if (const StaticMethodInfo* const solver = catalogue.static_method(scene.solve.method)) {
    check_static_solver(check, *solver);
  } else {
    if (check.written("solve.load_steps"))
      check.add("solve.load_steps", "has no part in a motion; leave it out, or take solve.method = \"newton\"");
    check_integrator(check);
    check_strategy(check);
  }
  check_stop(check);
  check.unique_names("variant", scene.variants);
}

}  // namespace stillpoint
