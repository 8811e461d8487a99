// The tables of [exact]: formulas, or a solution with keys of its own.
#include <map>

#include "scene/input/choice_keys.hpp"
#include "scene/input/scene_keys.hpp"

namespace stillpoint {
namespace {

std::vector<Key> joined(std::vector<Key> keys, const std::vector<Key>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

}  // namespace

std::vector<TableInfo> exact_tables(const Catalogue& catalogue) {
  const Key solution = key_of<ExactSpec>(
      "solution", &ExactSpec::solution,
      "one that the program knows, for the material of the bodies, in place of u and stress; `stillpoint list "
      "solutions` has them",
      {.words = names_of(catalogue.solutions)});
  const std::vector<Key> formulas = {
      key_of<ExactSpec>("u", &ExactSpec::u, "displacement", {.unit = "m", .variables = "xt"}),
      key_of<ExactSpec>("stress", &ExactSpec::stress,
                        "Cauchy's, beside u; with dim = 2 the components [xx, yy, zz, xy], axisymmetric [rr, zz, "
                        "theta-theta, rz], with dim = 3 [xx, yy, zz, xy, yz, zx]",
                        {.unit = "Pa", .variables = "xt", .of_stress = true})};
  const std::vector<Key> keys_of_all = joined(formulas, {solution});
  std::map<std::string, std::vector<Key>> keys;
  std::vector<TableInfo> tables = {{.path = "exact",
                                    .help = "the exact solution, if it is known: the run reports its error",
                                    .keys = infos_of(keys_of_all)}};
  for (const SolutionInfo& info : catalogue.solutions) {
    const auto& of_solution = keys[std::string(info.name)] = joined({solution}, keys_of_choice<ExactSpec>(info));
    tables.push_back({.path = "exact",
                      .help = info.description,
                      .choice_key = "solution",
                      .choice = info.name,
                      .keys = infos_of(of_solution)});
  }
  tables[0].read = [&catalogue, solution, keys_of_all, formulas, keys](const TableInfo& self, const toml::table& root,
                                                                       Scene& scene, Reading& reading) {
    for (const FoundTable& found : find_tables(self, root, reading)) {
      const toml::node* const chosen = found.table.get("solution");
      if (!chosen) {
        read_keys(found, self, keys_of_all, &scene.exact, reading);
        continue;
      }
      solution.read(&scene.exact, {*chosen, found.path + ".solution", reading}, solution.info);
      if (scene.exact.solution.empty()) continue;  // which other keys belong here is not known
      const std::vector<Key> of_solution = joined(keys.at(scene.exact.solution), formulas);
      TableInfo told = self;
      told.keys = infos_of(of_solution);
      read_keys(found, told, of_solution, &scene.exact, reading);
      set_defaults(scene.exact, *catalogue.solution(scene.exact.solution), found, reading);
    }
  };
  return tables;
}

}  // namespace stillpoint
