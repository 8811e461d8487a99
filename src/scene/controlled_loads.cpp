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
  for (const TractionSpec& traction : problem.tractions)
    if (keeps(name_of_load(traction))) chosen.tractions.push_back(traction);
  for (const PointForceSpec& force : problem.forces)
    if (keeps(name_of_load(force))) chosen.forces.push_back(force);
  if (!keeps("body_force")) {
    chosen.body_force.clear();
    chosen.own_load.clear();
  }
  return chosen;
}

}  // namespace

std::string name_of_load(const TractionSpec& traction) { return fmt::format("traction[{}]", traction.number); }
std::string name_of_load(const PointForceSpec& force) { return fmt::format("force[{}]", force.number); }

// Also by a [load] that begins with a later stage: before, what it drives does not act.
bool is_driven(const Problem& problem, const std::string& name) {
  const std::optional<LoadSpec>& load = problem.load ? problem.load : problem.later_load;
  return load && (load->of.empty() || std::ranges::find(load->of, name) != load->of.end());
}

std::vector<std::string> names_of_loads(const Problem& problem) {
  std::vector<std::string> names;
  for (const auto* tractions : {&problem.tractions, &problem.later_tractions})
    for (const TractionSpec& traction : *tractions) names.push_back(name_of_load(traction));
  for (const auto* forces : {&problem.forces, &problem.later_forces})
    for (const PointForceSpec& force : *forces) names.push_back(name_of_load(force));
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
