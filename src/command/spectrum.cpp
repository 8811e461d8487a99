// stillpoint spectrum: frequencies by every method that the scene allows, and what follows from them.
#include <stillpoint/spectrum.hpp>
#include <stillpoint/stability.hpp>

#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "command/commands.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/balanced_leapfrog.hpp"
#include "simulation/catalogue.hpp"
#include "simulation/model.hpp"
#include "simulation/multigrid_mass.hpp"
#include "solvers/spectrum/local_damping_gain.hpp"

namespace stillpoint::command {
namespace {

void print_estimate(std::string_view what, std::string_view how, const FrequencyEstimate& e) {
  if (e.converged) {
    fmt::print("  {:<10}{:<36}{:>14.9g}{:>12}{:>12.4f}\n", what, how, e.omega, e.iterations, 1e3 * e.wall_s);
  } else {
    fmt::print("  {:<10}{:<36}  {}\n", what, how, e.status);
  }
}

struct Ends {
  FrequencyEstimate omega_1, omega_max;
};

Ends ends_by_mass(const LagrangianPhase& phase, ConstVec u) {
  Ends ends;
  ends.omega_1 = omega_1_by_lanczos(phase, 0, u);
  print_estimate("omega_1", "Lanczos on K⁻¹M (CHOLMOD)", ends.omega_1);
  print_estimate("omega_1", "ARPACK, shift-invert at 0", omega_1_by_arpack(phase, 0, u));
  ends.omega_max = omega_max_by_power_iteration(phase, 0, u);
  print_estimate("omega_max", "power iteration, matrix-free", ends.omega_max);
  print_estimate("omega_max", "ARPACK, shift-invert at the bound", omega_max_by_arpack(phase, 0, u));
  print_estimate("omega_max", "Gershgorin, guaranteed upper bound", omega_max_bound_by_gershgorin(phase, 0, u));
  return ends;
}

// Of the modes that the loads drive.
Ends ends_by_multigrid(const Scene& scene, const LagrangianPhase& phase, ConstVec u) {
  const Stopwatch watch;
  const auto [made, refusal] = make_multigrid_mass(phase, u, false);
  if (!made) throw_scene_error(scene, "mass.kind", refusal);
  const auto estimate = [&watch, count = made->applications](double omega) {
    return FrequencyEstimate{omega, count, watch.seconds(), true, "Lanczos' method"};
  };
  Ends ends{estimate(made->omega_1), estimate(made->omega_max)};
  print_estimate("omega_1", "Lanczos on M⁻¹K, M⁻¹ by multigrid", ends.omega_1);
  print_estimate("omega_max", "likewise, the cycle's set-up too", ends.omega_max);
  return ends;
}

}  // namespace

int spectrum(const SceneArguments& arguments) {
  const Scene scene = load_scene(arguments.file, arguments.overrides);
  const auto phase = make_phase(scene);
  const std::vector<double> u = phase->initial_displacement(0);

  fmt::print("{}\n  {:<10}{:<36}{:>14}{:>12}{:>12}\n", scene.title.empty() ? scene.name : scene.title, "", "method",
             "rad/s", "iterations", "ms");
  const bool is_multigrid = scene.mass.kind == MassKind::multigrid;
  const auto [omega_1, omega_max] = is_multigrid ? ends_by_multigrid(scene, *phase, u) : ends_by_mass(*phase, u);
  if (omega_1.converged) {
    const double ratio = omega_max.omega / omega_1.omega;
    fmt::print("  kappa = (omega_max/omega_1)^2 = {:.8g}\n  critical damping c = 2 omega_1 = {:.9g}\n", ratio * ratio,
               2 * omega_1.omega);
    if (is_multigrid) {
      const double h = balanced_step(omega_1.omega, omega_max.omega);
      fmt::print("  taken by leapfrog: c = 2 omega_1 sqrt(1 - h²omega_1²/4) = {:.9g}, h = {:.9g}\n",
                 balanced_damping(omega_1.omega, h), h);
    }
  }
  const StrategyInfo& strategy = *catalogue().strategy(scene.damping.strategy);
  if (strategy.uses("c") && !scene.damping.c && !omega_1.converged) {
    fmt::print("  critical steps   not known: c = \"critical\" needs omega_1\n");
    return 0;
  }
  const auto damping = strategy.is_relaxation ? no_damping()
                                              : make_damping(strategy.name, scene.damping.c.value_or(2 * omega_1.omega),
                                                             scene.damping.alpha);
  const double gain = local_damping_gain(*phase, 0, u, *damping, omega_max.omega);
  const DampedSpectrum damped = damped_spectrum(omega_1.omega, gain * omega_max.omega, *damping, phase->mass());
  fmt::print("  critical step with {} damping [s], and what a force evaluation buys of it\n", strategy.name);
  for (const Method& method : methods()) {
    if (!method.amplification) continue;
    const double step = critical_step(method, *damping, damped);
    fmt::print("    {:<34}{:>12.6g}{:>12.6g}\n", method.name, step, step / method.evaluations_per_step);
  }
  return 0;
}

}  // namespace stillpoint::command
