#include "study/compare_candidates.hpp"

#include <stillpoint/damping.hpp>
#include <stillpoint/integrator.hpp>

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/throw_scene_error.hpp"

namespace stillpoint {
namespace {

constexpr std::string_view adaptive_suffix = ":adaptive";
constexpr std::array<std::string_view, 2> static_methods{"newton", "newton-cg"};

const std::vector<std::string> default_integrators{"leapfrog", "erk:sofroniou-spaletta-5-3-4", "erk:rk4",
                                                   "erk:bogacki-shampine-4-2-3:adaptive"};
const std::vector<std::string> default_transient{"leapfrog",
                                                 "symplectic-euler",
                                                 "erk:rk4",
                                                 "erk:bogacki-shampine-4-2-3:adaptive",
                                                 "erk:dormand-prince-7-4-5:adaptive",
                                                 "erk:fehlberg-13-7-8:adaptive"};

bool is_static(const std::string& strategy) {
  return std::ranges::find(static_methods, strategy) != static_methods.end();
}
bool is_adaptive(std::string_view integrator) { return integrator.ends_with(adaptive_suffix); }
std::string method_of(std::string_view integrator) {
  if (is_adaptive(integrator)) integrator.remove_suffix(adaptive_suffix.size());
  return std::string(integrator);
}

void check_strategy(const std::string& strategy, bool transient) {
  if (is_static(strategy)) {
    if (transient)
      throw_option_error("--strategies", strategy, "a static solution has no transient; expected a damping");
    return;
  }
  std::vector<std::string> names(static_methods.begin(), static_methods.end());
  for (const DampingInfo& info : damping_strategies()) names.emplace_back(info.name);
  if (std::ranges::find(names, strategy) == names.end()) {
    throw_option_error("--strategies", strategy, unknown_word("there is no strategy", strategy, names));
  }
}

void check_integrator(const std::string& integrator) {
  std::vector<std::string> names;
  for (const Method& method : methods()) {
    names.push_back(method.name);
    if (method.name != method_of(integrator)) continue;
    if (is_adaptive(integrator) && !method.adaptive) {
      throw_option_error("--integrators", integrator, in_quotes(method.name) + " has no error estimate");
    }
    return;
  }
  throw_option_error("--integrators", integrator, unknown_word("there is no integrator", method_of(integrator), names));
}

Candidate stepping(const Scene& scene, const DampingInfo& info, const std::string& integrator,
                   std::optional<double> fraction, std::optional<double> rtol) {
  const std::string strategy(info.name);
  Candidate candidate;
  candidate.run.strategy = strategy;
  candidate.run.integrator = method_of(integrator);
  candidate.run.step_fraction = fraction;
  candidate.run.rtol = rtol;
  candidate.overrides = {"damping.strategy=" + strategy, "integrator.method=" + candidate.run.integrator};
  // A number in the scene is meant for the strategy beside it.
  if (info.takes_c && strategy != scene.damping.strategy) candidate.overrides.emplace_back("damping.c=critical");
  if (fraction) candidate.overrides.push_back(fmt::format("integrator.step_fraction={:.17g}", *fraction));
  if (rtol) candidate.overrides.push_back(fmt::format("integrator.rtol={:.17g}", *rtol));
  return candidate;
}

}  // namespace

std::vector<Candidate> candidates(const CompareOptions& options, const Scene& scene, bool transient) {
  std::vector<std::string> strategies = options.strategies;
  if (transient && strategies.empty()) {
    strategies = {scene.damping.strategy};
  } else if (strategies.empty()) {
    for (const DampingInfo& info : damping_strategies()) {
      if (info.name != "none") strategies.emplace_back(info.name);
    }
    strategies.insert(strategies.end(), static_methods.begin(), static_methods.end());
  }
  const auto& integrators = !options.integrators.empty() ? options.integrators
                            : transient                  ? default_transient
                                                         : default_integrators;

  for (const std::string& strategy : strategies) check_strategy(strategy, transient);
  for (const std::string& integrator : integrators) check_integrator(integrator);

  std::vector<Candidate> all;
  for (const std::string& strategy : strategies) {
    if (is_static(strategy)) {
      Candidate candidate;
      candidate.run.strategy = strategy;
      all.push_back(std::move(candidate));
      continue;
    }
    const DampingInfo& info = find_damping(strategy);
    for (const std::string& integrator : integrators) {
      const Method method = find_method(method_of(integrator));
      if (!info.goes_with(method.name)) continue;
      // Without being asked for, Runge-Kutta methods are tried with the damping that is best for them.
      const bool of_interest = transient || !options.integrators.empty() || method.name == "leapfrog" ||
                               strategy == "viscous" || !options.strategies.empty();
      if (!of_interest) continue;
      if (is_adaptive(integrator)) {
        for (const double rtol : options.tolerances) {
          all.push_back(stepping(scene, info, integrator, std::nullopt, rtol));
        }
      } else if (info.has_own_step) {
        all.push_back(stepping(scene, info, integrator, std::nullopt, std::nullopt));
      } else {
        for (const double fraction : options.step_fractions) {
          all.push_back(stepping(scene, info, integrator, fraction, std::nullopt));
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

bool takes(const std::string& strategy, const std::string& key) {
  if (is_static(strategy)) return true;
  const DampingInfo& info = find_damping(strategy);
  if (key == "integrator.step" || key == "integrator.step_fraction") return !info.has_own_step;
  const std::string table = "damping.";
  return !key.starts_with(table) || key == "damping.strategy" || info.takes(key.substr(table.size()));
}

}  // namespace stillpoint
