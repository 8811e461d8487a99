// stillpoint check: describes the model of a scene; nothing runs and nothing is written.
#include <stillpoint/scene.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.hpp"
#include "command/commands.hpp"
#include "plan/plan.hpp"
#include "scene/grid_lines.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/setup/model.hpp"

namespace stillpoint::command {
namespace {

constexpr std::array basis_names{"linear B-spline", "quadratic B-spline", "cubic B-spline", "cubic Hermite"};

void print_cut_cells(const QuadratureReport& quadrature) {
  std::vector<std::string> groups;
  for (std::size_t degree = 0; degree < quadrature.border_cells.size(); ++degree) {
    if (const int cells = quadrature.border_cells[degree]; cells > 0)
      groups.push_back(fmt::format("degree {} in {}", degree, cells));
  }
  if (!groups.empty()) fmt::print("  cut cells        {}\n", fmt::join(groups, ", "));
}

void print_unequal_cells(const GridSpec& grid) {
  for (std::size_t axis = 0; axis < grid.cells.size(); ++axis)
    if (!has_equal_cells(grid, axis))
      fmt::print("  cells along {}    {:.4g} to {:.4g} m long\n", "xyz"[axis], smallest_cell(grid, axis),
                 longest_cell(grid, axis));
}

void print_memory(const Plan& plan) {
  const auto row = [](const std::string& what, double bytes) {
    fmt::print("    {:<28}{:9.3g} MB\n", what, bytes / 1e6);
  };
  fmt::print("  memory, when a run takes most\n");
  for (const MemoryPart& part : plan.memory) row(part.what, part.bytes);
  row("together", plan.bytes());
  row("there is", plan.room.bytes);
  fmt::print("      by {}\n", plan.room.set_by);
}

// What the scene leaves open and a rule decides.
void print_choices(const Scene& scene, const Plan& plan) {
  const auto tell = [](const char* key, const std::string& value, const auto& choice) {
    if (!choice.is_asked() && choice.why() != choice.by_default)
      fmt::print("  chosen           {} = {}: {}\n", key, value, choice.why());
  };
  const PhaseSpec& phase = scene.phase;
  if (plan.moves_on) {
    tell("phase.max_motion", fmt::format("{:g}", phase.max_motion.value()), phase.max_motion);
    tell("phase.quadrature", phase.quadrature == Quadrature::domains ? "domains" : "points", phase.quadrature);
    tell("phase.transfer", phase.transfer == Transfer::apic ? "apic" : "flip", phase.transfer);
    if (!plan.remembers)
      tell("phase.deformation", phase.deformation == DeformationRule::accumulated ? "accumulated" : "positions",
           phase.deformation);
  }
  if (!plan.static_method && !scene.integrator.step)
    tell("integrator.step_fraction", fmt::format("{:g}", scene.integrator.step_fraction.value()),
         scene.integrator.step_fraction);
  if (plan.strategy && plan.strategy->uses("alpha"))
    tell("damping.alpha", fmt::format("{:g}", scene.damping.alpha.value()), scene.damping.alpha);
}

}  // namespace

int check(const SceneArguments& arguments) {
  const Scene scene = load_scene(arguments.file, arguments.overrides);
  const Plan plan = located(scene, [&] { return require_memory(make_plan(scene)); });
  const Model model = located(scene, [&] { return make_model(scene, plan); });
  const LagrangianPhase& phase = *model.phase;

  fmt::print("{}\n", scene.title.empty() ? scene.name : scene.title);
  fmt::print("  space            {}, {}, {} basis, {} cells of which {} hold material\n",
             counted(static_cast<std::size_t>(scene.dim), "dimension"), to_string(scene.state),
             basis_names[static_cast<std::size_t>(scene.grid.basis)],
             fmt::join(phase.shape().discretisation().grid_cells, " x "),
             phase.shape().discretisation().occupied_cells);
  print_unequal_cells(scene.grid);
  for (const BodySpec& body : scene.bodies) {
    fmt::print("  body             of {}: {}, {} volumes\n", body.material, scene.materials.at(body.material).law,
               body.volumes == VolumeRule::equal ? "equal" : "consistent");
  }
  const std::optional<int> degree = phase.shape().discretisation().quadrature.degree;
  fmt::print("  points           {}, mass {:.6g} kg{}\n", phase.points(), phase.info().total_mass,
             degree ? fmt::format("; they integrate polynomials up to degree {}", *degree) : "");
  print_cut_cells(phase.shape().discretisation().quadrature);
  fmt::print("  phases           {}\n", plan.moves_on ? "several: the points move on" : "one: weights are frozen");
  print_choices(scene, plan);
  fmt::print("  unknowns         {} free, {} supported; {} mass\n", phase.size(),
             phase.shape().discretisation().supported_degrees_of_freedom,
             model.multigrid            ? "multigrid"
             : phase.mass().is_lumped() ? "lumped"
                                        : "consistent");
  for (const WeakSupport& weak : phase.supports().weak_supports(0, model.u)) {
    fmt::print("  weak support     support[{}]: {} of {:.4g} {}\n", weak.support, counted(weak.springs, "spring"),
               weak.stiffness, scene.supports[weak.support].face ? "N/m3" : "N/m");
  }
  if (const StaticMethodInfo* method = plan.static_method) {
    fmt::print("  static solver    {}: {}\n", method->name, method->equation);
  } else {
    fmt::print("  damping          {}{}: {}\n", plan.strategy->name,
               model.c ? fmt::format(", c = {:.8g}", *model.c) : "", plan.strategy->equation);
  }
  fmt::print("  omega_max        {:.8g} rad/s{}\n", model.omega_max,
             model.tangent_applications > 0
                 ? fmt::format(", a bound by {} applications of the tangent", model.tangent_applications)
                 : "");
  if (model.critical_step) {
    fmt::print("  critical step    {:.6g} s for {}; the run takes {}{:.6g} s\n", *model.critical_step,
               model.method.name, model.integrator.rtol ? "at most " : "", model.integrator.max_step);
  } else {
    fmt::print("  critical step    not known for {}; error control bounds the step\n", model.method.name);
  }
  for (const std::string& note : model.notes) fmt::print("  note             {}\n", note);
  fmt::print("  bytes a point\n");
  for (const PointArray& array : phase.shape().discretisation().arrays) {
    fmt::print("    {:<17}{:4.0f}\n", array.name, array.bytes_per_point);
  }
  const double total = phase.shape().discretisation().bytes_per_point();
  fmt::print("    {:<17}{:4.0f}   {:.3g} MB for all points\n", "together", total,
             total * static_cast<double>(phase.points()) / 1e6);
  print_memory(plan);
  return 0;
}

}  // namespace stillpoint::command
