#include "scene/input/validation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "scene/input/keys.hpp"
#include "scene/input/scene_check.hpp"

namespace stillpoint {
namespace {

/// Sets the defaults that depend on other keys.
void complete(SceneCheck& check) {
  Scene& scene = check.scene();
  for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
    BodySpec& body = scene.bodies[k];
    if (!check.written(check.body_key(k, "min"))) body.min = scene.grid.min;
    if (!check.written(check.body_key(k, "max"))) body.max = scene.grid.max;
    body.points_per_cell.resize(static_cast<std::size_t>(scene.dim), body.points_per_cell[0]);
    if (!body.file.empty()) body.file = scene.file.parent_path() / body.file;
    if (!body.stl.empty()) body.stl = scene.file.parent_path() / body.stl;
  }
  const auto state = std::ranges::find_if(scene.bodies, [](const BodySpec& body) { return body.state.has_value(); });
  scene.state = state != scene.bodies.end() ? *state->state
                : scene.dim == 1            ? StressState::uniaxial_stress
                : scene.dim == 2            ? StressState::plane_strain
                                            : StressState::space;
  for (std::size_t k = 0; k < scene.supports.size(); ++k) {
    SupportSpec& support = scene.supports[k];
    const std::string component = fmt::format("support[{}].component", k);
    constexpr int r = 3;  // after x, y, z
    if (support.component >= r) {
      if (scene.state != StressState::axisymmetric)
        check.add(component, "r and z are the axes of an axisymmetric scene; expected x or y");
      support.component -= r;
    }
    if (!support.face) continue;
    if (check.written(component)) {
      support.roller = true;
    } else {
      support.component = axis_of(*support.face);
    }
  }
}

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
  if (check.written("integrator.step"))
    check.refuse("integrator", {"step_fraction"}, "give either step or step_fraction, not both");
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
  const bool limited = (check.written("stop.steps") && stop.steps > 0) || stop.wall_time > 0;
  if (!stop.wants_equilibrium() && stop.time == 0 && !limited)
    check.add("stop.residual", "nothing would ever stop this run: set residual, distance, time, steps or wall_time");
}

}  // namespace

bool check_grid(SceneCheck& check) {
  const GridSpec& grid = check.scene().grid;
  if (check.scene().dim == 3 && grid.basis == BasisKind::hermite)
    check.add("grid.basis", "'hermite' is a basis of the line and the plane; in space take \"cubic\"");
  if (grid.min.empty() || grid.max.empty()) return false;
  for (std::size_t axis = 0; axis < grid.min.size(); ++axis) {
    const double length = grid.max[axis] - grid.min[axis];
    if (!(length > 0)) {
      check.add(check.axis_key("grid.max", axis),
                fmt::format("must be greater than {} = {}, not {}", check.axis_key("grid.min", axis), grid.min[axis],
                            grid.max[axis]));
      return false;
    }
    if (!std::isfinite(length)) {
      check.add(check.axis_key("grid.max", axis), "the grid's length is not a finite number");
      return false;
    }
    // Grid lines a few roundings apart could not be told from each other.
    const double largest = std::max(std::abs(grid.min[axis]), std::abs(grid.max[axis]));
    constexpr double relative = 1e-12;
    if (!grid.cells.empty() &&
        !(length / grid.cells[axis] > relative * largest && length / grid.cells[axis] > 1e-300)) {
      check.add(check.axis_key("grid.cells", axis),
                fmt::format("{} cells between {} and {} are too small for double precision", grid.cells[axis],
                            grid.min[axis], grid.max[axis]));
      return false;
    }
  }
  if (check.scene().state == StressState::axisymmetric && grid.min[0] < 0)
    check.add("grid.min[0]", fmt::format("is a radius in an axisymmetric scene, at least 0, not {}", grid.min[0]));
  constexpr double most = 1e8;  // about 1 GB for a vector of a plane grid's unknowns
  double cells = 1;
  for (const int along : grid.cells) cells *= along;
  if (cells > most) {
    check.add("grid.cells", fmt::format("{:.3g} cells are more than this program takes ({:g})", cells, most));
    return false;
  }
  return true;
}

void validate(Scene& scene, Reading& reading, const Catalogue& catalogue) {
  SceneCheck check(scene, reading, catalogue);
  complete(check);
  const bool grid = check_grid(check);
  const std::optional<BodyBox> body = check_bodies(check, grid);
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
