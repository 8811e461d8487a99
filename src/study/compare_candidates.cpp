#include "study/compare_candidates.hpp"

#include <stillpoint/compare.hpp>

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "base/gpl.hpp"
#include "base/text.hpp"
#include "linalg/multigrid.hpp"
#include "plan/catalogue.hpp"
#include "scene/throw_scene_error.hpp"
#include "study/setting.hpp"

namespace stillpoint {
namespace {

constexpr std::string_view adaptive_suffix = ":adaptive", multigrid_suffix = ":multigrid",
                           best_with_runge_kutta = "viscous";

const std::vector<std::string> default_integrators{"leapfrog", "erk:sofroniou-spaletta-5-3-4", "erk:rk4",
                                                   "erk:bogacki-shampine-4-2-3:adaptive"};
const std::vector<std::string> default_transient{"leapfrog",
                                                 "symplectic-euler",
                                                 "erk:rk4",
                                                 "erk:bogacki-shampine-4-2-3:adaptive",
                                                 "erk:dormand-prince-7-4-5:adaptive",
                                                 "erk:fehlberg-13-7-8:adaptive"};

bool is_adaptive(std::string_view integrator) { return integrator.ends_with(adaptive_suffix); }
std::string method_of(std::string_view integrator) {
  if (is_adaptive(integrator)) integrator.remove_suffix(adaptive_suffix.size());
  return std::string(integrator);
}

bool is_multigrid(std::string_view strategy) { return strategy.ends_with(multigrid_suffix); }
std::string name_of(std::string_view strategy) {
  if (is_multigrid(strategy)) strategy.remove_suffix(multigrid_suffix.size());
  return std::string(strategy);
}

// Whether a relaxation or a damping works with a mass of which only the inverse is known.
bool takes_multigrid(const StrategyInfo& info) {
  return info.is_relaxation ? info.takes_inverse_mass : info.damps && !info.is_local && !info.is_identity;
}

void check_strategy(const std::string& given, bool transient) {
  const std::string strategy = name_of(given);
  if (catalogue().static_method(strategy)) {
    if (!transient) return;
    throw_option_error("--strategies", strategy, "a static solution has no transient; expected a damping");
  }
  if (catalogue().strategy(strategy)) return;
  std::vector<std::string> names;
  for (const StrategyInfo& info : catalogue().strategies) names.emplace_back(info.name);
  for (const StaticMethodInfo& info : catalogue().static_methods) names.emplace_back(info.name);
  throw_option_error("--strategies", strategy, unknown_word("there is no strategy", strategy, names));
}

void check_integrator(const std::string& integrator) {
  if (const MethodInfo* method = catalogue().method(method_of(integrator))) {
    if (!is_adaptive(integrator) || method->adaptive) return;
    throw_option_error("--integrators", integrator, in_quotes(method->name) + " has no error estimate");
  }
  if (const std::string why = why_no_integrator(method_of(integrator)); !why.empty())
    throw_option_error("--integrators", integrator, why);
  std::vector<std::string> names;
  for (const MethodInfo& method : catalogue().methods) names.push_back(method.name);
  throw_option_error("--integrators", integrator, unknown_word("there is no integrator", method_of(integrator), names));
}

// Adds each strategy once more with a multigrid mass, if it works with one.
void add_multigrid(std::vector<std::string>& strategies) {
  const std::vector<std::string> all = strategies;
  for (const std::string& strategy : all) {
    const StaticMethodInfo* const method = catalogue().static_method(strategy);
    if (method ? !method->factorises : takes_multigrid(*catalogue().strategy(strategy)))
      strategies.push_back(strategy + std::string(multigrid_suffix));
  }
}

Candidate stepping(const StrategyInfo& info, const std::string& integrator, std::optional<double> fraction,
                   std::optional<double> rtol) {
  Candidate candidate;
  candidate.run.strategy = std::string(info.name);
  candidate.run.integrator = method_of(integrator);
  candidate.run.step_fraction = fraction;
  candidate.run.rtol = rtol;
  return candidate;
}

void take_strategy(const ComparedRun& run, const StrategyInfo& info, Problem& problem) {
  IntegratorSpec& integrator = problem.integrator;
  // A number in the scene belongs to the scene's own strategy.
  if (info.uses("c") && run.strategy != problem.damping.strategy) problem.damping.c.reset();
  problem.solve = {};
  problem.damping.strategy = run.strategy;
  integrator.method = run.integrator;
  if (run.step_fraction || info.has_own_step) integrator.step.reset();
  if (info.has_own_step) integrator.step_fraction = IntegratorSpec().step_fraction;
  if (run.step_fraction) integrator.step_fraction = *run.step_fraction;
  if (run.rtol) integrator.rtol = run.rtol;
}

}  // namespace

std::vector<Candidate> candidates(const CompareOptions& options, const Problem& problem, bool transient) {
  std::vector<std::string> strategies = options.strategies;
  if (transient && strategies.empty()) {
    strategies = {problem.damping.strategy};
  } else if (strategies.empty()) {
    for (const StrategyInfo& info : catalogue().strategies) {
      const bool does_something = info.is_relaxation || !info.keys.empty();
      if (does_something) strategies.emplace_back(info.name);
    }
    for (const StaticMethodInfo& info : catalogue().static_methods) strategies.emplace_back(info.name);
    if (multigrid_is_missing().empty()) add_multigrid(strategies);
  }
  const auto& integrators = !options.integrators.empty() ? options.integrators
                            : transient                  ? default_transient
                                                         : default_integrators;

  for (const std::string& strategy : strategies) check_strategy(strategy, transient);
  for (const std::string& integrator : integrators) check_integrator(integrator);

  std::vector<Candidate> all;
  const auto add = [&](Candidate candidate, bool multigrid) {
    candidate.is_extra = multigrid && options.strategies.empty();
    if (multigrid) candidate.run.mass = "multigrid";
    all.push_back(std::move(candidate));
  };
  for (const std::string& given : strategies) {
    const std::string strategy = name_of(given);
    const bool multigrid = is_multigrid(given);
    if (const StaticMethodInfo* method = catalogue().static_method(strategy)) {
      Candidate candidate;
      candidate.run.strategy = strategy;
      candidate.is_newton = method->is_newton;
      add(std::move(candidate), multigrid);
      continue;
    }
    const StrategyInfo& info = *catalogue().strategy(strategy);
    for (const std::string& integrator : integrators) {
      if (!info.goes_with(method_of(integrator))) continue;
      // Unless they are asked for, Runge-Kutta methods are tried only with the damping that suits them best.
      const bool is_default =
          integrator == default_integrators.front() || (strategy == best_with_runge_kutta && !multigrid);
      const bool of_interest = transient || is_default || !options.integrators.empty() || !options.strategies.empty();
      if (!of_interest) continue;
      if (is_adaptive(integrator)) {
        for (const double rtol : options.tolerances) {
          add(stepping(info, integrator, std::nullopt, rtol), multigrid);
        }
      } else if (info.has_own_step) {
        add(stepping(info, integrator, std::nullopt, std::nullopt), multigrid);
      } else {
        for (const double fraction : options.step_fractions) {
          add(stepping(info, integrator, fraction, std::nullopt), multigrid);
        }
      }
    }
  }
  if (all.empty()) {
    throw_option_error("--integrators", fmt::format("{}", fmt::join(integrators, ",")),
                       fmt::format("none of the strategies goes with these: {}", fmt::join(strategies, ", ")));
  }
  return all;
}

Scene scene_of(const ComparedRun& run, const Scene& scene) {
  return changed(scene, [&](Problem& problem) {
    if (!run.mass.empty()) problem.mass.kind = MassKind::multigrid;
    if (const StrategyInfo* const info = catalogue().strategy(run.strategy)) {
      take_strategy(run, *info, problem);
    } else {
      problem.solve.method = run.strategy;
    }
  });
}

std::string to_string(ComparedStatus status) {
  switch (status) {
    case ComparedStatus::converged:
      return "converged";
    case ComparedStatus::stalled:
      return "stalled";
    case ComparedStatus::unfinished:
      return "unfinished";
    case ComparedStatus::inaccurate:
      return "inaccurate";
    case ComparedStatus::diverged:
      return "diverged";
    case ComparedStatus::refused:
      return "refused";
    case ComparedStatus::interrupted:
      return "interrupted";
  }
  return "unknown";
}

std::string ComparedRun::label() const {
  std::string text = mass.empty() ? strategy : strategy + ":" + mass;
  if (!integrator.empty() && integrator != IntegratorSpec{}.method) text += ", " + integrator;
  if (step_fraction) text += fmt::format(" {:g}", *step_fraction);
  if (rtol) text += fmt::format(" rtol {:g}", *rtol);
  return text;
}

std::optional<double> Comparison::over_chebyshev_estimate(const ComparedRun& run) const {
  if (!chebyshev_estimate || run.evaluations == 0) return std::nullopt;
  return static_cast<double>(run.evaluations) / *chebyshev_estimate;
}

double chebyshev_estimate(double kappa, double error) { return 0.5 * std::sqrt(kappa) * std::log(2 / error); }

}  // namespace stillpoint
