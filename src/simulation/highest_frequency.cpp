#include "simulation/highest_frequency.hpp"

#include <stillpoint/spectrum.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "scene/throw_scene_error.hpp"
#include "solvers/spectrum/direct_solver_limit.hpp"

namespace stillpoint {
namespace {

// The same for auto, which counts what it spends.
double quick_highest_frequency(const Problem& problem, Model& model, SetUp& set_up, const LagrangianPhase& phase) {
  const FrequencyEstimate estimate = set_up.shared(
      "omega_max of auto", problem.mass, [&] { return omega_max_by_lanczos(phase, 0, phase.initial_displacement(0)); });
  model.tangent_applications += estimate.iterations;
  if (estimate.converged) return estimate.omega;
  throw_scene_error("initial", fmt::format("the initial state has no highest frequency ({}); expected a stable state",
                                           estimate.status));
}

}  // namespace

bool wants_equilibrium_only(const Problem& problem) { return problem.stop.wants_equilibrium() && !loads_vary(problem); }

// By Lanczos' method, whose answer is above ω_max by no more than its tolerance. A spectrum that is crowded at its end
// keeps it from that: then by power iteration, which underestimates, and, if that has not converged, by ARPACK; with a
// margin, or the guaranteed bound, if that has not either. A large body takes what few applications of K give.
double highest_frequency(const LagrangianPhase& phase, ConstVec u) {
  const bool is_large = phase.size() > direct_solver_limit;
  constexpr double tolerance = 1e-7;
  FrequencyEstimate estimate =
      is_large ? omega_max_by_lanczos(phase, 0, u, 30) : omega_max_by_lanczos(phase, 0, u, 100, tolerance);
  const SpectrumOptions options{.tolerance = 1e-9, .max_iterations = 300};
  if (!estimate.converged) estimate = omega_max_by_power_iteration(phase, 0, u, options);
  if (!(estimate.omega > 0) || !std::isfinite(estimate.omega)) {
    throw_scene_error("initial", fmt::format("the initial state has no highest frequency ({}); expected a stable state",
                                             estimate.status));
  }
  if (estimate.converged) return estimate.omega;
  if (!is_large) {
    const FrequencyEstimate by_arpack = omega_max_by_arpack(phase, 0, u, options);
    if (by_arpack.converged) return by_arpack.omega;
  }
  constexpr double margin = 1.02;  // after 300 iterations an underestimate of 0.1 % is usual
  return std::min(margin * estimate.omega, omega_max_bound_by_gershgorin(phase, 0, u).omega);
}

// auto takes physical masses or those by Gershgorin's bound, whichever gives the smaller κ. Both have the mass of the
// body in total, and the slowest mode, in which the body moves as a whole, sees little of how it is spread: the ratio
// of κ is that of ω_max². Gershgorin needs a lumped mass, which auto takes if the scene leaves the kind open.
bool choose_mass(const Problem& problem, Model& model, SetUp& set_up, SetUpStore* store) {
  model.omega_max = quick_highest_frequency(problem, model, set_up, *model.phase);
  if (!wants_equilibrium_only(problem)) {
    model.notes.push_back(
        "auto keeps the physical mass and halts no motion, as loads or supports depend on t or the transient is asked "
        "for; its c M v holds back a body that flows: take one-sided or cundall there");
    return false;
  }
  const bool kind_is_fixed = problem.mass.kind.is_asked() && problem.mass.kind == MassKind::consistent;
  if (problem.mass.scaling_is_asked() || kind_is_fixed || problem.grid.basis == BasisKind::hermite) return false;
  Problem scaled = problem;
  scaled.mass.kind = MassKind::lumped;
  scaled.mass.scaling = MassScaling::gershgorin;
  std::unique_ptr<LagrangianPhase> phase = set_up.phase(scaled);
  const double omega_max = quick_highest_frequency(scaled, model, set_up, *phase);
  const double gain = model.omega_max * model.omega_max / (omega_max * omega_max);
  constexpr double worthwhile = 1.05;
  const bool takes_it = gain >= worthwhile;
  if (takes_it) std::swap(model.phase, phase);
  if (store) store->give_back(takes_it ? problem.mass : scaled.mass, std::move(phase));
  if (!takes_it) return false;
  model.mass = scaled.mass;
  model.omega_max = omega_max;
  model.notes.push_back(fmt::format(
      "auto scales the mass by Gershgorin's bound: the condition number becomes about {:.3g} times smaller", gain));
  return true;
}

}  // namespace stillpoint
