// stillpoint spectrum: frequencies by every method that the scene allows, and the quantities that follow from them.
#include <fmt/format.h>

#include "command/commands.hpp"
#include "scene/throw_scene_error.hpp"
#include "study/spectrum_study.hpp"

namespace stillpoint::command {
namespace {

void print_estimate(const SpectrumStudy::Estimate& estimate) {
  const FrequencyEstimate& e = estimate.found;
  if (e.converged) {
    fmt::print("  {:<10}{:<36}{:>14.9g}{:>12}{:>12.4f}\n", estimate.what, estimate.how, e.omega, e.iterations,
               1e3 * e.wall_s);
  } else {
    fmt::print("  {:<10}{:<36}  {}\n", estimate.what, estimate.how, e.status);
  }
}

}  // namespace

int spectrum(const SceneArguments& arguments) {
  const Scene scene = load_scene(arguments.file, arguments.overrides);
  const SpectrumStudy study = located(scene, [&] { return spectrum_of(scene); });

  fmt::print("{}\n  {:<10}{:<36}{:>14}{:>12}{:>12}\n", scene.title.empty() ? scene.name : scene.title, "", "method",
             "rad/s", "iterations", "ms");
  for (const SpectrumStudy::Estimate& estimate : study.estimates) print_estimate(estimate);
  if (study.omega_1.converged) {
    fmt::print("  kappa = (omega_max/omega_1)^2 = {:.8g}\n  critical damping c = 2 omega_1 = {:.9g}\n", study.kappa(),
               study.critical_damping());
    if (study.balanced_step) {
      fmt::print("  taken by leapfrog: c = 2 omega_1 sqrt(1 - h²omega_1²/4) = {:.9g}, h = {:.9g}\n", *study.balanced_c,
                 *study.balanced_step);
    }
  }
  if (!study.knows_steps) {
    fmt::print("  critical steps   not known: c = \"critical\" needs omega_1\n");
    return 0;
  }
  fmt::print("  critical step with {} damping [s], and what a force evaluation buys of it\n", study.strategy);
  for (const MethodStep& step : study.steps)
    fmt::print("    {:<34}{:>12.6g}{:>12.6g}\n", step.method, step.critical_step,
               step.critical_step / step.evaluations);
  return 0;
}

}  // namespace stillpoint::command
