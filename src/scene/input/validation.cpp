// The order of all checks of a scene, and those of its grid, mass, integrator, damping, solver and stop.
#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "scene/grid_fault.hpp"
#include "scene/input/keys.hpp"
#include "scene/input/scene_check.hpp"
#include "scene/stages.hpp"

namespace stillpoint {
namespace {

/// The axes of a grid are given by pieces or by min, max and cells. True if what is written of its pieces could be
/// read.
bool check_pieces(SceneCheck& check, const Scene& scene) {
  constexpr std::array axes = {"x", "y", "z"};
  bool sound = true;
  std::string given;
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(scene.dim); ++axis) {
    const std::string key = fmt::format("grid.{}", axes.at(axis));
    sound = sound && check.sound(key);
    if (given.empty() && check.given(key, !scene.grid.pieces.at(axis).empty())) given = key;
  }
  check.refuse_if(!given.empty(), "grid", {"min", "max", "cells"},
                  "follows from the pieces of {}: leave it out, or give min, max and cells in their place", given);
  return sound;
}

/// True if the grid is a box that can be divided into its cells.
bool check_grid(SceneCheck& check, const Scene& scene) {
  const GridSpec& grid = scene.grid;
  check.wrong_if(scene.dim == 3 && grid.basis == BasisKind::hermite, "grid.basis",
                 "'hermite' is a basis of the line and the plane; in space take \"cubic\"");
  if (!check_pieces(check, scene)) return false;
  if (scene.state == StressState::axisymmetric && !grid.min.empty())
    check.wrong_if(grid.min[0] < 0, grid.is_by_pieces() ? "grid.x[0][0]" : "grid.min[0]",
                   "is a radius in an axisymmetric scene, at least 0, not {}", grid.min[0]);
  const GridFault fault = fault_of_grid(scene);
  if (fault.empty()) return true;
  const std::string key = fault.key.empty() ? "grid" : "grid." + fault.key;
  const bool was_reported = fault.key.empty() && !check.problems().empty();  // when the grid was read
  check.wrong_if(!was_reported, fault.axis < 0 ? key : check.axis_key(key, static_cast<std::size_t>(fault.axis)), "{}",
                 fault.message);
  return false;
}

/// A mass of which only M⁻¹ is known cannot do everything.
void check_multigrid(SceneCheck& check, const Scene& scene) {
  const std::string key = "mass.kind";
  check.wrong_if(!scene.stop.wants_equilibrium() || loads_vary(scene), key,
                 "'multigrid' is a fictitious inertia, whose motion means nothing: take it where equilibrium under "
                 "steady loads is all that is asked for");
  check.wrong_if(scene.grid.basis == BasisKind::hermite, key,
                 "'multigrid' needs a basis of values alone; take linear, quadratic or cubic");
  check.wrong_if(!scene.initial_v.empty(), key, "'multigrid' has no velocities to begin with; leave out initial.v");
  if (scene.solve.is_static()) {
    const StaticMethodInfo* const method = check.catalogue().static_method(scene.solve.method);
    check.wrong_if(method && method->factorises, key,
                   "'multigrid' has no part in a method that factorises K; take solve.method = \"newton-cg\", \"cg\" "
                   "or \"lbfgs\"");
    return;
  }
  const StrategyInfo* const strategy = check.catalogue().strategy(scene.damping.strategy);
  if (!strategy) return;
  check.wrong_if(strategy->is_local || strategy->is_identity, key,
                 "'multigrid' couples all degrees of freedom, and damping '{}' takes each by itself; take viscous or "
                 "auto",
                 strategy->name);
  check.wrong_if(strategy->is_relaxation && !strategy->takes_inverse_mass, key,
                 "'multigrid' has no products with M, which '{}' needs; take viscous, kinetic, adaptive or auto",
                 strategy->name);
  check.wrong_if(strategy->uses("quotient") && scene.damping.quotient == Quotient::diagonal, "damping.quotient",
                 "'diagonal' needs products with M, which mass.kind = \"multigrid\" has none of");
  check.wrong_if(scene.integrator.rtol.has_value(), key,
                 "'multigrid' has no velocities to be accurate in; leave out integrator.rtol");
}

void check_mass(SceneCheck& check, const Scene& scene) {
  const MassSpec& mass = scene.mass;
  if (!check.sound("mass.kind")) return;
  check.wrong_if((mass.scaling == MassScaling::gershgorin || mass.factor != 1) && mass.kind != MassKind::lumped,
                 "mass.scaling", "needs mass.kind = \"lumped\"");
  if (mass.kind == MassKind::multigrid) check_multigrid(check, scene);
}

/// Parts rest while others move, and are looked at when a phase ends: where all comes to rest, none does.
void check_rest(SceneCheck& check, const Scene& scene) {
  const std::string key = "phase.rest";
  if (!(scene.phase.rest > 0) || !check.sound(key)) return;
  check.wrong_if(scene.solve.is_static() || scene.stop.wants_equilibrium(), key,
                 "is for a motion that goes on until stop.time: the residual of an equilibrium would be that of the "
                 "moving parts alone; leave it out, or set stop.residual = 0");
  check.wrong_if(!scene.phase.ends_by_motion(), key, "needs phases that end by motion; set phase.max_motion");
  check.wrong_if(scene.mass.kind != MassKind::lumped, key, "needs mass.kind = \"lumped\"");
  check.wrong_if(scene.phase.dilatation != Dilatation::points, key, "needs phase.dilatation = \"points\"");
  check.wrong_if(scene.may_touch() || scene.load.has_value(), key,
                 "does not see what touches a part at rest, or drives a load; leave it out with [[rigid]], [[contact]] "
                 "and [load]");
}

void check_integrator(SceneCheck& check, const Scene& scene, const StrategyInfo* strategy) {
  const IntegratorSpec& spec = scene.integrator;
  check.wrong_if(spec.step_fraction > 1 && spec.unstable_reason.empty(), "integrator.step_fraction",
                 "{} of the critical step is unstable; say in unstable_reason why you want it, or stay at or below 1",
                 spec.step_fraction.value());
  check.refuse_if(spec.step.has_value(), "integrator", {"step_fraction"},
                  "give either step or step_fraction, not both");
  const MethodInfo* const method = check.catalogue().method(spec.method);
  if (!method || !check.sound("integrator.method")) return;
  std::vector<std::string> treatments;
  for (const DampingTreatment one : method->treatments)
    treatments.emplace_back(kTreatments[static_cast<std::size_t>(one)]);
  const bool fits = std::ranges::count(method->treatments, spec.treatment) > 0;
  check.wrong_if(!fits, "integrator.damping", "this treatment does not go with method '{}', which takes {}",
                 spec.method, treatments.size() > 1 ? either(treatments) : treatments[0] + " only");
  check.wrong_if(fits && spec.treatment == DampingTreatment::exact && strategy && strategy->is_identity &&
                     scene.mass.kind == MassKind::consistent,
                 "integrator.damping",
                 "'exact' needs C and M diagonal together: take mass.kind = \"lumped\" or damping.strategy = "
                 "\"viscous\"");
  check.wrong_if(spec.rtol && !method->adaptive, "integrator.rtol", "method '{}' has no error estimate; leave rtol out",
                 spec.method);
  check.wrong_if(!spec.rtol && !method->fixed_step, "integrator.method",
                 "method '{}' has no fixed step: give integrator.rtol", spec.method);
}

/// Checks what goes with a way to rest in time.
void check_strategy(SceneCheck& check, const Scene& scene, const StrategyInfo& info) {
  for (const char* key : {"c", "alpha", "peak", "quotient"}) {
    std::vector<std::string> owners;
    for (const StrategyInfo& other : check.catalogue().strategies)
      if (other.uses(key)) owners.push_back(fmt::format("\"{}\"", other.name));
    check.refuse_if(!info.takes(key), "damping", {key}, "goes with strategy = {}, not with '{}'", either(owners),
                    info.name);
  }
  const std::string& method = scene.integrator.method;
  if (check.wrong_if(check.sound("integrator.method") && !info.goes_with(method),
                     check.written("integrator.method") ? "integrator.method" : "damping.strategy",
                     "damping '{}' does not go with method '{}'; it goes with {}", info.name, method,
                     fmt::join(info.integrators, ", ")) ||
      !info.is_relaxation)
    return;
  check.wrong_if(scene.integrator.treatment != DampingTreatment::automatic, "integrator.damping",
                 "damping '{}' is no C v to be treated; leave this out", info.name);
  check.refuse_if(info.has_own_step, "integrator", {"step", "step_fraction"},
                  "damping '{}' has its own step; leave this out", info.name);
  const auto moves = [](const WallSpec& wall) { return wall.motion.uses('t'); };
  check.wrong_if(info.resets_velocity && std::ranges::any_of(scene.walls, moves), "damping.strategy",
                 "'{}' sets velocities to zero, also those that a moving wall gives; take viscous, adaptive, auto or a "
                 "local damping",
                 info.name);
}

/// A solver without time cannot do everything.
void check_static_solver(SceneCheck& check, const Scene& scene, const StaticMethodInfo& info) {
  const std::string key = "solve.method";
  for (const std::string_view table : kTablesOfMotion)
    for (const auto& [path, where] : scene.where)
      check.wrong_if(path.starts_with(std::string(table) + "."), path,
                     "has no part in a static solution; leave it out, or take solve.method = \"{}\"",
                     SolveSpec().method);
  check.wrong_if(!scene.walls.empty(), key, "'{}' is a static solver, in which no wall can open or close; take \"{}\"",
                 info.name, SolveSpec().method);
  check.wrong_if(!scene.initial_v.empty(), "initial.v", "'{}' is a static solver, which has no velocity", info.name);
  if (!loads_vary(scene)) return;
  check.wrong_if(!info.takes_end_of_loads, key,
                 "'{}' is a static solver, which has no time: loads and supports must not depend on t", info.name);
  check.wrong_if(info.takes_end_of_loads && scene.stop.time == 0, key,
                 "'{}' is a static solver, which has no time: loads and supports depend on t, so give stop.time, at "
                 "which it takes them",
                 info.name);
}

void check_motion(SceneCheck& check, const Scene& scene) {
  check.refuse_if(true, "solve", {"load_steps"},
                  "has no part in a motion; leave it out, or take solve.method = \"newton\"");
  const StrategyInfo* const strategy = check.catalogue().strategy(scene.damping.strategy);
  check_integrator(check, scene, strategy);
  if (strategy && check.sound("damping.strategy")) check_strategy(check, scene, *strategy);
}

void check_stop(SceneCheck& check, const StopSpec& stop) {
  // The default number of steps guards against endless runs; it is no aim that a scene may rely on.
  const bool limited =
      (check.given("stop.steps", stop.steps != StopSpec().steps) && stop.steps > 0) || stop.wall_time > 0;
  check.wrong_if(!stop.wants_equilibrium() && stop.time == 0 && !limited, "stop.residual",
                 "nothing would ever stop this run: set residual, distance, time, steps or wall_time");
}

// The box around the bodies of all stages; those of later ones are not cut to the grid.
NamedBox box_of_all_stages(const Scene& scene) {
  std::vector<BodySpec> all = bodies_of_all_stages(scene);
  for (BodySpec& body : all) {
    body.min.take(scene.grid.min);
    body.max.take(scene.grid.max);
  }
  auto [low, high] = box_around(all);
  for (std::size_t d = 0; d < low.size(); ++d) {
    low[d] = std::max(low[d], scene.grid.min[d]);
    high[d] = std::min(high[d], scene.grid.max[d]);
  }
  return {std::move(low), std::move(high), "bodies"};
}

}  // namespace

void validate(const Scene& scene, const std::vector<FileMistake>& files, Reading& reading, const Catalogue& catalogue) {
  SceneCheck check(scene, reading, catalogue);
  const bool grid = check_grid(check, scene);
  const std::optional<NamedBox> body = check_bodies(check, grid, files);
  check_mass(check, scene);
  check_rest(check, scene);
  check_supports_and_walls(check, grid);
  check_rigid_bodies(check);
  check_contacts(check);
  check_loads(check, body);
  check_initial_stress(check, body);
  check_exact(check, body.has_value());
  check_phases(check, grid);
  const bool is_first_stage = !scene.present_stage || scene.present_stage->at == 0;
  if (is_first_stage) check_other_run(check);
  if (is_first_stage) check_stages(check);
  if (is_first_stage) check_output(check, scene.phase.at_stages && body ? box_of_all_stages(scene) : body);
  if (const StaticMethodInfo* const solver = catalogue.static_method(scene.solve.method)) {
    check_static_solver(check, scene, *solver);
  } else {
    check_motion(check, scene);
  }
  check_stop(check, scene.stop);
  check.unique_names("variant", scene.variants);
}

}  // namespace stillpoint
