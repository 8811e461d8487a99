// [exact]: formulas, or a solution that goes with the scene's state and material.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/text.hpp"
#include "scene/input/scene_check.hpp"

namespace stillpoint {
namespace {

/// Whether all of it was read, so that values can be looked at together.
bool is_read(const SceneCheck& check, const SolutionInfo& solution) {
  const ExactSpec& exact = check.scene().exact;
  return std::ranges::all_of(solution.parameters,
                             [&](const ParameterInfo& p) { return exact.parameters.contains(std::string(p.name)); }) &&
         std::ranges::all_of(solution.choices,
                             [&](const ChoiceInfo& c) { return exact.choices.contains(std::string(c.name)); });
}

/// True if there is one material, whose law the solution knows.
bool check_material(SceneCheck& check, const SolutionInfo& solution) {
  const Scene& scene = check.scene();
  std::set<std::string> names;
  for (const BodySpec& body : scene.bodies) names.insert(body.material);
  if (names.size() > 1) {
    check.add("exact.solution",
              fmt::format("'{}' is of one material, which all bodies have; there are {}", solution.name, names.size()));
    return false;
  }
  const auto material = names.empty() ? scene.materials.end() : scene.materials.find(*names.begin());
  if (material == scene.materials.end()) return false;  // as has been reported
  const LawInfo* const law = law_of(check, material->second);
  if (!law || !std::ranges::all_of(law->parameters, [&](const ParameterInfo& p) {
        return material->second.parameters.contains(std::string(p.name));
      }))
    return false;
  for (const char* const modulus : {"E", "nu"}) {
    if (material->second.parameters.contains(modulus)) continue;
    check.add("exact.solution",
              fmt::format("'{}' is one of E and nu, and the law '{}' has no {}", solution.name, law->name, modulus));
    return false;
  }
  if (solution.laws.empty() || std::ranges::find(solution.laws, law->name) != solution.laws.end()) return true;
  const std::vector<std::string> laws(solution.laws.begin(), solution.laws.end());
  check.add("exact.solution", fmt::format("'{}' is known for the law{} {}, not for '{}'", solution.name,
                                          laws.size() > 1 ? "s" : "", either(laws), law->name));
  return false;
}

void check_solution(SceneCheck& check, bool bodies, const SolutionInfo& solution) {
  const Scene& scene = check.scene();
  check.refuse("exact", {"u", "stress"},
               fmt::format("give either formulas or solution = \"{}\", which has its own, not both", solution.name));
  if (std::ranges::find(solution.states, scene.state) == solution.states.end()) {
    std::vector<std::string_view> states;
    for (const StressState state : solution.states) states.push_back(to_string(state));
    return check.add("exact.solution", fmt::format("'{}' has no state '{}'; it has {}", solution.name,
                                                   to_string(scene.state), fmt::join(states, ", ")));
  }
  if (!check_material(check, solution) || !is_read(check, solution) || !bodies || !solution.fault) return;
  if (const auto fault = solution.fault(scene)) check.add(fmt::format("exact.{}", fault->key), fault->message);
}

}  // namespace

void check_exact(SceneCheck& check, bool bodies) {
  const ExactSpec& exact = check.scene().exact;
  if (const SolutionInfo* const solution = check.catalogue().solution(exact.solution)) {
    check_solution(check, bodies, *solution);
  } else if (!exact.stress.empty() && !check.given("exact.u", !exact.u.empty()) && !check.written("exact.solution")) {
    check.add("exact.stress", "needs exact.u beside it");
  }
}

}  // namespace stillpoint
