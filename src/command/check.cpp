// stillpoint check: what would be modelled; nothing runs and nothing is written.
#include <stillpoint/model.hpp>

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "commands.hpp"

namespace stillpoint::command {
namespace {

constexpr std::array basis_names{"linear B-spline", "quadratic B-spline", "cubic B-spline", "cubic Hermite"};

}  // namespace

int check(const SceneArguments& arguments) {
  const Scene scene = load_scene(arguments.file, arguments.overrides);
  const Model model = make_model(scene);
  const LagrangianPhase& phase = *model.phase;

  fmt::print("{}\n", scene.title.empty() ? scene.name : scene.title);
  fmt::print("  space            {} dimension, {} basis, {} cells of which {} hold material\n", scene.dim,
             basis_names[static_cast<std::size_t>(scene.grid.basis)], scene.grid.cells[0], phase.occupied_cells());
  fmt::print("  body             {} material points, mass {:.6g} kg, law {}\n", phase.points(), phase.total_mass(),
             scene.materials.at(scene.bodies[0].material).law);
  fmt::print("  volumes          {} integrate polynomials up to degree {}\n",
             scene.bodies[0].volumes == VolumeRule::equal ? "equal ones" : "consistent ones", phase.quadrature().degree);
  fmt::print("  unknowns         {} free, {} supported; {} mass\n", phase.size(), phase.supported_degrees_of_freedom(),
             phase.mass().is_lumped() ? "lumped" : "consistent");
  fmt::print("  damping          {}{}\n", model.damping->name(), model.c ? fmt::format(", c = {:.8g}", *model.c) : "");
  fmt::print("  omega_max        {:.8g} rad/s\n", model.omega_max);
  if (model.critical_step) {
    fmt::print("  critical step    {:.6g} s for {}; the run takes {}{:.6g} s\n", *model.critical_step,
               model.method.name, model.integrator.rtol ? "at most " : "", model.integrator.max_step);
  } else {
    fmt::print("  critical step    not known for {}; error control bounds the step\n", model.method.name);
  }
  for (const std::string& note : model.notes) fmt::print("  note             {}\n", note);
  double total = 0;
  fmt::print("  bytes a point\n");
  for (const PointArray& array : phase.point_arrays()) {
    fmt::print("    {:<17}{:4.0f}\n", array.name, array.bytes_per_point);
    total += array.bytes_per_point;
  }
  fmt::print("    {:<17}{:4.0f}   {:.3g} MB for all points\n", "together", total,
             total * static_cast<double>(phase.points()) / 1e6);
  return 0;
}

}  // namespace stillpoint::command
