// Checks of [exact]: formulas, or a solution that goes with the scene's state and material.
#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "scene/input/scene_check.hpp"

namespace stillpoint {
namespace {

/// True if a table has all parameters that its row of the catalogue names, so that their values can be compared.
bool has_all(const std::map<std::string, double>& values, const std::vector<ParameterInfo>& parameters) {
  return std::ranges::all_of(parameters, [&](const ParameterInfo& p) { return values.contains(std::string(p.name)); });
}

/// True if there is one material, whose law the solution knows.
bool check_material(SceneCheck& check, const SolutionInfo& solution) {
  const Scene& scene = check.scene();
  const std::string key = "exact.solution";
  std::set<std::string> names;
  for (const BodySpec& body : scene.bodies) names.insert(body.material);
  if (check.wrong_if(names.size() > 1, key, "'{}' is of one material, which all bodies have; there are {}",
                     solution.name, names.size()))
    return false;
  const auto material = names.empty() ? scene.materials.end() : scene.materials.find(*names.begin());
  if (material == scene.materials.end()) return false;  // as has been reported
  const auto& parameters = material->second.parameters;
  for (const auto& [name, formula] : material->second.by_place)
    if (check.wrong_if(true, key, "'{}' is of one material, and material.{}.{} varies from place to place",
                       solution.name, material->first, name))
      return false;
  const LawInfo* const law = check.catalogue().law(material->second.law);
  if (!law || !has_all(parameters, law->parameters)) return false;
  for (const char* const modulus : {"E", "nu"})
    if (check.wrong_if(!parameters.contains(modulus), key, "'{}' is one of E and nu, and the law '{}' has no {}",
                       solution.name, law->name, modulus))
      return false;
  const bool is_finite_and_wet = material->second.undrained && law->finite_strain && !law->history_dependent;
  if (check.wrong_if(is_finite_and_wet, key, "'{}' of the law '{}' is one without water; leave out undrained",
                     solution.name, law->name))
    return false;
  const std::vector<std::string> laws(solution.laws.begin(), solution.laws.end());
  return !check.wrong_if(!laws.empty() && std::ranges::find(laws, law->name) == laws.end(), key,
                         "'{}' is known for the law{} {}, not for '{}'", solution.name, laws.size() > 1 ? "s" : "",
                         either(laws), law->name);
}

void check_solution(SceneCheck& check, bool bodies, const SolutionInfo& solution) {
  const Scene& scene = check.scene();
  const ExactSpec& exact = scene.exact;
  check.refuse_if(true, "exact", {"u", "stress"},
                  "give either formulas or solution = \"{}\", which has its own, not both", solution.name);
  const std::string why = why_no_state(fmt::format("'{}'", solution.name), solution.states, scene.state);
  if (check.wrong_if(!why.empty(), "exact.solution", "{}", why) || !check_material(check, solution)) return;
  const bool is_read =
      has_all(exact.parameters, solution.parameters) && std::ranges::all_of(solution.choices, [&](const ChoiceInfo& c) {
        return exact.choices.contains(std::string(c.name));
      });
  if (!is_read || !bodies || !solution.fault) return;
  if (const auto fault = solution.fault(scene)) check.add(fmt::format("exact.{}", fault->key), fault->message);
}

}  // namespace

void check_exact(SceneCheck& check, bool bodies) {
  const ExactSpec& exact = check.scene().exact;
  if (const SolutionInfo* const solution = check.catalogue().solution(exact.solution))
    return check_solution(check, bodies, *solution);
  check.wrong_if(!exact.stress.empty() && !check.given("exact.u", !exact.u.empty()) && !check.written("exact.solution"),
                 "exact.stress", "needs exact.u beside it");
}

}  // namespace stillpoint
