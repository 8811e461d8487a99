#include "study/spectrum_study.hpp"

#include <stillpoint/integrator.hpp>
#include <stillpoint/stability.hpp>

#include <utility>

#include <fmt/format.h>

#include "base/stopwatch.hpp"
#include "linalg/sparse_cholesky.hpp"
#include "plan/catalogue.hpp"
#include "scene/throw_scene_error.hpp"
#include "simulation/setup/balanced_leapfrog.hpp"
#include "simulation/setup/model.hpp"
#include "simulation/setup/multigrid_mass.hpp"
#include "solvers/spectrum/local_damping_gain.hpp"

namespace stillpoint {
namespace {

void find_by_mass(const LagrangianPhase& phase, ConstVec u, SpectrumStudy& study) {
  study.omega_1 = omega_1_by_lanczos(phase, 0, u);
  study.omega_max = omega_max_by_power_iteration(phase, 0, u);
  study.estimates = {{"omega_1", fmt::format("Lanczos on K⁻¹M ({})", SparseCholesky::library()), study.omega_1},
                     {"omega_1", "ARPACK, shift-invert at 0", omega_1_by_arpack(phase, 0, u)},
                     {"omega_max", "power iteration, matrix-free", study.omega_max},
                     {"omega_max", "ARPACK, shift-invert at the bound", omega_max_by_arpack(phase, 0, u)},
                     {"omega_max", "Gershgorin, guaranteed upper bound", omega_max_bound_by_gershgorin(phase, 0, u)}};
}

// Finds the frequencies of the modes that the loads excite.
void find_by_multigrid(const LagrangianPhase& phase, ConstVec u, SpectrumStudy& study) {
  const Stopwatch watch;
  const auto [made, refusal] = make_multigrid_mass(phase, u, false);
  if (!made) throw_scene_error("mass.kind", refusal);
  const auto estimate = [&watch, count = made->applications](double omega) {
    return FrequencyEstimate{omega, count, watch.seconds(), true, "Lanczos' method"};
  };
  study.omega_1 = estimate(made->omega_1);
  study.omega_max = estimate(made->omega_max);
  study.estimates = {{"omega_1", "Lanczos on M⁻¹K, M⁻¹ by multigrid", study.omega_1},
                     {"omega_max", "likewise, the cycle's set-up too", study.omega_max}};
  study.balanced_step = balanced_step(study.omega_1.omega, study.omega_max.omega);
  study.balanced_c = balanced_damping(study.omega_1.omega, *study.balanced_step);
}

}  // namespace

SpectrumStudy spectrum_of(const Problem& problem) {
  const auto phase = make_phase(problem);
  const std::vector<double> u = phase->initial_displacement(0);
  SpectrumStudy study;
  study.strategy = problem.damping.strategy;
  if (problem.mass.kind == MassKind::multigrid) {
    find_by_multigrid(*phase, u, study);
  } else {
    find_by_mass(*phase, u, study);
  }
  const double omega_1 = study.omega_1.omega, omega_max = study.omega_max.omega;
  const StrategyInfo& strategy = *catalogue().strategy(problem.damping.strategy);
  study.knows_steps = !strategy.uses("c") || problem.damping.c || study.omega_1.converged;
  if (!study.knows_steps) return study;
  const auto damping = strategy.is_relaxation ? no_damping()
                                              : make_damping(strategy.name, problem.damping.c.value_or(2 * omega_1),
                                                             problem.damping.alpha);
  const double gain = local_damping_gain(*phase, 0, u, *damping, omega_max);
  const DampedSpectrum damped = damped_spectrum(omega_1, gain * omega_max, *damping, phase->mass());
  for (const Method& method : methods()) {
    if (method.amplification)
      study.steps.push_back({method.name, critical_step(method, *damping, damped), method.evaluations_per_step});
  }
  return study;
}

}  // namespace stillpoint
