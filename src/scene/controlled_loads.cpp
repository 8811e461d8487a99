#include "scene/controlled_loads.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace stillpoint {
namespace {

// Those for which keeps(name) holds.
template <class Keeps>
Problem with_loads(const Problem& problem, const Keeps& keeps) {
  Problem chosen = problem;
  chosen.tractions.clear();
  chosen.forces.clear();
  for (std::size_t k = 0; k < problem.tractions.size(); ++k)
    if (keeps(fmt::format("traction[{}]", k))) chosen.tractions.push_back(problem.tractions[k]);
  for (std::size_t k = 0; k < problem.forces.size(); ++k)
    if (keeps(fmt::format("force[{}]", k))) chosen.forces.push_back(problem.forces[k]);
  if (!keeps("body_force")) {
    chosen.body_force.clear();
    chosen.own_load.clear();
  }
  return chosen;
}

// Also by a [load] that begins with a later stage: before, what it drives does not act.
bool is_driven(const Problem& problem, const std::string& name) {
  const std::vector<std::string>& driven = (problem.load ? problem.load : problem.later_load)->of;
  return driven.empty() || std::ranges::find(driven, name) != driven.end();
}

}  // namespace

std::vector<std::string> names_of_loads(const Problem& problem) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < problem.tractions.size(); ++k) names.push_back(fmt::format("traction[{}]", k));
  for (std::size_t k = 0; k < problem.forces.size(); ++k) names.push_back(fmt::format("force[{}]", k));
  if (problem.has_body_force()) names.emplace_back("body_force");
  return names;
}

Problem reference_loads(const Problem& problem) {
  Problem driven = with_loads(problem, [&](const std::string& name) { return is_driven(problem, name); });
  driven.supports.clear();
  driven.walls.clear();
  driven.rigid.clear();
  driven.contacts.clear();
  return driven;
}

Problem without_reference_loads(const Problem& problem) {
  if (!problem.load && !problem.later_load) return problem;
  return with_loads(problem, [&](const std::string& name) { return !is_driven(problem, name); });
}

}  // namespace stillpoint
