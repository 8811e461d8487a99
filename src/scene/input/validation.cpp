#include "scene/input/validation.hpp"

#include <stillpoint/damping.hpp>
#include <stillpoint/integrator.hpp>

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/input/scene_check.hpp"

namespace stillpoint {
namespace {

void check_integrator(SceneCheck& check) {
  const Scene& scene = check.scene();
  const IntegratorSpec& spec = scene.integrator;
  if (spec.method.empty()) return;
  const bool leapfrog = spec.method == "leapfrog";
  const bool euler = spec.method == "symplectic-euler";
  const bool fits =
      spec.treatment == DampingTreatment::automatic || (leapfrog && spec.treatment == DampingTreatment::averaged) ||
      ((leapfrog || euler) && spec.treatment == DampingTreatment::lagged) ||
      (euler && (spec.treatment == DampingTreatment::implicit || spec.treatment == DampingTreatment::exact));
  if (!fits)
    check.add("integrator.damping",
              fmt::format("this treatment does not go with method '{}', which takes {}", spec.method,
                          leapfrog ? "automatic, averaged or lagged"
                          : euler  ? "automatic, lagged, implicit or exact"
                                   : "automatic only"));
  if (fits && spec.treatment == DampingTreatment::exact && scene.damping.strategy == "identity" &&
      scene.mass.kind == MassKind::consistent)
    check.add("integrator.damping",
              "'exact' needs C and M diagonal together: take mass.kind = \"lumped\" or damping.strategy = \"viscous\"");
  const Method method = find_method(spec.method);
  if (spec.rtol && !method.adaptive)
    check.add("integrator.rtol", fmt::format("method '{}' has no error estimate; leave rtol out", spec.method));
  if (!spec.rtol && !method.fixed_step)
    check.add("integrator.method", fmt::format("method '{}' has no fixed step: give integrator.rtol", spec.method));
}

/// What a strategy that owns its iteration cannot do.
void check_strategy(SceneCheck& check) {
  const Scene& scene = check.scene();
  const DampingSpec& spec = scene.damping;
  const DampingInfo& info = find_damping(spec.strategy);
  const std::string key = "damping.strategy";
  if (!scene.integrator.method.empty() && !info.goes_with(scene.integrator.method)) {
    check.add(check.written("integrator.method") ? "integrator.method" : key,
              fmt::format("damping '{}' does not go with method '{}'; it goes with {}", info.name,
                          scene.integrator.method, fmt::join(info.integrators, ", ")));
    return;
  }
  if (!info.owns_iteration) return;
  if (scene.integrator.treatment != DampingTreatment::automatic)
    check.add("integrator.damping", fmt::format("damping '{}' is no C v to be treated; leave this out", info.name));
  if (info.has_own_step) {
    for (const char* step : {"integrator.step", "integrator.step_fraction"})
      if (check.written(step)) check.add(step, fmt::format("damping '{}' has its own step; leave this out", info.name));
  }
  const auto moves = [](const WallSpec& wall) { return wall.motion.uses('t'); };
  if (info.resets_velocity && std::ranges::any_of(scene.walls, moves))
    check.add(key, fmt::format("'{}' sets velocities to zero, also those that a moving wall gives; take viscous, "
                               "adaptive, auto or a local damping",
                               info.name));
  if (!info.is_static) return;
  if (!scene.walls.empty())
    check.add(key, fmt::format("'{}' is a static iteration, in which no wall can open or close; take another strategy",
                               info.name));
  if (!scene.initial_v.empty())
    check.add("initial.v", fmt::format("damping '{}' is a static iteration, which has no velocity", info.name));
  if (loads_vary(scene))
    check.add(key, fmt::format("'{}' is a static iteration, which has no time: loads and supports must not depend on t",
                               info.name));
}

void check_variant_names(SceneCheck& check) {
  std::set<std::string> names;
  const auto& variants = check.scene().variants;
  for (std::size_t k = 0; k < variants.size(); ++k) {
    const std::string& name = variants[k].name;
    if (!name.empty() && !names.insert(name).second)
      check.add(fmt::format("variant[{}].name", k), fmt::format("there is a variant {} already", in_quotes(name)));
  }
}

}  // namespace

bool check_grid(SceneCheck& check) {
  const GridSpec& grid = check.scene().grid;
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

void validate(Scene& scene, std::vector<Problem>& problems) {
  SceneCheck check(scene, problems);
  const bool grid = check_grid(check);
  const std::optional<BodyBox> body = check_bodies(check, grid);
  check_loads(check, grid, body);
  check_phases(check);
  check_output(check, body);
  check_integrator(check);
  check_strategy(check);
  check_variant_names(check);
}

}  // namespace stillpoint
