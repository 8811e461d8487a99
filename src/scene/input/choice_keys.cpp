// Tables of which one key chooses what the others are: a material's law, the solution of [exact].
#include <stillpoint/catalogue.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "scene/input/key_reader.hpp"
#include "scene/input/scene_keys.hpp"

namespace stillpoint {
namespace {

/// A parameter that may be a formula of the position. Where it is one, its number is 1.
void read_by_place(MaterialSpec& material, const std::string& name, const Value& value, const KeyInfo& info) {
  if (value.node.is_string()) {
    const auto formula = read_formula(value, variables_of(info, value.reading.dim));
    if (!formula) return;
    if (formula->uses_position()) {
      material.by_place[name] = *formula;
      material.parameters[name] = 1;
      return;
    }
  }
  if (const auto number = read_number(value, info.range)) material.parameters[name] = *number;
}

bool softens(const LawInfo& law) {
  return law.softens_by_rows || std::ranges::find(law.parameters, std::string_view("softening_strain"),
                                                  &ParameterInfo::name) != law.parameters.end();
}

/// The keys of a row of the catalogue, into parts that have its parameters and choices.
template <class Spec, class Row>
std::vector<Key> keys_of_choice(const Row& row) {
  std::vector<Key> keys;
  for (const ParameterInfo& p : row.parameters) {
    const auto value = [name = std::string(p.name)](Spec& of) -> double& { return of.parameters[name]; };
    keys.push_back(key_of<Spec>(p.name, value, p.meaning,
                                {.range = {p.lower, p.upper, p.lower_allowed, false},
                                 .unit = p.unit,
                                 .variables = p.by_place ? "x" : "",
                                 .fallback = p.required                                    ? ""
                                             : std::isnan(p.fallback) && p.same_as.empty() ? "none"
                                             : p.same_as.empty() ? fmt::format("{}", p.fallback)
                                                                 : std::string(p.same_as),
                                 .required = p.required}));
    if constexpr (std::is_same_v<Spec, MaterialSpec>) {
      if (p.by_place)
        keys.back().read = [name = std::string(p.name)](void* part, const Value& given, const KeyInfo& info) {
          read_by_place(*static_cast<MaterialSpec*>(part), name, given, info);
        };
    }
  }
  for (const ChoiceInfo& c : row.choices) {
    const auto value = [name = std::string(c.name)](Spec& of) -> std::string& { return of.choices[name]; };
    keys.push_back(key_of<Spec>(c.name, value, c.meaning,
                                {.words = {c.values.begin(), c.values.end()}, .fallback = std::string(c.fallback)}));
  }
  return keys;
}

/// Sets what a table does not say, unless what it says is wrong.
template <class Spec, class Row>
void set_defaults(Spec& of, const Row& row, const FoundTable& found, const Reading& reading) {
  const auto missing = [&](const auto& values, std::string_view name) {
    return !values.contains(std::string(name)) && !reading.wrong.contains(fmt::format("{}.{}", found.path, name));
  };
  for (const ParameterInfo& p : row.parameters) {
    if (!missing(of.parameters, p.name)) continue;
    const auto same = of.parameters.find(std::string(p.same_as));
    of.parameters[std::string(p.name)] = same == of.parameters.end() ? p.fallback : same->second;
  }
  for (const ChoiceInfo& c : row.choices)
    if (missing(of.choices, c.name)) of.choices[std::string(c.name)] = c.fallback;
}

std::vector<Key> joined(std::vector<Key> keys, const std::vector<Key>& more) {
  keys.insert(keys.end(), more.begin(), more.end());
  return keys;
}

bool dilates_by_psi(const LawInfo& law) {
  return std::ranges::find(law.parameters, "psi", &ParameterInfo::name) != law.parameters.end();
}

}  // namespace

std::vector<TableInfo> material_tables(const Catalogue& catalogue) {
  const auto law_key =
      key_of<MaterialSpec>("law", &MaterialSpec::law, "`stillpoint list materials` has their equations",
                           {.words = names_of(catalogue.laws), .required = true});
  std::vector<TableInfo> tables = {
      {.path = "material.<name>", .help = "what bodies are made of", .repeat = Repeat::named, .keys = {law_key.info}}};
  std::map<std::string, std::vector<Key>> keys;
  for (const LawInfo& law : catalogue.laws) {
    std::vector<Key>& of_law = keys[std::string(law.name)] = keys_of_choice<MaterialSpec>(law);
    of_law.insert(of_law.begin(), law_key);
    of_law.push_back(key_of<MaterialSpec>("undrained", &MaterialSpec::undrained,
                                          "saturated with water that cannot flow: the law is that of the effective "
                                          "stress, and pore_pressure is a field",
                                          {}));
    of_law.push_back(key_of<MaterialSpec>(
        "water_modulus", &MaterialSpec::water_modulus, "bulk modulus of the water in undrained ground",
        {.range = kPositive, .unit = "Pa", .fallback = "such that the undrained Poisson's ratio is 0.495"}));
    of_law.push_back(key_of<MaterialSpec>("porosity", &MaterialSpec::porosity, "share of the water in the volume",
                                          {.range = {0, 1, false, true}, .unit = "1"}));
    if (dilates_by_psi(law))
      of_law.push_back(key_of<MaterialSpec>("undrained_dilatancy", &MaterialSpec::undrained_dilatancy,
                                            "undrained ground with psi > 0: what dilates draws the water apart, and "
                                            "becomes stronger without end",
                                            {}));
    if (law.from_library) {
      of_law.push_back(key_of<MaterialSpec>("library", &MaterialSpec::library,
                                            "shared library with the subroutine UMAT, beside the scene",
                                            {.required = true}));
      of_law.push_back(key_of<MaterialSpec>("props", &MaterialSpec::props, "the constants PROPS", {.list = true}));
      of_law.push_back(key_of<MaterialSpec>("statev", &MaterialSpec::statev,
                                            "names of the state variables STATEV, as many as there are: fields and "
                                            "probes; one that is empty is not shown",
                                            {.list = true, .may_be_empty = true}));
    }
    if (law.softens_by_rows)
      of_law.push_back(
          key_of<MaterialSpec>("softening", &MaterialSpec::softening,
                               "the strength by plastic strain, from c, phi and psi at 0 and straight "
                               "from row to row; after the last it stays",
                               {.list = true, .row = "[plastic strain, c, phi, psi]", .row_lengths = {4, 4}}));
    if (softens(law))
      of_law.push_back(key_of<MaterialSpec>("softening_length", &MaterialSpec::softening_length,
                                            "width of the bands to which plastic strains of softening belong; on a "
                                            "grid they are as wide as a cell h, and "
                                            "these strains count softening_length/h times",
                                            {.range = kPositive, .unit = "m", .fallback = "h"}));
    tables.push_back({.path = "material.<name>",
                      .help = law.equation,
                      .repeat = Repeat::named,
                      .choice_key = "law",
                      .choice = law.name,
                      .keys = infos_of(of_law)});
  }
  tables[0].read = [&catalogue, law_key, keys](const TableInfo& self, const toml::table& root, Scene& scene,
                                               Reading& reading) {
    for (const FoundTable& found : find_tables(self, root, reading)) {
      MaterialSpec& material = scene.materials[found.name];
      material.name = found.name;
      if (const toml::node* const law = found.table.get("law")) {
        law_key.read(&material, {*law, found.path + ".law", reading}, law_key.info);
      } else {
        reading.problem(location_of(found.table.source()), found.path, "the key 'law' is missing");
      }
      if (material.law.empty()) continue;  // which other keys belong here is not known
      const auto& of_law = keys.at(material.law);
      TableInfo told = self;
      told.keys = infos_of(of_law);
      read_keys(found, told, of_law, &material, reading);
      set_defaults(material, *catalogue.law(material.law), found, reading);
    }
  };
  return tables;
}

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
