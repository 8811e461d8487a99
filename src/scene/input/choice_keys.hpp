// Tables of which one key chooses what the others are: a material's law, the solution of [exact].
#pragma once

#include <stillpoint/catalogue.hpp>

#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "scene/input/key_reader.hpp"

namespace stillpoint {

/// The keys of a row of the catalogue, into parts that have its parameters and choices.
template <class Spec, class Row>
std::vector<Key> keys_of_choice(const Row& row) {
  std::vector<Key> keys;
  for (const ParameterInfo& p : row.parameters) {
    const auto value = [name = std::string(p.name)](Spec& of) -> double& { return of.parameters[name]; };
    keys.push_back(key_of<Spec>(p.name, value, p.meaning,
                                {.range = {p.lower, p.upper, p.lower_allowed, false},
                                 .unit = p.unit,
                                 .fallback = p.required          ? ""
                                             : p.same_as.empty() ? fmt::format("{}", p.fallback)
                                                                 : std::string(p.same_as),
                                 .required = p.required}));
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

}  // namespace stillpoint
