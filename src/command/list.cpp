// stillpoint list: the choices that a scene offers.
#include <stillpoint/integrator.hpp>

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "command/commands.hpp"
#include "plan/catalogue.hpp"
#include "scene/input/read_scene.hpp"

namespace stillpoint::command {
namespace {

void list_integrators() {
  fmt::print("integrators (integrator.method)\n  {:<34}{:>5}{:>14}  {:<9} {}\n", "name", "order", "forces a step",
             "adaptive", "what");
  for (const Method& method : methods()) {
    const std::string forces = method.fixed_step ? fmt::format("{}", method.evaluations_per_step) : "-";
    fmt::print("  {:<34}{:>5}{:>14}  {:<9} {}\n", method.name, method.order, forces, method.adaptive ? "yes" : "no",
               method.description);
  }
}

void list_strategies(const std::string& title, bool relaxations) {
  fmt::print("{} (damping.strategy)\n", title);
  for (const StrategyInfo& info : catalogue().strategies) {
    if (info.is_relaxation != relaxations) continue;
    fmt::print("  {:<14}{}{}{}\n", info.name, info.equation,
               info.source.empty() ? "" : fmt::format("   [{}]", info.source),
               info.integrators.empty() ? "" : fmt::format("   with {}", fmt::join(info.integrators, ", ")));
  }
}

void list_static_methods() {
  fmt::print("static solvers (solve.method)\n");
  for (const StaticMethodInfo& info : catalogue().static_methods) {
    fmt::print("  {:<14}{}   [{}]\n", info.name, info.equation, info.source);
  }
}

void list_choices(const std::vector<ChoiceInfo>& choices) {
  for (const ChoiceInfo& c : choices)
    fmt::print("    {:<18}{}: {}, default {}\n", c.name, c.meaning, fmt::join(c.values, " | "), c.fallback);
}

void list_materials() {
  fmt::print("materials (material.<name>.law)\n");
  for (const LawInfo& law : catalogue().laws) {
    fmt::print("  {:<16}{}   [{}]\n", law.name, law.equation, law.source);
    std::vector<std::string_view> states;
    for (const StressState state : law.states) states.push_back(to_string(state));
    fmt::print("    for {}\n", fmt::join(states, ", "));
    for (const ParameterInfo& p : law.parameters) {
      const std::string fallback = p.required                                    ? ""
                                   : std::isnan(p.fallback) && p.same_as.empty() ? ""
                                   : p.same_as.empty() ? fmt::format(", default {}", p.fallback)
                                                       : fmt::format(", default {}", p.same_as);
      fmt::print("    {:<18}{} [{}], {} {} {} < {}{}\n", p.name, p.meaning, p.unit, p.lower,
                 p.lower_allowed ? "<=" : "<", p.name, p.upper, fallback);
    }
    list_choices(law.choices);
    if (law.from_library)
      fmt::print("    library, props, statev  shared library with the subroutine, its constants, names of its state\n");
  }
}

void list_solutions() {
  fmt::print("exact solutions (exact.solution), for the material and the state of the bodies\n");
  for (const SolutionInfo& info : catalogue().solutions) {
    fmt::print("  {:<16}{}   [{}]\n", info.name, info.description, info.source);
    std::vector<std::string_view> states;
    for (const StressState state : info.states) states.push_back(to_string(state));
    fmt::print("    for {}{}{}\n", fmt::join(states, ", "), info.laws.empty() ? ", small strain" : "; law ",
               fmt::join(info.laws, ", "));
    for (const ParameterInfo& p : info.parameters)
      fmt::print("    {:<18}{} [{}]{}\n", p.name, p.meaning, p.unit,
                 p.required ? "" : fmt::format(", default {}", p.fallback));
    list_choices(info.choices);
  }
}

void list_bases() {
  fmt::print(
      "bases (grid.basis)\n"
      "  linear      hat functions, C0\n"
      "  quadratic   B-spline, C1, interpolating at the ends of the grid\n"
      "  cubic       B-spline, C2, interpolating at the ends of the grid\n"
      "  hermite     cubic Hermite, C1, degrees of freedom u and du/dx at the nodes\n");
}

}  // namespace

int list(const std::string& topic, const std::string& format) {
  if (format != "text") {
    fmt::print("{}", format == "schema" ? key_schema(catalogue()) : key_reference(catalogue()));
    return 0;
  }
  const bool all = topic.empty();
  if (all || topic == "integrators") list_integrators();
  if (all || topic == "dampings") list_strategies("dampings", false);
  if (all || topic == "relaxations") list_strategies("relaxations", true);
  if (all || topic == "solvers") list_static_methods();
  if (all || topic == "materials") list_materials();
  if (all || topic == "solutions") list_solutions();
  if (all || topic == "bases") list_bases();
  if (all || topic == "keys") fmt::print("{}", key_list(catalogue()));
  return 0;
}

}  // namespace stillpoint::command
